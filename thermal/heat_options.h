// What a scene says about heat.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/base/check.h"
#include "engine/base/function.h"
#include "engine/base/geometry.h"
#include "engine/base/ids.h"
#include "thermal/joint_options.h"

namespace scree::thermal {

// Where on a body something holds: everywhere, or only inside an axis-aligned box of space, on a surface, or both.
struct Region {
  Region() = default;
  // Not inline: GCC 12 takes the clean-up of a temporary for a use of uninitialised strings.
  Region(BodyId of_body, std::optional<Aabb<3>> in, std::optional<std::string> on = std::nullopt);

  BodyId body;
  // [m]; includes its faces, with a billionth of the mesh's extent for rounding; 2-D ignores z.
  std::optional<Aabb<3>> within;
  std::optional<std::string> surface{};  // of the body, by its name; boundaries only
};

// All are functions of place [m] and time [s]; on a face, of its corners' places. A region's faces: of a surface the part that
// lies in the box; without a surface every boundary face whose corners all do.
struct FixedTemperature {
  Function temperature = 0.0;  // [K], at every node in the region; inner ones too, without a surface
};
struct HeatFlux {
  Function flux = 0.0;  // [W/m2], into the body, on the region's faces
};
struct HeatFlow {
  Function flow = 0.0;  // [W], total into the body, spread over those faces by area; must not depend on place
};
// On those faces, h (T_s - T) into the body.
struct Convection {
  Function coefficient = 0.0;   // h [W/m2/K]
  Function surroundings = 0.0;  // T_s [K]
};
// On those faces, sigma epsilon (T_s^4 - T^4) into the body.
struct Radiation {
  Function emissivity = 0.0;    // epsilon, 0 to 1 [-]
  Function surroundings = 0.0;  // T_s [K]
};

struct Boundary {
  Region region;
  std::variant<FixedTemperature, HeatFlux, HeatFlow, Convection, Radiation> condition;
  std::string name;      // how the ledger calls it
  SourceLocation where;  // in the scene, for messages
};

struct Source {
  Region region;
  Function power = 0.0;  // [W/m3], in the part of every element that lies in the region
  std::string name;
  SourceLocation where;
};

enum class Integrator {
  automatic,            // stabilised explicit, implicit, or short steps the one and longer ones the other: what costs least
  implicit,             // L-stable, second order, steps from the tolerance
  stabilised_explicit,  // second order, steps from the tolerance
  explicit_euler,       // eq. (8)
};

// How implicit steps and the steady state solve their equations.
enum class LinearSolver {
  automatic,  // whichever costs less, if it has the memory
  cholesky,   // a factorisation
  multigrid,  // conjugate gradients with algebraic multigrid
};

// How a block's inside is resolved.
enum class BlockModel {
  meshed,     // a temperature per node
  lumped,     // one temperature
  automatic,  // one where its Biot number is below BlockOptions::largest_biot and nothing holds or ties its nodes
};

struct BlockOptions {
  BlockModel model = BlockModel::meshed;  // of every body that has none of its own
  // Far below the 0.1 of textbooks (Incropera and DeWitt, section 5.2), where the inside differs by some 5 %.
  double largest_biot = 0.01;  // [-]
  std::map<BodyId, BlockModel> of_body;
  SourceLocation where;  // in the scene, for messages

  [[nodiscard]] BlockModel of(BodyId body) const {
    const auto own = of_body.find(body);
    return own == of_body.end() ? model : own->second;
  }
  [[nodiscard]] bool all_meshed() const {
    return model == BlockModel::meshed &&
           std::all_of(of_body.begin(), of_body.end(), [](const auto& own) { return own.second == BlockModel::meshed; });
  }
};

struct TimeOptions {
  bool steady = false;      // the steady state itself; of the others only the solver has a use then
  double until = 0;         // [s]
  double tolerance = 0.1;   // largest accepted time error [K]
  double output_every = 0;  // [s]; long steps pass its multiples
  Integrator integrator = Integrator::automatic;
  LinearSolver solver = LinearSolver::automatic;  // of the steady state, too
  std::optional<double> step;                     // explicit only; nothing: the largest stable one
};

// How the error goes down with the mesh size.
enum class SpaceOrder {
  second,  // on every mesh
  fourth,  // on grids of equal quadrilaterals or hexahedra (fourth_order.h)
};

struct HeatOptions {
  Table<BodyId, Function> initial_temperature;   // at t = 0 [K]
  std::optional<Eigen::VectorXd> initial_field;  // of every node, instead [K]
  std::vector<Boundary> boundaries;
  std::vector<Source> sources;
  JointOptions joint;
  BlockOptions blocks;
  SpaceOrder space_order = SpaceOrder::second;
  TimeOptions time;
};

}  // namespace scree::thermal
