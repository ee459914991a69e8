#include "contact/hidden_contacts.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "contact/near_shells.h"
#include "contact/semi_edge.h"
#include "engine/base/chunks.h"

namespace scree::contact {

namespace {

constexpr double least_gap = 1e-4;  // of the contact's length
constexpr double on_face = 1e-9;    // likewise

// Is a point further than that from the box about these corners?
template <int dim>
bool beside(const Corners<dim>& corners, const Point<dim>& point, double near) {
  Aabb<dim> box;
  for (const Point<dim>& corner : corners) box.extend(corner);
  return box.squaredExteriorDistance(point) > near * near;
}

template <int dim>
bool may_be_hidden(const Contact<dim>& contact) {
  return contact.kind != Kind::point_face && std::abs(contact.gap) > least_gap * contact.length;
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

// From a point of one block to another block.
template <int dim>
struct Sight {
  BlockId own;
  ElementId element;  // of its own block, at the point
  Point<dim> from;
  Point<dim> along;  // unit
  double near;       // what stands before is nearer than this, negative within the block beyond [m]
};

// What is asked of a contact. An overlap is hidden from either side, a semi-edge from its edge, too.
template <int dim>
struct Asked {
  std::size_t contact;
  std::array<Sight<dim>, 2> sights;
  bool both;
  double length;  // the contact's [m]
  std::array<bool, 2> sees_another{};

  [[nodiscard]] bool hidden() const { return both ? sees_another[0] && sees_another[1] : sees_another[0] || sees_another[1]; }
};

// Whether something stands between the points of contacts; for one thread.
template <int dim>
class Between {
 public:
  Between(const Surface<dim>& surface, const ContactOptions& options, const Contacts<dim>& contacts,
          const ShellTable<dim>& table)
      : surface_(surface), options_(options), contacts_(contacts), table_(table) {}

  // Marks those that are hidden among some contacts that follow one another and have the same faces.
  void mark(Chunk run, std::vector<std::uint8_t>& hidden) {
    asked_.clear();
    for (std::size_t i = run.begin; i < run.end; ++i) {
      if (!may_be_hidden(contacts_[i])) continue;
      if (lies_behind(contacts_[i])) {
        hidden[i] = 1;
      } else {
        asked_.push_back(asked_of(i));
      }
    }
    if (asked_.empty()) return;
    if (asked_.front().both) {  // a semi-edge, alone: most see nothing
      look(contacts_[run.begin], 0, 1);
      if (asked_.front().sees_another[0]) look(contacts_[run.begin], 1, 2);
    } else {
      look(contacts_[run.begin], 0, 2);
    }
    for (const Asked<dim>& asked : asked_) {
      if (asked.hidden()) hidden[asked.contact] = 1;
    }
  }

 private:
  // Two points behind each other, neither in the other's block: those of slanted faces on both sides of a joint, or of the far
  // side of a foil.
  [[nodiscard]] bool lies_behind(const Contact<dim>& contact) const {
    return contact.gap < 0 &&
           !surface_.blocks->hold(contact.target, contact.target_element, point_of(surface_.mesh, contact.on_owner)) &&
           !surface_.blocks->hold(contact.owner, contact.owner_element, point_of(surface_.mesh, contact.on_target));
  }

  [[nodiscard]] Asked<dim> asked_of(std::size_t i) const {
    const Contact<dim>& contact = contacts_[i];
    const Point<dim> on_owner = point_of(surface_.mesh, contact.on_owner);
    const Point<dim> on_target = point_of(surface_.mesh, contact.on_target);
    const double flat = least_gap * contact.length;
    if constexpr (dim == 3) {
      if (contact.kind == Kind::edge_edge) {
        const Point<3> along = ((on_target - on_owner) / contact.gap).normalized();
        Stencil<3> edge = contact.on_owner;
        edge.weights = weights_on_edge(edge.weights, options_.indentation);
        const Point<3> on_edge = point_of(surface_.mesh, edge);
        const auto from = [&](const Point<3>& point) -> Sight<3> {
          return {contact.owner, contact.owner_element, point, along, along.dot(on_target - point) - flat};
        };
        return {i, {from(on_owner), from(on_edge)}, true, contact.length};
      }
    }
    const auto normal = [&](const Stencil<dim>& on) {
      return Point<dim>(mesh::area_vector<dim>(surface_.mesh, on.nodes).normalized());
    };
    const double near = contact.gap - flat;
    return {i,
            {Sight<dim>{contact.owner, contact.owner_element, on_owner, normal(contact.on_owner), near},
             Sight<dim>{contact.target, contact.target_element, on_target, normal(contact.on_target), near}},
            false,
            contact.length};
  }

  // As far as a block may be in another one that it touches [m].
  [[nodiscard]] double deepest(double length) const { return 2 * options_.tolerance * length; }
  // To the side of a face what is on it [m].
  [[nodiscard]] double rounding(double length) const { return std::max(on_face * length, surface_.rounding); }

  // Asks the faces of all blocks around but the contact's, from one side or both.
  void look(const Contact<dim>& contact, std::size_t first_side, std::size_t end_side) {
    Aabb<dim> way;
    for (const Asked<dim>& asked : asked_) {
      for (std::size_t side = first_side; side < end_side; ++side) {
        const Sight<dim>& sight = asked.sights[side];
        way.extend(Point<dim>(sight.from - deepest(asked.length) * sight.along));
        way.extend(Point<dim>(sight.from + std::max(0.0, sight.near) * sight.along));
      }
    }
    way.min().array() -= rounding(asked_.front().length);
    way.max().array() += rounding(asked_.front().length);
    table_.grid.find(way, found_);
    for (const std::uint32_t place : found_) {
      const Shell<dim>& shell = table_.shells[place];
      if (shell.block == contact.owner || shell.block == contact.target) continue;
      for (int face = 0; face <= dim; ++face) {
        if ((shell.faces >> face & 1u) != 0) ask(shell.face(face), first_side, end_side);
      }
    }
  }

  // Those who look against the face; all sights of a side have one direction.
  void ask(FaceId face, std::size_t first_side, std::size_t end_side) {
    const Point<dim>& normal = surface_.normals[face];
    const Point<dim>& corner = surface_.mesh.nodes[surface_.faces[face].nodes[0]];
    for (std::size_t side = first_side; side < end_side; ++side) {
      const double slope = asked_.front().sights[side].along.dot(normal);
      if (slope >= 0) continue;
      for (Asked<dim>& asked : asked_) {
        const Sight<dim>& sight = asked.sights[side];
        const double way = (corner - sight.from).dot(normal) / slope;
        if (way >= sight.near || way < -deepest(asked.length) || asked.sees_another[side]) continue;
        asked.sees_another[side] = stands_before(face, sight, way, asked.length);
      }
    }
  }

  // Of a face whose plane is so far along the way.
  [[nodiscard]] bool stands_before(FaceId face, const Sight<dim>& sight, double way, double length) const {
    const Corners<dim> corners = corners_of(surface_, face);
    const Point<dim> hit = sight.from + way * sight.along;
    if (beside<dim>(corners, hit, rounding(length))) return false;  // most are, and that is soon seen
    const double off = (weighted_point<dim>(corners, closest_weights<dim>(corners, hit)) - hit).norm();
    if (off > rounding(length)) return false;
    if (way >= -least_gap * length) return true;
    // Behind the point: the face must lie in the point's own block, or the point in that of the face.
    const mesh::Face<dim>& of = surface_.faces[face];
    return surface_.blocks->hold(sight.own, sight.element, hit) || surface_.blocks->hold(of.block, of.element, sight.from);
  }

  const Surface<dim>& surface_;
  const ContactOptions& options_;
  const Contacts<dim>& contacts_;
  const ShellTable<dim>& table_;
  std::vector<Asked<dim>> asked_;
  Places found_;
};

// The first contact behind one that has not its faces.
template <int dim>
std::size_t end_of_run(const Contacts<dim>& contacts, std::size_t first, std::size_t end) {
  const Contact<dim>& of = contacts[first];
  std::size_t last = first + 1;
  if (of.kind != Kind::overlap) return last;
  while (last < end && contacts[last].kind == Kind::overlap && contacts[last].on_owner.nodes == of.on_owner.nodes &&
         contacts[last].on_target.nodes == of.on_target.nodes) {
    ++last;
  }
  return last;
}

}  // namespace

template <int dim>
void drop_hidden_contacts(const Surface<dim>& surface, const ContactOptions& options, Contacts<dim>& contacts) {
  if (!any_may_be_hidden(contacts)) return;
  const ShellTable<dim> table = make_shells(surface, {});
  std::vector<std::uint8_t> hidden(contacts.size(), 0);
  for_chunks(contacts.size(), [&](Chunk chunk) {
    Between<dim> between(surface, options, contacts, table);
    for (std::size_t i = chunk.begin; i < chunk.end;) {
      const std::size_t end = end_of_run(contacts, i, chunk.end);
      between.mark({chunk.number, i, end}, hidden);
      i = end;
    }
  });
  if (std::none_of(hidden.begin(), hidden.end(), [](std::uint8_t one) { return one != 0; })) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (hidden[i] == 0) contacts[kept++] = contacts[i];
  }
  contacts.resize(kept);
}

template void drop_hidden_contacts<2>(const Surface<2>&, const ContactOptions&, Contacts<2>&);
template void drop_hidden_contacts<3>(const Surface<3>&, const ContactOptions&, Contacts<3>&);

}  // namespace scree::contact
