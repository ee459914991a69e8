// What a scene says about its joints: how well heat passes from body to body.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "contact/find_contacts.h"
#include "engine/base/check.h"

namespace scree::thermal {

struct StiffnessFactor {
  double factor = 10;  // beta of eq. (11) [-]
};
struct JointConductance {
  double conductance = 0;  // h, of the joint whatever the mesh [W/m2/K]
};
// No joint at all: temperatures and heat flux are continuous.
struct PerfectJoint {};
// Nothing passes.
struct InsulatingJoint {};

using JointLaw = std::variant<StiffnessFactor, JointConductance, PerfectJoint, InsulatingJoint>;

enum class JointForm {
  consistent,  // both temperatures at the contact point: passes a linear field
  literal,     // eq. (12) as printed: the owner's temperature at the vertex
};

// The joints between two bodies, or between all bodies of two materials; both may be the same.
struct JointRule {
  std::variant<std::array<BodyId, 2>, std::array<MaterialId, 2>> between;
  JointLaw law;
  std::optional<contact::Model> model;  // nothing: as the law needs it
  SourceLocation where;                 // in the scene, for messages
};

struct JointOptions {
  JointLaw law = StiffnessFactor{};  // of every joint that no rule speaks of
  std::optional<contact::Model> model;
  std::vector<JointRule> rules;  // the last that speaks of a joint holds
  JointForm form = JointForm::consistent;
};

// "stiffness_factor", "conductance", "perfect" or "insulating".
std::string name_of(const JointLaw& law);

bool any_perfect(const JointOptions& joint);

// The rule that holds between two bodies; nothing: the options' own law.
const JointRule* rule_between(const JointOptions& joint, const Table<BodyId, mesh::Body>& bodies, BodyId a, BodyId b);
const JointLaw& law_between(const JointOptions& joint, const Table<BodyId, mesh::Body>& bodies, BodyId a, BodyId b);

// The search that the laws need: overlaps for a conductance and for perfect joints, semi-springs for a stiffness factor, unless
// a model is asked for; nothing where all is insulated. Joints that a rule insulates are found as well, so that a
// rule that speaks of none is noticed.
contact::ContactOptions contact_search(const JointOptions& joint, const Table<BodyId, mesh::Body>& bodies,
                                       contact::ContactOptions options);

// A problem for every rule by which no contact goes.
template <int dim>
std::vector<Problem> unused_rules(const JointOptions& joint, const mesh::BlockMesh<dim>& mesh,
                                  const contact::ContactSet<dim>& contacts);

}  // namespace scree::thermal
