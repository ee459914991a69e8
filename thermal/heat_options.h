// What a scene says about heat.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/base/check.h"
#include "engine/base/geometry.h"
#include "engine/base/ids.h"
#include "thermal/joint_options.h"

namespace scree::thermal {

// Where on a body something holds: everywhere, or only inside an axis-aligned box of space, on a surface, or both.
struct Region {
  BodyId body;
  // [m]; includes its faces, with a billionth of the mesh's extent for rounding; 2-D ignores z.
  std::optional<Aabb<3>> within;
  std::optional<std::string> surface{};  // of the body, by its name; boundaries only
};

struct FixedTemperature {
  double temperature = 0;  // [K], at every node in the region; inner ones too, without a surface
};
struct HeatFlux {
  double flux = 0;  // [W/m2], into the body, on every boundary face whose corners are all in the region
};
struct HeatFlow {
  double flow = 0;  // [W], total into the body, spread over those faces by area
};

struct Boundary {
  Region region;
  std::variant<FixedTemperature, HeatFlux, HeatFlow> condition;
  std::string name;      // how the ledger calls it
  SourceLocation where;  // in the scene, for messages
};

struct Source {
  Region region;
  double power = 0;  // [W/m3], in every simplex (of cells: of both splits) whose centre is in the region
  std::string name;
  SourceLocation where;
};

enum class Integrator {
  implicit,        // L-stable, second order, steps from the tolerance
  explicit_euler,  // eq. (8)
};

struct TimeOptions {
  double until = 0;         // [s]
  double tolerance = 0.1;   // largest accepted time error [K]
  double output_every = 0;  // [s]; states are exact at its multiples
  Integrator integrator = Integrator::implicit;
  std::optional<double> step;  // explicit only; nothing: the largest stable one
};

struct HeatOptions {
  Table<BodyId, double> initial_temperature;  // [K]
  std::vector<Boundary> boundaries;
  std::vector<Source> sources;
  JointOptions joint;
  TimeOptions time;
};

}  // namespace scree::thermal
