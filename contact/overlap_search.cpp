#include "contact/overlap_search.h"

#include <algorithm>
#include <array>
#include <bit>

#include <boost/container/static_vector.hpp>

#include "contact/both_diagonals.h"
#include "contact/hidden_contacts.h"
#include "contact/near_faces.h"
#include "contact/near_shells.h"
#include "contact/overlap.h"
#include "engine/base/chunks.h"
#include "engine/base/collected.h"
#include "engine/base/grouped.h"
#include "engine/base/parts.h"
#include "engine/mesh/cells.h"

namespace scree::contact {

namespace {

using FacePairs = std::vector<std::pair<FaceId, FaceId>>;

// The faces of an element all of whose corners are in a set of vertices, one bit each.
template <int dim>
constexpr std::array<std::uint8_t, 16> faces_among = [] {
  std::array<std::uint8_t, 16> faces{};
  for (unsigned vertices = 0; vertices < 16; ++vertices) {
    for (unsigned f = 0; f <= dim; ++f) {
      bool all = true;
      for (const int corner : mesh::opposite_corners<dim>[f]) all = all && (vertices >> corner & 1u) != 0;
      faces[vertices] = static_cast<std::uint8_t>(faces[vertices] | (all ? 1u : 0u) << f);
    }
  }
  return faces;
}();

// Of each pair of shells the pairs of faces that may lie on each other.
template <int dim, class Wide>
SCREE_INLINE void add_faces(const ShellPairs<dim, Wide>& pairs, const auto& wanted, FacePairs& found) {
  constexpr auto cosine = static_cast<float>(least_opposed);
  // Heights above an inclined plane are at most 1/cos of the gap between the faces.
  const auto reach = in_eights<Wide>(
      [&](int k) SCREE_INLINED { return std::min(pairs.first.reach, pairs.second(k).reach) / cosine + pairs.rounding(k); });
  // Of each plane the vertices that are further above or below it.
  std::array<unsigned, dim + 1> above, below_it;
  for (int t = 0; t <= dim; ++t) {
    above[t] = bits(below(reach, pairs.by_plane[t]));
    below_it[t] = bits(below(pairs.by_plane[t], -reach));
  }
  const Shell<dim>& a = pairs.first;
  pairs.for_each([&](auto k) SCREE_INLINED {
    const Shell<dim>& b = pairs.second(k);
    if (!wanted(a, b)) return;
    // Which faces of the one come within reach of plane t of the other, not those that lie beyond as a whole.
    const auto within = [&](int t, int four) SCREE_INLINED {
      const int shift = lane_count * (2 * k + four);
      return ~(faces_among<dim>[above[t] >> shift & 0xfu] | faces_among<dim>[below_it[t] >> shift & 0xfu]);
    };
    for (int i = 0; i <= dim; ++i) {
      if ((a.faces >> i & 1u) == 0) continue;
      for (unsigned left = static_cast<unsigned>(within(i, 0)) & b.faces; left != 0; left &= left - 1) {
        const int j = std::countr_zero(left);
        if ((static_cast<unsigned>(within(j, 1)) >> i & 1u) == 0) continue;
        float opposed = 0;
        for (int axis = 0; axis < dim; ++axis) opposed -= a.normals[axis][i] * b.normals[axis][j];
        constexpr float rounding = 1e-6F;
        if (opposed >= cosine - rounding) found.push_back(std::minmax(a.face(i), b.face(j)));
      }
    }
  });
}

// The second faces of pairs, by the first, ascending.
using OrderedPairs = Grouped<FaceId, std::size_t>;

// In the order of their faces, which takes no sorting of them all: those of a face are few.
OrderedPairs ordered(const Parts<FacePairs::value_type>& parts, std::size_t faces) {
  auto pairs = grouped<FaceId>(parts.count(), faces, [&](std::size_t part, const auto& visit) {
    for (const auto& [first, second] : parts[part]) visit(static_cast<std::uint32_t>(first.value()), second);
  });
  for_chunks(faces, [&](Chunk chunk) {
    for (std::size_t f = chunk.begin; f < chunk.end; ++f) std::ranges::sort(pairs.of(f));
  });
  return pairs;
}

// Pairs that cheap bounds do not dismiss.
template <int dim, class Wanted>
OrderedPairs near_pairs(const Surface<dim>& surface, double tolerance, const Wanted& wanted) {
  const ShellTable<dim> table = make_shells(surface, {tolerance, 0});
  const auto body_of = [&](const Shell<dim>& shell) { return surface.mesh.blocks[shell.block].body; };
  Parts<FacePairs::value_type> found(chunk_count(table.shells.size()));
  visit_near<FacePairs>(
      table,
      [&](const auto& pairs, FacePairs& faces) SCREE_INLINED {
        const auto both = [&](const Shell<dim>& a, const Shell<dim>& b) { return wanted(body_of(a), body_of(b)); };
        add_faces(pairs, both, faces);
      },
      [&](std::size_t chunk, const FacePairs& pairs) { found.put(chunk, pairs); });
  return ordered(found, surface.faces.size());
}

template <int dim>
Contact<dim> as_contact(const Surface<dim>& surface, FaceId first, FaceId second, const OverlapPoint<dim>& at) {
  Contact<dim> contact;
  contact.kind = Kind::overlap;
  contact.owner = surface.faces[first].block;
  contact.target = surface.faces[second].block;
  contact.on_owner = {surface.faces[first].nodes, {}, at.on_first};
  contact.on_target = {surface.faces[second].nodes, {}, at.on_second};
  contact.owner_element = surface.faces[first].element;
  contact.target_element = surface.faces[second].element;
  contact.area = at.area;
  contact.length = 1 / (1 / surface.lengths[first] + 1 / surface.lengths[second]);
  contact.gap = at.gap;
  return contact;
}

// The points of the overlap of two faces.
template <int dim>
class WholeFaces {
 public:
  WholeFaces(const Surface<dim>& surface, double tolerance) : surface_(surface), tolerance_(tolerance) {}

