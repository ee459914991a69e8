#include "contact/find_contacts.h"

#include <algorithm>
#include <numeric>

#include "contact/both_diagonals.h"
#include "contact/hidden_contacts.h"
#include "contact/near_faces.h"
#include "contact/overlap_search.h"
#include "contact/semi_edge.h"
#include "contact/semi_spring.h"
#include "contact/surface.h"
#include "contact/target_search.h"
#include "engine/base/brief_waits.h"
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
  contact.on_owner = {face.nodes, {}, weights};
  return contact;
}

template <int dim>
Contact<dim> point_contact(const Surface<dim>& surface, const ContactOptions& options, const PointAndFace& pair,
                           const SpringTouch<dim>& touch) {
  const auto& [owner, corner, target] = pair;
  Contact<dim> contact = owned_by<dim>(surface, owner, target, semi_spring_weights<dim>(corner, options.indentation));
  contact.kind = Kind::point_face;
  contact.on_target = {surface.faces[target].nodes, {}, touch.on_target};
  contact.area = semi_spring_area(surface, owner);
  contact.gap = touch.gap;
  return contact;
}

Contact<3> edge_contact(const Surface<3>& surface, const ContactOptions& options, const TakenEdge& taken) {
  const FaceId owner{taken.semi_edge / 3};
  const auto side = static_cast<int>(taken.semi_edge % 3);
  const SurfaceEdge& edge = surface.edges[taken.target];
  const auto weights = semi_edge_weights(side, taken.touch.along, options.indentation);
  Contact<3> contact = owned_by<3>(surface, owner, edge.faces[0], weights);
  contact.kind = Kind::edge_edge;
  contact.on_target.nodes = surface.faces[edge.faces[0]].nodes;
  for (int i = 0; i < 3; ++i) {
    if (contact.on_target.nodes[i] == edge.nodes[0]) contact.on_target.weights[i] = 1 - taken.touch.on_target;
    if (contact.on_target.nodes[i] == edge.nodes[1]) contact.on_target.weights[i] = taken.touch.on_target;
  }
  contact.area = semi_edge_area(surface, owner);
  contact.gap = taken.touch.gap;
  return contact;
}

// Is any pair of bodies modelled so?
bool uses(const ContactOptions& options, Model model) {
  if (options.pairs.empty()) return options.model == model;
  return std::any_of(options.pairs.begin(), options.pairs.end(),
                     [&](const Table<BodyId, Model>& row) { return std::find(row.begin(), row.end(), model) != row.end(); });
}

// The contacts of semi-springs and semi-edges, each put where it belongs: the number of contacts of the faces before tells
// where.
//
// A semi-spring takes its target among all blocks, and counts only if the two bodies are modelled by semi-springs: what lies on
// a block of another model does not reach past it.
template <int dim>
class SemiSprings {
 public:
  SemiSprings(const Surface<dim>& surface, const ContactOptions& options)
      : surface_(surface), options_(options), targets_(find_targets(surface, options)), starts_(surface.faces.size() + 1, 0) {
    for_chunks(surface.faces.size(), [&](Chunk chunk) {
      auto edge = first_edge_from(chunk.begin);
      for (std::size_t f = chunk.begin; f < chunk.end; ++f) {
        starts_[f + 1] = springs_of(FaceId{f});
        for_each_edge(FaceId{f}, edge, [&](const TakenEdge&) { ++starts_[f + 1]; });
      }
    });
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  }

  [[nodiscard]] std::size_t count() const { return starts_.back(); }

  void put_into(Contacts<dim>& contacts) const {
    for_chunks(surface_.faces.size(), [&](Chunk chunk) {
      Contact<dim>* next = contacts.data() + starts_[chunk.begin];
      auto edge = first_edge_from(chunk.begin);
      for (std::size_t f = chunk.begin; f < chunk.end; ++f) {
        for (int corner = 0; corner < dim; ++corner) {
          const FaceId target = target_of(FaceId{f}, corner);
          if (!target.valid() || !counts(FaceId{f}, target)) continue;
          const auto& touch = targets_.of_springs.touches[f * dim + static_cast<std::size_t>(corner)];
          *next++ = point_contact(surface_, options_, {FaceId{f}, corner, target}, touch);
        }
        if constexpr (dim == 3) {
          for_each_edge(FaceId{f}, edge, [&](const TakenEdge& taken) { *next++ = edge_contact(surface_, options_, taken); });
        }
      }
    });
  }

