#include "contact/hidden_overlaps.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "contact/overlap.h"
#include "engine/base/check.h"
#include "engine/base/chunks.h"
#include "engine/base/collected.h"
#include "engine/base/grouped.h"

namespace scree::contact {

namespace {

constexpr double on_face = 1e-9;  // of the contact's length

// Is a point further than that from the box about these corners?
template <int dim>
bool beside(const Corners<dim>& corners, const Point<dim>& point, double near) {
  Aabb<dim> box;
  for (const Point<dim>& corner : corners) box.extend(corner);
  return box.squaredExteriorDistance(point) > near * near;
}

template <int dim>
bool may_be_hidden(const Contact<dim>& contact) {
  return contact.kind == Kind::overlap && std::abs(contact.gap) > least_gap * contact.length;
}

template <int dim>
bool any_may_be_hidden(const Contacts<dim>& contacts) {
  std::atomic<bool> any = false;
  for_chunks(contacts.size(), [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end && !any.load(std::memory_order_relaxed); ++i) {
      if (may_be_hidden(contacts[i])) any.store(true, std::memory_order_relaxed);
    }
  });
  return any;
}

// Which faces touch which, of those to which something touches across a gap.
template <int dim>
class Partners {
 public:
  Partners(const Surface<dim>& surface, const Contacts<dim>& contacts)
      : surface_(surface), starts_(block_starts(surface.mesh, surface.faces)) {
    const Table<FaceId, std::uint8_t> asked = faces_to_ask(contacts);
    const auto pairs = collected<std::vector<Pair>>(contacts.size(), [&](Chunk chunk, std::vector<Pair>& found) {
      Pair last;
      for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
        if (contacts[i].kind == Kind::edge_edge) continue;
        const Pair pair{owner_of(contacts[i]), target_of(contacts[i])};
        if (pair == last) continue;  // another point of the same two
        last = pair;
        if (asked[pair.first] != 0) found.push_back(pair);
        if (asked[pair.second] != 0) found.emplace_back(pair.second, pair.first);
      }
    });
    partners_ = grouped<FaceId>(chunk_count(pairs.size()), surface.faces.size(), [&](std::size_t part, const auto& visit) {
      const Chunk chunk = chunk_of(pairs.size(), part);
      for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
        visit(static_cast<std::uint32_t>(pairs[i].first.value()), pairs[i].second);
      }
    });
  }

  [[nodiscard]] bool hide(const Contact<dim>& contact) const {
    return stands_before(owner_of(contact), point_of(surface_.mesh, contact.on_owner), contact.target, contact) ||
           stands_before(target_of(contact), point_of(surface_.mesh, contact.on_target), contact.owner, contact);
  }

 private:
  using Pair = std::pair<FaceId, FaceId>;

  [[nodiscard]] Table<FaceId, std::uint8_t> faces_to_ask(const Contacts<dim>& contacts) const {
    Table<FaceId, std::uint8_t> asked(surface_.faces.size(), 0);
    const auto ask = [&](FaceId face) { std::atomic_ref(asked[face]).store(1, std::memory_order_relaxed); };
    for_chunks(contacts.size(), [&](Chunk chunk) {
      for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
        if (!may_be_hidden(contacts[i])) continue;
        ask(owner_of(contacts[i]));
        ask(target_of(contacts[i]));
      }
    });
    return asked;
  }

  [[nodiscard]] FaceId owner_of(const Contact<dim>& contact) const {
    return face_of(contact.owner, contact.owner_element, contact.on_owner.nodes);
  }
  [[nodiscard]] FaceId target_of(const Contact<dim>& contact) const {
    return face_of(contact.target, contact.target_element, contact.on_target.nodes);
  }

  // Faces come in the order of their blocks and elements.
  [[nodiscard]] FaceId face_of(BlockId block, ElementId element, const std::array<NodeId, dim>& nodes) const {
    const auto at = [&](std::size_t place) { return surface_.faces.raw().begin() + static_cast<std::ptrdiff_t>(place); };
    const auto end = at(starts_[block.index() + 1]);
    auto face = std::partition_point(at(starts_[block.index()]), end,
                                     [&](const mesh::Face<dim>& one) { return one.element < element; });
    while (face != end && face->nodes != nodes) ++face;
    SCREE_EXPECT(face != end);
    return FaceId{static_cast<std::size_t>(face - at(0))};
  }

  // Does a face of a block but `beyond` that touches `face` stand before the other side of the contact?
  [[nodiscard]] bool stands_before(FaceId face, const Point<dim>& point, BlockId beyond, const Contact<dim>& contact) const {
    const double near = contact.gap - least_gap * contact.length;
    const double on_it = std::max(on_face * contact.length, surface_.rounding);
    const Point<dim>& along = surface_.normals[face];
    for (const FaceId other : partners_.of(face.index())) {
      if (surface_.faces[other].block == beyond) continue;
      const Point<dim>& normal = surface_.normals[other];
      const Corners<dim> corners = corners_of(surface_, other);
      const double slope = along.dot(normal);
      if (slope >= 0) continue;
      const double way = (corners[0] - point).dot(normal) / slope;
      if (way >= near) continue;
      const Point<dim> hit = point + way * along;
      if (beside<dim>(corners, hit, on_it)) continue;  // most are, and that is soon seen
      const double off = (weighted_point<dim>(corners, closest_weights<dim>(corners, hit)) - hit).norm();
      if (off <= on_it) return true;
    }
    return false;
  }

  const Surface<dim>& surface_;
  std::vector<std::size_t> starts_;  // of each block's faces
  Grouped<FaceId, std::size_t> partners_;
};

}  // namespace

template <int dim>
void drop_hidden_overlaps(const Surface<dim>& surface, Contacts<dim>& contacts) {
  if (!any_may_be_hidden(contacts)) return;
  const Partners<dim> partners(surface, contacts);
  std::vector<std::uint8_t> hidden(contacts.size(), 0);
  for_chunks(contacts.size(), [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      hidden[i] = may_be_hidden(contacts[i]) && partners.hide(contacts[i]) ? 1 : 0;
    }
  });
  if (std::none_of(hidden.begin(), hidden.end(), [](std::uint8_t one) { return one != 0; })) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (hidden[i] == 0) contacts[kept++] = contacts[i];
  }
  contacts.resize(kept);
}

template void drop_hidden_overlaps<2>(const Surface<2>&, Contacts<2>&);
template void drop_hidden_overlaps<3>(const Surface<3>&, Contacts<3>&);

}  // namespace scree::contact