  void find(FaceId first, FaceId second, std::vector<OverlapPoint<dim>>& points) const {
    find(first, corners_of(surface_, first), second, corners_of(surface_, second), points);
  }

  // Of a part of each.
  void find(FaceId first, const Corners<dim>& of_first, FaceId second, const Corners<dim>& of_second,
            std::vector<OverlapPoint<dim>>& points) const {
    points.clear();
    const auto pair = opposed_faces<dim>(of_first, surface_.normals[first], of_second, surface_.normals[second]);
    if (pair) overlap_points(*pair, tolerance_ * std::min(surface_.lengths[first], surface_.lengths[second]), points);
  }

 private:
  const Surface<dim>& surface_;
  double tolerance_;
};

// The same where the triangles of cells' quadrilaterals are cut in two (both_diagonals.h), so that what is not linear in them
// is integrated exactly, too.
class HalvedFaces {
 public:
  HalvedFaces(const Surface<3>& surface, double tolerance)
      : surface_(surface), faces_(surface, tolerance), cells_(surface.mesh) {}

  void find(FaceId first, FaceId second, std::vector<OverlapPoint<3>>& points) const {
    faces_.find(first, second, points);
    if (points.empty()) return;  // most pairs have a side in common only
    const Parts of_first = parts(first), of_second = parts(second);
    if (of_first.size() == 1 && of_second.size() == 1) return;
    points.clear();
    std::vector<OverlapPoint<3>> of_parts;
    for (const TrianglePart& a : of_first) {
      for (const TrianglePart& b : of_second) {
        faces_.find(first, corners_in(first, a), second, corners_in(second, b), of_parts);
        for (const OverlapPoint<3>& at : of_parts) {
          points.push_back({in_whole(a, at.on_first), in_whole(b, at.on_second), at.area, at.gap});
        }
      }
    }
  }

 private:
  using Parts = boost::container::static_vector<TrianglePart, 2>;