 private:
  [[nodiscard]] BodyId body_of(FaceId face) const { return surface_.mesh.blocks[surface_.faces[face].block].body; }

  [[nodiscard]] bool counts(FaceId owner, FaceId target) const {
    return options_.pairs.empty() || options_.model_of(body_of(owner), body_of(target)) == Model::semi_spring;
  }

  [[nodiscard]] FaceId target_of(FaceId face, int corner) const {
    return targets_.of_springs.faces[face.index() * dim + static_cast<std::size_t>(corner)];
  }

  // How many of a face's semi-springs count.
  [[nodiscard]] std::size_t springs_of(FaceId face) const {
    std::size_t count = 0;
    for (int corner = 0; corner < dim; ++corner) {
      const FaceId target = target_of(face, corner);
      count += target.valid() && counts(face, target) ? 1 : 0;
    }
    return count;
  }

  using Edge = std::vector<TakenEdge>::const_iterator;

  // The first semi-edge that has a target, of this face or a later one.
  [[nodiscard]] Edge first_edge_from(std::size_t face) const {
    return std::lower_bound(targets_.of_edges.begin(), targets_.of_edges.end(), face * 3,
                            [](const TakenEdge& taken, std::size_t semi_edge) { return taken.semi_edge < semi_edge; });
  }

  // Those of the face that count, of which `edge` is the first; then it is the first of the next face.
  template <class Visit>
  void for_each_edge(FaceId face, Edge& edge, const Visit& visit) const {
    for (; edge != targets_.of_edges.end() && edge->semi_edge < (face.index() + 1) * 3; ++edge) {
      if (counts(face, surface_.edges[edge->target].faces[0])) visit(*edge);
    }
  }

  const Surface<dim>& surface_;
  const ContactOptions& options_;
  Targets<dim> targets_;
  LargeVector<std::size_t> starts_;  // of the contacts of each face, and the end
};

}  // namespace

template <int dim>
ContactSet<dim> find_contacts(const mesh::BlockMesh<dim>& mesh, const ContactOptions& options) {
  SCREE_EXPECT(options.indentation > 0 && options.indentation < 1);
  SCREE_EXPECT(options.tolerance >= 0);
  wait_briefly();
  ContactSet<dim> set;
  auto faces = mesh::boundary_faces(mesh);
  const std::size_t all = faces.size();
  Surface<dim> surface = surface_of(mesh, near_faces(mesh, std::move(faces), {options.tolerance, options.indentation}));
  if (uses(options, Model::semi_spring)) {
    set.semi_springs = all * dim;
    set.semi_edges = dim == 3 ? all * 3 : 0;
    add_rims(surface);
    const SemiSprings<dim> semi_springs(surface, options);
    set.contacts.resize(semi_springs.count());
    semi_springs.put_into(set.contacts);
  }
  if (uses(options, Model::overlap)) {
    auto overlaps = overlap_contacts(surface, options);
    if (set.contacts.empty()) {
      set.contacts = std::move(overlaps);
    } else {
      set.contacts.insert(set.contacts.end(), overlaps.begin(), overlaps.end());
    }
  }
  drop_hidden_contacts(surface, options, set.contacts);
  if constexpr (dim == 3) see_both_diagonals(mesh, set.contacts);
  return set;
}

template ContactSet<2> find_contacts<2>(const mesh::BlockMesh<2>&, const ContactOptions&);
template ContactSet<3> find_contacts<3>(const mesh::BlockMesh<3>&, const ContactOptions&);

}  // namespace scree::contact
