#include "thermal/held_joints.h"

#include <cmath>

#include <fmt/format.h>

#include "thermal/held_nodes.h"
#include "thermal/looks_in_time.h"
#include "thermal/problems.h"

namespace scree::thermal {

namespace {

// The difference between the sides, and who holds them.
struct HeldJump {
  double difference = 0;         // [K]
  double size = 0;               // [K]
  const Hold* first = nullptr;   // of the owner's side
  const Hold* second = nullptr;  // of the target's
};

const Hold* held_by(NodeId node, const HeatModel& model, const std::vector<int>& holds) {
  const int hold = holds[node.index()];
  return hold < 0 ? nullptr : &model.holds[static_cast<std::size_t>(hold)];
}

// Whether all nodes that have to do with it are held.
template <int dim>
bool is_held(const PerfectTerm<dim>& term, const HeatModel& model, const std::vector<int>& holds) {
  for (int i = 0; i < term.size; ++i) {
    if (term.jump[i] != 0 && held_by(term.nodes[i], model, holds) == nullptr) return false;
  }
  return true;
}

template <int dim>
bool varies_in_time(const PerfectTerm<dim>& term, const HeatModel& model, const std::vector<int>& holds) {
  for (int i = 0; i < term.size; ++i) {
    if (term.jump[i] != 0 && held_by(term.nodes[i], model, holds)->temperature.varies_in_time()) return true;
  }
  return false;
}

template <int dim>
HeldJump held_jump(const PerfectTerm<dim>& term, const HeatModel& model, const std::vector<int>& holds, double time) {
  HeldJump jump;
  for (int i = 0; i < term.size; ++i) {
    if (term.jump[i] == 0) continue;
    const Hold& by = *held_by(term.nodes[i], model, holds);
    const double temperature = by.temperature(model.places.col(term.nodes[i].value()), time);
    jump.difference += term.jump[i] * temperature;
    jump.size = std::max(jump.size, std::abs(temperature));
    (i < term.owners ? jump.first : jump.second) = &by;
  }
  return jump;
}

}  // namespace

template <int dim>
void check_held_joints(const JointConduction<dim>& joints, const HeatModel& model, double until) {
  if (joints.perfect.empty() || model.holds.empty()) return;
  const std::vector<int> holds = holds_of_nodes(model);
  LooksInTime looks(until);
  for (const PerfectTerm<dim>& term : joints.perfect) {
    if (!is_held(term, model, holds)) continue;
    const auto time = looks.first(varies_in_time(term, model, holds), [&](double at) {
      const HeldJump jump = held_jump(term, model, holds, at);
      return std::abs(jump.difference) > equal_temperatures * jump.size;
    });
    if (!time) continue;
    const HeldJump jump = held_jump(term, model, holds, *time);
    throw InputError(problem(
        "contact",
        fmt::format("a perfect joint held on both sides, by {} and by {}, {:g} K apart{}", jump.first->name, jump.second->name,
                    std::abs(jump.difference), *time > 0 ? fmt::format(" at {:g} s", *time) : std::string()),
        "must have one temperature", "Hold one side only, or give the joint a conductance"));
  }
}

template void check_held_joints<2>(const JointConduction<2>&, const HeatModel&, double);
template void check_held_joints<3>(const JointConduction<3>&, const HeatModel&, double);

}  // namespace scree::thermal
