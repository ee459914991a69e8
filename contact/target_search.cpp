#include "contact/target_search.h"

#include "contact/edge_search.h"
#include "contact/near_edges.h"
#include "contact/near_springs.h"
#include "contact/spring_search.h"
#include "contact/twin_faces.h"

namespace scree::contact {

namespace {

template <int dim>
struct Near {
  std::vector<NearSprings> springs;
  std::vector<NearEdges> edges;  // empty in 2-D
};

// Which faces of the shells have their targets.
template <int dim>
void close_shells(const SpringTargets<dim>& targets, ShellTable<dim>& table) {
  for_chunks(table.shells.size(), [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      Shell<dim>& shell = table.shells[i];
      for (int f = 0; f <= dim; ++f) {
        const bool known = (shell.faces >> f & 1u) != 0 && targets.faces[shell.face(f).index() * dim].valid();
        shell.open = static_cast<std::uint8_t>(shell.open & ~((known ? 1u : 0u) << f));
      }
    }
  });
}

}  // namespace

template <int dim>
Targets<dim> find_targets(const Surface<dim>& surface, const ContactOptions& options) {
  Targets<dim> targets{SpringTargets<dim>(surface), {}};
  const bool some_known = take_twins(surface, options, targets.of_springs);
  ShellTable<dim> table = make_shells(surface, {options.tolerance, options.indentation});
  if (some_known) close_shells(targets.of_springs, table);
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
  find_spring_targets(surface, options, table, near_springs, targets.of_springs);
  if constexpr (dim == 3) targets.of_edges = find_edge_targets(surface, options, table, near, targets.of_springs.blocks);
  return targets;
}

template Targets<2> find_targets<2>(const Surface<2>&, const ContactOptions&);
template Targets<3> find_targets<3>(const Surface<3>&, const ContactOptions&);

}  // namespace scree::contact
