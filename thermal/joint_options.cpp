#include "thermal/joint_options.h"

#include <algorithm>

#include <fmt/format.h>

namespace scree::thermal {

namespace {

using contact::Model;

template <class IdType>
bool speaks_of(const std::array<IdType, 2>& between, IdType a, IdType b) {
  return between == std::array{a, b} || between == std::array{b, a};
}

bool speaks_of(const JointRule& rule, const Table<BodyId, mesh::Body>& bodies, BodyId a, BodyId b) {
  if (const auto* pair = std::get_if<std::array<BodyId, 2>>(&rule.between)) return speaks_of(*pair, a, b);
  return speaks_of(std::get<std::array<MaterialId, 2>>(rule.between), bodies[a].material, bodies[b].material);
}

Model model_for(const JointLaw& law, const std::optional<Model>& asked) {
  if (std::holds_alternative<PerfectJoint>(law)) return Model::overlap;
  return asked.value_or(std::holds_alternative<JointConductance>(law) ? Model::overlap : Model::semi_spring);
}

Model default_model(const JointOptions& joint) {
  if (std::holds_alternative<InsulatingJoint>(joint.law)) return Model::none;
  return model_for(joint.law, joint.model);
}

}  // namespace

std::string name_of(const JointLaw& law) {
  static constexpr std::array<const char*, 4> names{"stiffness_factor", "conductance", "perfect", "insulating"};
  return names.at(law.index());
}

bool any_perfect(const JointOptions& joint) {
  const auto perfect = [](const JointLaw& law) { return std::holds_alternative<PerfectJoint>(law); };
  return perfect(joint.law) ||
         std::any_of(joint.rules.begin(), joint.rules.end(), [&](const JointRule& rule) { return perfect(rule.law); });
}

const JointRule* rule_between(const JointOptions& joint, const Table<BodyId, mesh::Body>& bodies, BodyId a, BodyId b) {
  const auto rule = std::find_if(joint.rules.rbegin(), joint.rules.rend(),
                                 [&](const JointRule& candidate) { return speaks_of(candidate, bodies, a, b); });
  return rule == joint.rules.rend() ? nullptr : &*rule;
}

const JointLaw& law_between(const JointOptions& joint, const Table<BodyId, mesh::Body>& bodies, BodyId a, BodyId b) {
  const JointRule* rule = rule_between(joint, bodies, a, b);
  return rule == nullptr ? joint.law : rule->law;
}

contact::ContactOptions contact_search(const JointOptions& joint, const Table<BodyId, mesh::Body>& bodies,
                                       contact::ContactOptions options) {
  options.model = default_model(joint);
  if (joint.rules.empty()) return options;
  options.pairs = Table<BodyId, Table<BodyId, Model>>(bodies.size(), Table<BodyId, Model>(bodies.size(), options.model));
  for (const BodyId a : bodies.ids()) {
    for (const BodyId b : bodies.ids()) {
      const JointRule* rule = rule_between(joint, bodies, a, b);
      if (rule != nullptr) options.pairs[a][b] = model_for(rule->law, rule->model ? rule->model : joint.model);
    }
  }
  return options;
}

template <int dim>
std::vector<Problem> unused_rules(const JointOptions& joint, const mesh::BlockMesh<dim>& mesh,
                                  const contact::ContactSet<dim>& contacts) {
  if (joint.rules.empty()) return {};
  std::vector<bool> used(joint.rules.size(), false);
  for (const auto& contact : contacts.contacts) {
    const JointRule* rule = rule_between(joint, mesh.bodies, mesh.blocks[contact.owner].body, mesh.blocks[contact.target].body);
    if (rule != nullptr) used[static_cast<std::size_t>(rule - joint.rules.data())] = true;
  }
  std::vector<Problem> problems;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i]) continue;
    problems.push_back({joint.rules[i].where, fmt::format("contact.joints[{}]", i), name_of(joint.rules[i].law),
                        "must hold for some contact, and none is found that no later joint takes",
                        "Do the two touch? See contact.tolerance, or take it out"});
  }
  return problems;
}

template std::vector<Problem> unused_rules<2>(const JointOptions&, const mesh::BlockMesh<2>&, const contact::ContactSet<2>&);
template std::vector<Problem> unused_rules<3>(const JointOptions&, const mesh::BlockMesh<3>&, const contact::ContactSet<3>&);

}  // namespace scree::thermal
