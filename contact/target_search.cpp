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
  const Shares shares{static_cast<float>(1 - options.indentation), static_cast<float>(options.indentation / dim)};
  visit_near<Near<dim>>(
      table,
      [&](const auto& pairs, Near<dim>& found) SCREE_INLINED {
        add_near_springs(pairs, shares, found.springs);
        if constexpr (dim == 3) {
          const auto edges = near_edges(pairs);
          pairs.for_each([&](auto k) SCREE_INLINED {
            if (edges[k] != 0) found.edges.push_back({pairs.first_place, pairs.second_place(k), edges[k]});
          });
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
