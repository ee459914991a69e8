#include "contact/one_sided.h"

#include <algorithm>
#include <numeric>

#include "contact/overlap.h"
#include "engine/base/chunks.h"
#include "engine/mesh/cells.h"

namespace scree::contact {

namespace {

constexpr double rounding = 1e-9;
constexpr double least_part = 0.01;

template <int dim>
bool opposed(const mesh::BlockMesh<dim>& mesh, const Contact<dim>& contact) {
  const auto normal = [&](const Stencil<dim>& side) { return mesh::area_vector<dim>(mesh, side.nodes).normalized(); };
  return normal(contact.on_owner).dot(normal(contact.on_target)) <= -least_opposed;
}

// Whether the target has semi-springs of its own that reach the owner. Contacts are in the order of their owners, overlaps
// last.
template <int dim>
bool answered(const Contacts<dim>& all, const Contact<dim>& contact) {
  const auto end = std::partition_point(all.begin(), all.end(), [](const auto& one) { return one.kind != Kind::overlap; });
  auto of_target = std::partition_point(all.begin(), end, [&](const auto& one) { return one.owner < contact.target; });
  for (; of_target != end && of_target->owner == contact.target; ++of_target) {
    if (of_target->kind == Kind::point_face && of_target->target == contact.owner) return true;
  }
  return false;
}

}  // namespace

template <int dim>
std::optional<OneSided> one_sided(const mesh::BlockMesh<dim>& mesh, const ContactSet<dim>& contacts, double tolerance) {
  const auto& all = contacts.contacts;
  const mesh::CharacteristicLength<dim> lengths(mesh);
  std::vector<OneSided> parts(chunk_count(all.size()));
  std::vector<double> areas(parts.size(), 0);
  for_chunks(all.size(), [&](Chunk chunk) {
    OneSided& part = parts[chunk.number];
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      const Contact<dim>& contact = all[i];
      if (contact.kind != Kind::point_face) continue;
      areas[chunk.number] += contact.area;
      if (contact.gap <= 0) continue;
      const double wanted = contact.gap / lengths.of(contact.target_element);
      if (wanted <= (1 + rounding) * tolerance || !opposed(mesh, contact) || answered<dim>(all, contact)) continue;
      ++part.contacts;
      part.area += contact.area;
      part.tolerance = std::max(part.tolerance, wanted);
    }
  });
  OneSided sum;
  for (const OneSided& part : parts) {
    sum.contacts += part.contacts;
    sum.area += part.area;
    sum.tolerance = std::max(sum.tolerance, part.tolerance);
  }
  const double all_area = std::accumulate(areas.begin(), areas.end(), 0.0);
  return sum.contacts > 0 && sum.area >= least_part * all_area ? std::optional(sum) : std::nullopt;
}

template std::optional<OneSided> one_sided<2>(const mesh::BlockMesh<2>&, const ContactSet<2>&, double);
template std::optional<OneSided> one_sided<3>(const mesh::BlockMesh<3>&, const ContactSet<3>&, double);

}  // namespace scree::contact
