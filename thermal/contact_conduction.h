// Conduction through one contact (Li & Feng 2016, section 1.5): the home of eqs. (11), (12) and (13).
//
// Eq. (11): Q_c = -beta k_b (T1 - T2)/dL A, from owner to target; beta the stiffness factor [-], k_b the mean conductivity of
// the two sides [W/m/K], dL the characteristic length of the owner's element [m], A the contact's area [m2]. T1 and T2 are
// weighted means of nodal temperatures, and the flow goes back to the nodes by the same weights, (12) for a point on a face and
// (13) for two edges. So with w the owner's weights less the target's, the flow is g w.T and the contact adds g w w^T to K:
// symmetric, rows summing to zero.
//
// Where we differ from the paper: (12) as printed takes T1 at the semi-spring's vertex, not where the semi-spring is. A
// temperature that varies along the face then makes heat flow where none should. JointForm::literal keeps that; the default
// takes both temperatures at the contact point, which passes a linear field.
#pragma once

#include "contact/contact_set.h"
#include "engine/base/material.h"
#include "thermal/heat_options.h"

namespace scree::thermal {

// The weights w of a contact: T1 - T2 = sum of weights times nodal temperatures. The weights sum to zero.
template <int dim>
struct TemperatureDifference {
  std::array<NodeId, 2 * dim> nodes;
  std::array<double, 2 * dim> weights{};
};

template <int dim>
TemperatureDifference<dim> temperature_difference(const contact::Contact<dim>& contact, JointForm form);

// g = beta k_b / dL A of eq. (11) [W/K]. The one place that says how well a joint conducts.
template <int dim>
double contact_conductance(const contact::Contact<dim>& contact, double mean_conductivity, const JointOptions& joint) {
  return joint.stiffness_factor * mean_conductivity / contact.length * contact.area;
}

// k_b: the arithmetic mean of the two sides [W/m/K]. Both must have a conductivity.
template <int dim>
double mean_conductivity(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                         const contact::Contact<dim>& contact);

}  // namespace scree::thermal
