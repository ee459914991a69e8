#include "contact/find_contacts.h"

#include <algorithm>
#include <numeric>

#include "contact/near_faces.h"
#include "contact/overlap_search.h"
#include "contact/semi_edge.h"
#include "contact/semi_spring.h"
#include "contact/surface.h"
#include "contact/target_search.h"
#include "contact/touch.h"
#include "engine/base/check.h"
#include "engine/base/chunks.h"

namespace scree::contact {

namespace {

// What both kinds of contact take from the owner's face.
template <int dim>
Contact<dim> owned_by(const Surface<dim>& surface, FaceId owner, FaceId target, const std::array<double, dim>& weights) {
  const mesh::Face<dim>& face = surface.faces[owner];
  Contact<dim> contact;
  contact.owner = face.block;
  contact.owner_element = face.element;
  contact.target = surface.faces[target].block;
  contact.target_element = surface.faces[target].element;
  contact.length = surface.lengths[owner];
  contact.on_owner = {face.nodes, weights};
  return contact;
}

template <int dim>
Contact<dim> point_contact(const Surface<dim>& surface, const ContactOptions& options, FaceId owner, int corner,
                           FaceId target) {
  const auto touch = touch_face(surface, options, owner, corner, target);
  Contact<dim> contact = owned_by<dim>(surface, owner, target, semi_spring_weights<dim>(corner, options.indentation));
  contact.kind = Kind::point_face;
  contact.on_target = {surface.faces[target].nodes, touch.value().on_target};
  contact.area = semi_spring_area(surface, owner);
  contact.gap = touch->gap;
  return contact;
}

Contact<3> edge_contact(const Surface<3>& surface, const ContactOptions& options, FaceId owner, int side, EdgeId target) {
  const auto touch = touch_edge(surface, options, owner, side, target);
  const SurfaceEdge& edge = surface.edges[target];
  const auto weights = semi_edge_weights(side, touch.value().along, options.indentation);
  Contact<3> contact = owned_by<3>(surface, owner, edge.faces[0], weights);
  contact.kind = Kind::edge_edge;
  contact.on_target.nodes = surface.faces[edge.faces[0]].nodes;
  for (int i = 0; i < 3; ++i) {
    if (contact.on_target.nodes[i] == edge.nodes[0]) contact.on_target.weights[i] = 1 - touch->on_target;
    if (contact.on_target.nodes[i] == edge.nodes[1]) contact.on_target.weights[i] = touch->on_target;
  }
  contact.area = semi_edge_area(surface, owner);
  contact.gap = touch->gap;
  return contact;
}

// Is any pair of bodies modelled so?
bool uses(const ContactOptions& options, Model model) {
  if (options.pairs.empty()) return options.model == model;
  return std::any_of(options.pairs.begin(), options.pairs.end(),
                     [&](const Table<BodyId, Model>& row) { return std::find(row.begin(), row.end(), model) != row.end(); });
}

// A semi-spring takes its target among all blocks, and counts only if the two bodies are modelled by semi-springs: what lies on
// a block of another model does not reach past it.
template <int dim>
void add_semi_springs(const Surface<dim>& surface, const ContactOptions& options, ContactSet<dim>& set) {
  const Targets<dim> targets = find_targets(surface, options);
  const auto body_of = [&](FaceId face) { return surface.mesh.blocks[surface.faces[face].block].body; };
  const auto counts = [&](FaceId owner, FaceId target) {
    return options.model_of(body_of(owner), body_of(target)) == Model::semi_spring;
  };
  const auto visit = [&](FaceId face, const auto& on_spring, const auto& on_edge) {
    for (int corner = 0; corner < dim; ++corner) {
      const FaceId target = targets.of_springs[face.index() * dim + corner];
      if (target.valid() && counts(face, target)) on_spring(corner, target);
    }
    for (int side = 0; side < 3 && dim == 3; ++side) {
      const EdgeId target = targets.of_edges[face.index() * 3 + side];
      if (target.valid() && counts(face, surface.edges[target].faces[0])) on_edge(side, target);
    }
  };
  // How many contacts come before each chunk, then the contacts.
  const std::size_t faces = surface.faces.size();
  std::vector<std::size_t> before(chunk_count(faces) + 1, 0);
  for_chunks(faces, [&](Chunk chunk) {
    const auto count = [&](int, auto) { ++before[chunk.number + 1]; };
    for (std::size_t f = chunk.begin; f < chunk.end; ++f) visit(FaceId{f}, count, count);
  });
  std::partial_sum(before.begin(), before.end(), before.begin());
  set.contacts.resize(before.back());
  for_chunks(faces, [&](Chunk chunk) {
    Contact<dim>* next = set.contacts.data() + before[chunk.number];
    for (std::size_t f = chunk.begin; f < chunk.end; ++f) {
      const FaceId face{f};
      visit(
          face, [&](int corner, FaceId target) { *next++ = point_contact(surface, options, face, corner, target); },
          [&](int side, EdgeId target) {
            if constexpr (dim == 3) *next++ = edge_contact(surface, options, face, side, target);
          });
    }
  });
}

}  // namespace

template <int dim>
ContactSet<dim> find_contacts(const mesh::BlockMesh<dim>& mesh, const ContactOptions& options) {
  SCREE_EXPECT(options.indentation > 0 && options.indentation < 1);
  SCREE_EXPECT(options.tolerance >= 0);
  ContactSet<dim> set;
  auto faces = mesh::boundary_faces(mesh);
  if (uses(options, Model::semi_spring)) {
    set.semi_springs = faces.size() * dim;
    set.semi_edges = dim == 3 ? faces.size() * 3 : 0;
  }
  const Surface<dim> surface = make_surface(mesh, near_faces(mesh, std::move(faces), {options.tolerance, options.indentation}));
  if (uses(options, Model::semi_spring)) add_semi_springs(surface, options, set);
  if (uses(options, Model::overlap)) {
    auto overlaps = overlap_contacts(surface, options);
    if (set.contacts.empty()) {
      set.contacts = std::move(overlaps);
    } else {
      set.contacts.insert(set.contacts.end(), overlaps.begin(), overlaps.end());
    }
  }
  return set;
}

template ContactSet<2> find_contacts<2>(const mesh::BlockMesh<2>&, const ContactOptions&);
template ContactSet<3> find_contacts<3>(const mesh::BlockMesh<3>&, const ContactOptions&);

}  // namespace scree::contact
