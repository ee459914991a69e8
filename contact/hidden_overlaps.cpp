#include "contact/hidden_overlaps.h"

#include <algorithm>

#include "engine/base/check.h"
#include "engine/base/chunks.h"

namespace scree::contact {

namespace {

constexpr double least_gap = 1e-4;  // of the contact's length
constexpr double rounding = 1e-9;   // likewise

template <int dim>
bool may_be_hidden(const Contact<dim>& contact) {
  return contact.kind == Kind::overlap && contact.gap > least_gap * contact.length;
}

// Which faces touch which, of those to which something touches across a gap.
template <int dim>
class Partners {
 public:
  Partners(const Surface<dim>& surface, const Contacts<dim>& contacts) : surface_(surface), asked_(surface.faces.size(), 0) {
    for (const Contact<dim>& contact : contacts) {
      if (!may_be_hidden(contact)) continue;
      asked_[owner_of(contact)] = 1;
      asked_[target_of(contact)] = 1;
    }
    for (const Contact<dim>& contact : contacts) {
      if (contact.kind == Kind::edge_edge) continue;
      const FaceId owner = owner_of(contact), target = target_of(contact);
      if (asked_[owner] != 0) pairs_.emplace_back(owner, target);
      if (asked_[target] != 0) pairs_.emplace_back(target, owner);
    }
    std::sort(pairs_.begin(), pairs_.end());
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
  }

  [[nodiscard]] bool hide(const Contact<dim>& contact) const {
    return stands_before(owner_of(contact), point_of(surface_.mesh, contact.on_owner), contact.target, contact) ||
           stands_before(target_of(contact), point_of(surface_.mesh, contact.on_target), contact.owner, contact);
  }

 private:
  using Pair = std::pair<FaceId, FaceId>;

  [[nodiscard]] FaceId owner_of(const Contact<dim>& contact) const {
    return face_of(contact.owner, contact.owner_element, contact.on_owner.nodes);
  }
  [[nodiscard]] FaceId target_of(const Contact<dim>& contact) const {
    return face_of(contact.target, contact.target_element, contact.on_target.nodes);
  }

  // Faces come in the order of their blocks and elements.
  [[nodiscard]] FaceId face_of(BlockId block, ElementId element, const std::array<NodeId, dim>& nodes) const {
    const auto& faces = surface_.faces.raw();
    auto face = std::partition_point(faces.begin(), faces.end(), [&](const mesh::Face<dim>& one) {
      return one.block < block || (one.block == block && one.element < element);
    });
    while (face != faces.end() && face->nodes != nodes) ++face;
    SCREE_EXPECT(face != faces.end());
    return FaceId{static_cast<std::size_t>(face - faces.begin())};
  }

  // Does a face of a block but `beyond` that touches `face` stand before the other side of the contact?
  [[nodiscard]] bool stands_before(FaceId face, const Point<dim>& point, BlockId beyond, const Contact<dim>& contact) const {
    const double near = contact.gap - least_gap * contact.length;
    auto pair = std::lower_bound(pairs_.begin(), pairs_.end(), Pair{face, FaceId{0}});
    for (; pair != pairs_.end() && pair->first == face; ++pair) {
      const FaceId other = pair->second;
      if (surface_.faces[other].block == beyond) continue;
      const Point<dim>& along = surface_.normals[face];
      const Point<dim>& normal = surface_.normals[other];
      const Corners<dim> corners = corners_of(surface_, other);
      const double slope = along.dot(normal);
      if (slope >= 0) continue;
      const double way = (corners[0] - point).dot(normal) / slope;
      if (way >= near) continue;
      const Point<dim> hit = point + way * along;
      const double off = (weighted_point<dim>(corners, closest_weights<dim>(corners, hit)) - hit).norm();
      if (off <= rounding * contact.length) return true;
    }
    return false;
  }

  const Surface<dim>& surface_;
  Table<FaceId, std::uint8_t> asked_;
  std::vector<Pair> pairs_;
};

}  // namespace

template <int dim>
void drop_hidden_overlaps(const Surface<dim>& surface, Contacts<dim>& contacts) {
  if (std::none_of(contacts.begin(), contacts.end(), may_be_hidden<dim>)) return;
  const Partners<dim> partners(surface, contacts);
  std::vector<std::uint8_t> hidden(contacts.size(), 0);
  for_chunks(contacts.size(), [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      hidden[i] = may_be_hidden(contacts[i]) && partners.hide(contacts[i]) ? 1 : 0;
    }
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (hidden[i] == 0) contacts[kept++] = contacts[i];
  }
  contacts.resize(kept);
}

template void drop_hidden_overlaps<2>(const Surface<2>&, Contacts<2>&);
template void drop_hidden_overlaps<3>(const Surface<3>&, Contacts<3>&);

}  // namespace scree::contact
