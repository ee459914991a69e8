// The one entry point of the contact room.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "contact/contact_set.h"

namespace scree::contact {

enum class Model : std::uint8_t {
  none,         // not looked for
  semi_spring,  // semi-springs and semi-edges
  overlap,      // the polygon in which two faces overlap
};

struct ContactOptions {
  double indentation = 0.05;  // way from the vertex to the centre of its face, in (0, 1); the paper uses 0.01 to 0.05
  double tolerance =
      0.01;  // largest gap or depth, of the semi-spring or its vertex, in characteristic lengths of the owner's element
  Model model = Model::semi_spring;
  // Where pairs of bodies differ: of each body with each, both ways. Empty: all pairs have the model above.
  Table<BodyId, Table<BodyId, Model>> pairs{};

  [[nodiscard]] Model model_of(BodyId a, BodyId b) const { return pairs.empty() ? model : pairs[a][b]; }
};

// Semi-springs and semi-edges of every block against the target faces and target edges of all other blocks (Li & Feng 2016,
// section 1.4), and the overlaps of faces, each for the pairs of bodies that are modelled so. Coarse search by cells of space,
// linear in the number of faces; exact per face and edge.
template <int dim>
ContactSet<dim> find_contacts(const mesh::BlockMesh<dim>& mesh, const ContactOptions& options);

// The true area in which the blocks of each two bodies (first <= second) lie on each other, where they touch, whatever their
// model [m2]: of the overlaps that find_contacts() found, and for pairs with semi-springs by a search of its own.
template <int dim>
std::map<std::pair<BodyId, BodyId>, double> overlap_areas(const mesh::BlockMesh<dim>& mesh, const ContactSet<dim>& contacts,
                                                          const ContactOptions& options);

}  // namespace scree::contact