  [[nodiscard]] Parts parts(FaceId face) const {
    const CellId cell = cells_[surface_.faces[face].element];
    if (cell.valid()) {
      if (const auto both = halves(surface_.mesh, surface_.mesh.cells[cell], surface_.faces[face].nodes)) {
        return {both->begin(), both->end()};
      }
    }
    return {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
  }

  [[nodiscard]] Corners<3> corners_in(FaceId face, const TrianglePart& part) const {
    const Corners<3> whole = corners_of(surface_, face);
    Corners<3> corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = weighted_point<3>(whole, part[i]);
    return corners;
  }

  static std::array<double, 3> in_whole(const TrianglePart& part, const std::array<double, 3>& weights) {
    std::array<double, 3> of_whole{};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t corner = 0; corner < 3; ++corner) of_whole[corner] += weights[i] * part[i][corner];
    }
    return of_whole;
  }

  const Surface<3>& surface_;
  WholeFaces<3> faces_;
  mesh::CellOfElement<3> cells_;
};

// The contacts of every overlap of bodies of which wanted(one, other) is true, in the ascending order of the pairs of faces,
// first < second. On all threads.
template <int dim, class Faces, class Wanted>
Contacts<dim> contacts_of(const Surface<dim>& surface, double tolerance, const Faces& overlaps, const Wanted& wanted) {
  const OrderedPairs pairs = near_pairs(surface, tolerance, wanted);
  return collected<Contacts<dim>>(surface.faces.size(), [&](Chunk chunk, std::vector<Contact<dim>>& contacts) {
    std::vector<OverlapPoint<dim>> points;
    for (std::size_t f = chunk.begin; f < chunk.end; ++f) {
      for (const FaceId second : pairs.of(f)) {
        overlaps.find(FaceId{f}, second, points);
        for (const auto& point : points) contacts.push_back(as_contact<dim>(surface, FaceId{f}, second, point));
      }
    }
  });
}

}  // namespace

template <int dim>
Contacts<dim> overlap_contacts(const Surface<dim>& surface, const ContactOptions& options) {
  const auto wanted = [&](BodyId a, BodyId b) { return options.model_of(a, b) == Model::overlap; };
  if constexpr (dim == 3) {
    const bool cells = !surface.mesh.cells.empty();
    if (cells) return contacts_of(surface, options.tolerance, HalvedFaces(surface, options.tolerance), wanted);
  }
  return contacts_of(surface, options.tolerance, WholeFaces<dim>(surface, options.tolerance), wanted);
}

template <int dim>
std::map<std::pair<BodyId, BodyId>, double> overlap_areas(const mesh::BlockMesh<dim>& mesh, const ContactSet<dim>& contacts,
                                                          const ContactOptions& options) {
  const auto bodies_of = [&](BlockId a, BlockId b) -> std::pair<BodyId, BodyId> {
    return std::minmax(mesh.blocks[a].body, mesh.blocks[b].body);
  };
  std::map<std::pair<BodyId, BodyId>, double> areas;
  bool any_semi_springs = false;
  for (const Contact<dim>& contact : contacts.contacts) {
    if (contact.kind == Kind::overlap) {
      areas[bodies_of(contact.owner, contact.target)] += contact.area;
    } else {
      any_semi_springs = true;
    }
  }
  if (!any_semi_springs) return areas;
  const Surface<dim> surface = surface_of(mesh, near_faces(mesh, mesh::boundary_faces(mesh), {options.tolerance, 0}));
  Contacts<dim> overlaps = contacts_of(surface, options.tolerance, WholeFaces<dim>(surface, options.tolerance),
                                       [&](BodyId a, BodyId b) { return options.model_of(a, b) == Model::semi_spring; });
  drop_hidden_contacts(surface, options, overlaps);
  for (const Contact<dim>& contact : overlaps) areas[bodies_of(contact.owner, contact.target)] += contact.area;
  return areas;
}

#define SCREE_INSTANTIATE(dim)                                                                                                 \
  template Contacts<dim> overlap_contacts<dim>(const Surface<dim>&, const ContactOptions&);                                    \
  template std::map<std::pair<BodyId, BodyId>, double> overlap_areas<dim>(const mesh::BlockMesh<dim>&, const ContactSet<dim>&, \
                                                                          const ContactOptions&);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE

}  // namespace scree::contact
