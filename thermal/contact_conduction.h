// Conduction through one contact (Li & Feng 2016, section 1.5): the home of eqs. (11), (12) and (13).
//
// Eq. (11): Q_c = -beta k_b (T1 - T2)/dL A, from owner to target; beta the stiffness factor [-], k_b the mean conductivity of
// the two sides [W/m/K], dL the characteristic length of the owner's element [m], A the contact's area [m2]. T1 and T2 are
// weighted means of nodal temperatures, and the flow goes back to the nodes by the same weights, (12) for a point on a face and
// (13) for two edges. So with w the owner's weights less the target's, the flow is g w.T and the contact adds g w w^T to K:
// symmetric, rows summing to zero. Perfect joints add more: perfect_joint.h.
//
// Where we differ from the paper: (12) as printed takes T1 at the semi-spring's vertex, not where the semi-spring is. A
// temperature that varies along the face then makes heat flow where none should. JointForm::literal keeps that; the default
// takes both temperatures at the contact point, which passes a linear field.
#pragma once

#include "contact/contact_set.h"
#include "engine/base/material.h"
#include "thermal/joint_options.h"

namespace scree::thermal {

// The weights w of a contact: T1 - T2 = sum of weights times nodal temperatures. The weights sum to zero.
template <int dim>
struct TemperatureDifference {
  static constexpr int most = dim == 3 ? 4 : 2;
  int side = dim;  // entries of the owner's side, and as many of the target's behind them
  std::array<NodeId, 2 * most> nodes;
  std::array<double, 2 * most> weights{};

  void add(int first, double sign, const contact::Stencil<dim>& stencil) {
    for_each_weight(stencil, [&](NodeId node, double weight) {
      nodes[first] = node;
      weights[first++] = sign * weight;
    });
  }
};

template <int dim>
TemperatureDifference<dim> temperature_difference(const contact::Contact<dim>& contact, JointForm form) {
  const contact::Stencil<dim> owner = form == JointForm::consistent ? contact.on_owner : contact::literal_owner(contact);
  TemperatureDifference<dim> difference;
  if (owner.fourth.valid() || contact.on_target.fourth.valid()) difference.side = difference.most;
  difference.add(0, 1, owner);
  difference.add(difference.side, -1, contact.on_target);
  return difference;
}

// T1 - T2 [K] itself, from the temperatures of the mesh's nodes: without making the weights first, for a frame asks for that of
// every contact. Entries that are not used have a node, and weight zero.
template <int dim>
double temperature_drop(const contact::Contact<dim>& contact, JointForm form, const Eigen::VectorXd& temperature) {
  const auto add = [&](const contact::Stencil<dim>& side, double sign, double sum) {
    for_each_weight(side, [&](NodeId node, double weight) { sum += sign * weight * temperature[node.value()]; });
    return sum;
  };
  const bool as_found = form == JointForm::consistent;
  const double owner = as_found ? add(contact.on_owner, 1, 0) : add(contact::literal_owner(contact), 1, 0);
  return add(contact.on_target, -1, owner);
}

// What the two sides of a contact have to do with how well it conducts.
struct ContactSides {
  double mean_conductivity = 0;  // k_b of eq. (11) [W/m/K]
  double penalty = 0;            // of a perfect joint, per area (perfect_joint.h) [W/m2/K]
};

// g [W/K]: beta k_b / dL A of eq. (11), or h A. The one place that says how well a joint conducts.
// Two faces that lie on each other find each other, so the semi-springs (and semi-edges) of both sides count and each has half
// of a conductance h; an overlap counts once and has all of it.
template <int dim>
double contact_conductance(const contact::Contact<dim>& contact, const ContactSides& sides, const JointLaw& law) {
  if (const auto* beta = std::get_if<StiffnessFactor>(&law)) {
    return beta->factor * sides.mean_conductivity / contact.length * contact.area;
  }
  if (const auto* h = std::get_if<JointConductance>(&law)) {
    return h->conductance * contact.area * (contact.kind == contact::Kind::overlap ? 1 : 0.5);
  }
  return std::holds_alternative<PerfectJoint>(law) ? sides.penalty * contact.area : 0;
}

// From owner to target, unit: the owner's face's, or the mean of both faces' where they overlap.
template <int dim>
Point<dim> contact_normal(const mesh::BlockMesh<dim>& mesh, const contact::Contact<dim>& contact);

// k n of a block's conductivity tensor: n . k grad T is the heat that flows against n [W/m/K].
template <int dim>
Point<dim> conducted(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials, BlockId block,
                     const Point<dim>& normal);

// At which a joint takes a conductivity that depends on temperature, 20 C [K]. The stiffness factor is no property of matter,
// so that such joints are the same at all temperatures; perfect ones are not (perfect_joint.h).
constexpr double reference_temperature = 293.15;

// k_b: the arithmetic mean of the two sides' n . k n [W/m/K]. Both must have a conductivity.
template <int dim>
double mean_conductivity(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                         const contact::Contact<dim>& contact);

}  // namespace scree::thermal
