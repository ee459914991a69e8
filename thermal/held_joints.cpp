#include "thermal/held_joints.h"

#include <cmath>

#include <fmt/format.h>

#include "thermal/held_nodes.h"
#include "thermal/problems.h"

namespace scree::thermal {

namespace {

constexpr double rounding = 1e-9;  // of a temperature

// The difference between the sides if all nodes that have to do with it are held, else nothing; and who holds them.
struct HeldJump {
  double difference = 0;         // [K]
  double size = 0;               // [K]
  const Hold* first = nullptr;   // of the owner's side
  const Hold* second = nullptr;  // of the target's
};

template <int dim>
std::optional<HeldJump> held_jump(const PerfectTerm<dim>& term, const HeatModel& model, const std::vector<int>& holds) {
  HeldJump jump;
  for (int i = 0; i < term.corners; ++i) {
    if (term.jump[i] == 0) continue;
    const int hold = holds[term.nodes[i].index()];
    if (hold < 0) return std::nullopt;
    const Hold& by = model.holds[static_cast<std::size_t>(hold)];
    const double temperature = by.temperature(model.places.col(term.nodes[i].value()), 0);
    jump.difference += term.jump[i] * temperature;
    jump.size = std::max(jump.size, std::abs(temperature));
    (i <= dim ? jump.first : jump.second) = &by;
  }
  return jump;
}

}  // namespace

template <int dim>
void check_held_joints(const JointConduction<dim>& joints, const HeatModel& model) {
  if (joints.perfect.empty() || model.holds.empty()) return;
  const std::vector<int> holds = holds_of_nodes(model);
  for (const PerfectTerm<dim>& term : joints.perfect) {
    const auto jump = held_jump(term, model, holds);
    if (!jump || std::abs(jump->difference) <= rounding * jump->size) continue;
    throw InputError(problem("contact",
                             fmt::format("a perfect joint held on both sides, by {} and by {}, {:g} K apart", jump->first->name,
                                         jump->second->name, std::abs(jump->difference)),
                             "must have one temperature", "Hold one side only, or give the joint a conductance"));
  }
}

template void check_held_joints<2>(const JointConduction<2>&, const HeatModel&);
template void check_held_joints<3>(const JointConduction<3>&, const HeatModel&);

}  // namespace scree::thermal
