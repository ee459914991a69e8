// All contacts of a pile together: what they add to K, and the heat that flows through each.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "thermal/node_map.h"
#include "thermal/perfect_joint.h"

namespace scree::thermal {

struct JointConduction {
  std::vector<double> conductances;   // g of each contact [W/K]
  PerfectTerms perfect;               // empty unless a joint is perfect
  std::vector<Curve> conductivities;  // of each material, if any perfect term is about Phi [W/m/K]
};

template <int dim>
JointConduction joint_conduction(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                                 const contact::ContactSet<dim>& contacts, const JointOptions& joint,
                                 const DrivenNodes& driven = {});

// What the temperatures of a matrix are: T [K], or Kirchhoff's Phi where the conductivity depends on T [W/m].
enum class Field { temperature, phi };

// Adds the entries of K of the contacts that are about this field.
template <int dim>
void add_joints(const contact::ContactSet<dim>& contacts, const JointConduction& conduction, JointForm form, Field field,
                const NodeMap& rows, Eigen::SparseMatrix<double>& conductance);

// Heat flow from owner to target through each contact [W], from the temperatures of the mesh's nodes [K].
template <int dim>
std::vector<double> contact_flows(const contact::ContactSet<dim>& contacts, const JointConduction& conduction,
                                  const Eigen::VectorXd& temperature, JointForm form);

}  // namespace scree::thermal
