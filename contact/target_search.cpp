#include "contact/target_search.h"

#include <utility>

#include "contact/edge_search.h"
#include "contact/near_edges.h"
#include "contact/near_springs.h"
#include "contact/spring_search.h"

namespace scree::contact {

template <int dim>
Targets<dim> find_targets(const Surface<dim>& surface, const ContactOptions& options) {
  const ShellTable<dim> table = make_shells(surface, {options.tolerance, options.indentation});
  const std::size_t chunks = chunk_count(table.shells.size());
  std::vector<std::vector<NearSprings>> near_springs(chunks);
  const auto indentation = static_cast<float>(options.indentation);
  Targets<dim> targets;
  if constexpr (dim == 2) {
    visit_near<dim>(table, [&](std::size_t chunk, const ShellPair<dim>& pair)
                               SCREE_INLINED { add_near_springs(pair, indentation, near_springs[chunk]); });
    targets.of_springs = find_spring_targets(surface, options, table, std::move(near_springs));
  } else {
    std::vector<std::vector<NearEdges>> near(chunks);
    visit_near<dim>(table, [&](std::size_t chunk, const ShellPair<dim>& pair) SCREE_INLINED {
      add_near_springs(pair, indentation, near_springs[chunk]);
      const EdgePairs edges = near_edges(pair);
      if (edges != 0) near[chunk].push_back({pair.first_place, pair.second_place, edges});
    });
    targets.of_springs = find_spring_targets(surface, options, table, std::move(near_springs));
    targets.of_edges = find_edge_targets(surface, options, table, std::move(near), targets.of_springs.blocks);
  }
  return targets;
}

template Targets<2> find_targets<2>(const Surface<2>&, const ContactOptions&);
template Targets<3> find_targets<3>(const Surface<3>&, const ContactOptions&);

}  // namespace scree::contact
