#include "contact/target_search.h"

#include "contact/edge_search.h"
#include "contact/near_shells.h"
#include "contact/spring_search.h"

namespace scree::contact {

namespace {

template <int dim>
void take(std::vector<std::vector<SpringTouch<dim>>>&& touches, std::size_t faces, Targets<dim>& targets) {
  targets.of_springs.resize(faces * dim);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t i = 0; i < touches.size(); ++i) {
    for (const auto& touch : touches[i]) targets.of_springs[touch.spring] = touch.target;
  }
  targets.touches = std::move(touches);
}

}  // namespace

template <int dim>
Targets<dim> find_targets(const Surface<dim>& surface, const ContactOptions& options) {
  const ShellTable<dim> table = make_shells(surface, {options.tolerance, options.indentation});
  SpringSearch<dim> springs(surface, options, table);
  Targets<dim> targets;
  if constexpr (dim == 2) {
    visit_near<dim>(table, [&](std::size_t chunk, const ShellPair<dim>& pair) { springs.look_at(chunk, pair); });
    take(springs.touches(), surface.faces.size(), targets);
  } else {
    EdgeSearch edges(surface, options, table);
    visit_near<dim>(table, [&](std::size_t chunk, const ShellPair<dim>& pair) {
      springs.look_at(chunk, pair);
      edges.look_at(chunk, pair);
    });
    take(springs.touches(), surface.faces.size(), targets);
    targets.of_edges = edges.taken(targets.of_springs);
  }
  return targets;
}

template Targets<2> find_targets<2>(const Surface<2>&, const ContactOptions&);
template Targets<3> find_targets<3>(const Surface<3>&, const ContactOptions&);

}  // namespace scree::contact
