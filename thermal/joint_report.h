// What the contacts amount to, per pair of bodies, for the summary.
//
// beta k/dL [W/m2/K] grows as the mesh is refined: beta is no property of a joint, its conductance h is. The report states each
// in terms of the other: whichever the law gives, beta is what semi-springs would need to conduct as much in all.
#pragma once

#include "thermal/heat_model.h"
#include "thermal/joint_conduction.h"

namespace scree::thermal {

// All contacts between blocks of `first` and blocks of `second`, in both directions; both may be the same body. Of a perfect
// joint every conductance, beta and the Biot number are infinite.
struct JointReport {
  BodyId first;  // first <= second
  BodyId second;
  std::string law;
  std::size_t point_face = 0;
  std::size_t edge_edge = 0;
  std::size_t overlap = 0;      // quadrature points
  double stiffness_factor = 0;  // beta [-]
  double area = 0;              // of all contacts, (9) and (10) [m2]
  // Of the two faces that lie on each other: half of the semi-springs' area, as both sides' semi-springs count, and all of the
  // overlaps' [m2].
  double touching_area = 0;
  // g/A of single contacts, the mean weighted by area [W/m2/K].
  double least_conductance = 0;
  double mean_conductance = 0;
  double largest_conductance = 0;
  // h of the joint as a whole: the sum of all conductances over the touching area, where only edges meet half of theirs
  // [W/m2/K]; of semi-springs about twice the mean.
  double joint_conductance = 0;
  // h L/k with the joint's h and, as L, the root of the owner's volume, mean over the contacts: far below 1 the joints resist,
  // far above 1 the blocks do [-].
  double biot = 0;
  double flow = 0;           // from first to second, net [W]; 0 within one body
  double absolute_flow = 0;  // sum of |flow| of all contacts [W]
};

// In the order of (first, second). `flows` as by contact_flows.
template <int dim>
std::vector<JointReport> joint_reports(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                                       const contact::ContactSet<dim>& contacts, const JointOptions& joint,
                                       const std::vector<double>& flows);

}  // namespace scree::thermal
