#include "tools/scene/sections.h"

namespace scree {

namespace {

// The law that one of the keys of `part` gives; `otherwise` if none does.
thermal::JointLaw read_law(const Checked& part, const thermal::JointLaw& otherwise) {
  if (const Checked* beta = part.find("stiffness_factor")) return thermal::StiffnessFactor{beta->number()};
  if (const Checked* h = part.find("conductance")) return thermal::JointConductance{h->number()};
  if (part.find("perfect") != nullptr) return thermal::PerfectJoint{};
  if (part.find("insulating") != nullptr) return thermal::InsulatingJoint{};
  return otherwise;
}

std::optional<contact::Model> read_model(const Checked& part, const thermal::JointLaw& law, Problems& problems) {
  const Checked* model = part.find("model");
  if (model == nullptr) return std::nullopt;
  const Checked* rules = part.find("joints");  // to which it may fall
  if (std::holds_alternative<thermal::InsulatingJoint>(law) && (rules == nullptr || rules->items.empty())) {
    problems.push_back(model->problem(model->text, "is of joints that conduct, and none does", "Take it out"));
  }
  if (model->text == "overlap") return contact::Model::overlap;
  if (std::holds_alternative<thermal::PerfectJoint>(law)) {
    problems.push_back(model->problem(model->text, "must be overlap for a perfect joint", "Take it out"));
  }
  return contact::Model::semi_spring;
}

template <class IdType>
std::array<IdType, 2> read_pair(const Checked& pair, const std::vector<std::string>& names, const std::string& what,
                                Problems& problems) {
  std::array<IdType, 2> ids;
  for (std::size_t i = 0; i < ids.size() && i < pair.items.size(); ++i) {
    ids[i] = resolve<IdType>(pair.items[i], names, what, problems);
  }
  return ids;
}

thermal::JointRule read_rule(const Checked& part, const Checked& scene, Problems& problems) {
  thermal::JointRule rule;
  rule.where = part.where;
  rule.law = read_law(part, thermal::StiffnessFactor{});
  rule.model = read_model(part, rule.law, problems);
  if (const Checked* bodies = part.find("bodies")) {
    rule.between = read_pair<BodyId>(*bodies, names_of(scene.at("bodies")), "body", problems);
  } else if (const Checked* materials = part.find("materials")) {
    rule.between = read_pair<MaterialId>(*materials, names_of(scene.at("materials")), "material", problems);
  }
  return rule;
}

bool uses_semi_springs(const thermal::JointOptions& joint) {
  const auto semi_springs = [&](const thermal::JointLaw& law, const std::optional<contact::Model>& model) {
    if (std::holds_alternative<thermal::StiffnessFactor>(law)) return model != contact::Model::overlap;
    return std::holds_alternative<thermal::JointConductance>(law) && model == contact::Model::semi_spring;
  };
  bool any = semi_springs(joint.law, joint.model);
  for (const auto& rule : joint.rules) any = any || semi_springs(rule.law, rule.model ? rule.model : joint.model);
  return any;
}

}  // namespace

contact::ContactOptions read_contact(const Checked& contact) {
  contact::ContactOptions options;
  options.indentation = contact.at("indentation").number();
  options.tolerance = contact.at("tolerance").number();
  return options;
}

thermal::JointOptions read_joint(const Checked& scene, Problems& problems) {
  const Checked& contact = scene.at("contact");
  thermal::JointOptions joint;
  joint.law = read_law(contact, thermal::StiffnessFactor{});
  joint.model = read_model(contact, joint.law, problems);
  for (const Checked& part : contact.at("joints").items) joint.rules.push_back(read_rule(part, scene, problems));
  const Checked& indentation = contact.at("indentation");
  if (indentation.number() != contact::ContactOptions{}.indentation && !uses_semi_springs(joint)) {
    problems.push_back(indentation.problem(indentation.text, "is of semi-springs, and no joint has them", "Take it out"));
  }
  const bool literal = contact.at("form").text == "literal";
  joint.form = literal ? thermal::JointForm::literal : thermal::JointForm::consistent;
  if (literal && !uses_semi_springs(joint)) {
    problems.push_back(
        contact.at("form").problem("literal", "is a form of semi-springs, and no joint has them", "Take it out"));
  }
  return joint;
}

}  // namespace scree
