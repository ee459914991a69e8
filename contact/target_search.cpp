#include "contact/target_search.h"

#include "contact/edge_search.h"
#include "contact/near_edges.h"
#include "contact/near_springs.h"
#include "contact/spring_search.h"

namespace scree::contact {

namespace {

template <int dim>
struct Near {
  std::vector<NearSprings> springs;
  std::vector<NearEdges> edges;  // empty in 2-D
};

}  // namespace

template <int dim>
Targets<dim> find_targets(const Surface<dim>& surface, const ContactOptions& options) {
  const ShellTable<dim> table = make_shells(surface, {options.tolerance, options.indentation});
  const std::size_t chunks = chunk_count(table.shells.size());
  Parts<NearSprings> near_springs(chunks);
  Parts<NearEdges> near(chunks);
  const auto indentation = static_cast<float>(options.indentation);
  visit_near<Near<dim>>(
      table,
      [&](const ShellPair<dim>& pair, Near<dim>& found) SCREE_INLINED {
        add_near_springs(pair, indentation, found.springs);
        if constexpr (dim == 3) {
          const EdgePairs edges = near_edges(pair);
          if (edges != 0) found.edges.push_back({pair.first_place, pair.second_place, edges});
        }
      },
      [&](std::size_t chunk, const Near<dim>& found) {
        near_springs.put(chunk, found.springs);
        near.put(chunk, found.edges);
      });
  Targets<dim> targets{find_spring_targets(surface, options, table, near_springs), {}};
  if constexpr (dim == 3) targets.of_edges = find_edge_targets(surface, options, table, near, targets.of_springs.blocks);
  return targets;
}

template Targets<2> find_targets<2>(const Surface<2>&, const ContactOptions&);
template Targets<3> find_targets<3>(const Surface<3>&, const ContactOptions&);

}  // namespace scree::contact
