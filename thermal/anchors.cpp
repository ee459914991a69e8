#include "thermal/anchors.h"

#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "thermal/drive.h"
#include "thermal/joined_rows.h"
#include "thermal/problems.h"

namespace scree::thermal {

void check_anchors(const HeatModel& model) {
  mesh::DisjointSets groups(model.blocks.size());
  join_rows(model.conductance, groups);
  if (model.varying) join_rows(model.varying->unit_conductance, groups);

  Drives drives(model);
  const Drive& drive = drives.at(0);
  std::vector<char> anchored(static_cast<std::size_t>(model.capacity.size()), 0);
  for (const NodeId node : model.fixed_nodes) anchored[groups.root(node.index())] = 1;
  for (std::size_t e = 0; e < model.exchanges.size(); ++e) {
    const std::vector<NodeId>& nodes = model.exchanges[e].on.nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (drive.exchanges[e].factor[static_cast<Eigen::Index>(i)] > 0) anchored[groups.root(nodes[i].index())] = 1;
    }
  }

  std::set<BlockId> loose;
  std::set<std::string> bodies;
  double load = 0;
  for (const NodeId node : model.blocks.ids()) {
    if (anchored[groups.root(node.index())] != 0) continue;
    loose.insert(model.blocks[node]);
    bodies.insert(model.body_names[model.bodies[model.blocks[node]]]);
    load += drive.load[node.value()];
  }
  if (loose.empty()) return;
  throw InputError(problem(
      "heat.steady", fmt::format("true, with {} blocks of {}", loose.size(), fmt::join(bodies, ", ")),
      fmt::format("must give every block a path to a held temperature or to surroundings; these have none{}",
                  load == 0 ? std::string() : fmt::format(", and the {:g} W put into them cannot leave", load)),
      "Hold a temperature or let them lose heat, let them touch what does, leave the bodies out, or run in time instead"));
}

}  // namespace scree::thermal
