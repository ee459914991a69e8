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
bool is_held(const PerfectNodes& of_term, const HeatModel& model, const std::vector<int>& holds) {
  for (std::size_t i = 0; i < of_term.size(); ++i) {
    if (of_term.jump[i] != 0 && held_by(of_term.nodes[i], model, holds) == nullptr) return false;
  }
  return true;
}

bool varies_in_time(const PerfectNodes& of_term, const HeatModel& model, const std::vector<int>& holds) {
  for (std::size_t i = 0; i < of_term.size(); ++i) {
    if (of_term.jump[i] != 0 && held_by(of_term.nodes[i], model, holds)->temperature.varies_in_time()) return true;
  }
  return false;
}

HeldJump held_jump(const PerfectNodes& of_term, const HeatModel& model, const std::vector<int>& holds, double time) {
  HeldJump jump;
  for (std::size_t i = 0; i < of_term.size(); ++i) {
    if (of_term.jump[i] == 0) continue;
    const Hold& by = *held_by(of_term.nodes[i], model, holds);
    const double temperature = by.temperature(model.places.col(of_term.nodes[i].value()), time);
    jump.difference += of_term.jump[i] * temperature;
    jump.size = std::max(jump.size, std::abs(temperature));
    (i < of_term.owners ? jump.first : jump.second) = &by;
  }
  return jump;
}

}  // namespace

void check_held_joints(const JointConduction& joints, const HeatModel& model, double until) {
  if (joints.perfect.terms.empty() || model.holds.empty()) return;
  const std::vector<int> holds = holds_of_nodes(model);
  LooksInTime looks(until);
  for (const PerfectTerm& term : joints.perfect.terms) {
    const PerfectNodes of_term = joints.perfect.nodes_of(term);
    if (!is_held(of_term, model, holds)) continue;
    const auto time = looks.first(varies_in_time(of_term, model, holds), [&](double at) {
      const HeldJump jump = held_jump(of_term, model, holds, at);
      return std::abs(jump.difference) > equal_temperatures * jump.size;
    });
    if (!time) continue;
    const HeldJump jump = held_jump(of_term, model, holds, *time);
    throw InputError(problem(
        "contact",
        fmt::format("a perfect joint held on both sides, by {} and by {}, {:g} K apart{}", jump.first->name, jump.second->name,
                    std::abs(jump.difference), *time > 0 ? fmt::format(" at {:g} s", *time) : std::string()),
        "must have one temperature", "Hold one side only, or give the joint a conductance"));
  }
}

}  // namespace scree::thermal
