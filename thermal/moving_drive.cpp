#include "thermal/moving_drive.h"

#include <algorithm>

namespace scree::thermal {

namespace {

// The free nodes that loads or exchanges act on which change in time, ascending.
std::vector<NodeId> heated_nodes(const HeatModel& model) {
  std::vector<NodeId> nodes;
  const auto add = [&](const NodeShares& on) { nodes.insert(nodes.end(), on.nodes.begin(), on.nodes.end()); };
  for (const Load& load : model.loads) {
    if (varies_in_time(load)) add(load.on);
  }
  for (const Exchange& exchange : model.exchanges) {
    if (varies_in_time(exchange)) add(exchange.on);
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  const auto fixed = [&](NodeId node) { return std::binary_search(model.fixed_nodes.begin(), model.fixed_nodes.end(), node); };
  nodes.erase(std::remove_if(nodes.begin(), nodes.end(), fixed), nodes.end());
  return nodes;
}

}  // namespace

MovingDrive::MovingDrive(const HeatModel& model) {
  for (const NodeId node : heated_nodes(model)) heated_.push_back({node.value()});
  for (std::size_t i = 0; i < model.fixed_nodes.size(); ++i) {
    if (varies_in_time(model.holds[model.fixed_hold[i]])) held_.push_back({model.fixed_nodes[i].value(), i});
  }
}

void MovingDrive::Parabola::fit(double middle, double end) {
  slope = 4 * middle - end;
  bend = 2 * end - 4 * middle;
}

void MovingDrive::fit(const HeatBalance& balance, Drives& drives, double time, double length,
                      const Eigen::VectorXd& temperature, const Eigen::VectorXd& inverse) {
  const Drive& middle = drives.at(time + 0.5 * length);
  const Drive& end = drives.at(time + length);
  if (!heated_.empty()) {
    const Eigen::VectorXd from = balance.driven(temperature, drives.at(time));
    const Eigen::VectorXd at_middle = balance.driven(temperature, middle) - from;
    const Eigen::VectorXd at_end = balance.driven(temperature, end) - from;
    for (Parabola& of : heated_) {
      const double scale = length * inverse[of.row];
      of.fit(scale * at_middle[of.row], scale * at_end[of.row]);
    }
  }
  for (Parabola& of : held_) {
    const auto i = static_cast<Eigen::Index>(of.fixed);
    of.fit(middle.fixed[i] - temperature[of.row], end.fixed[i] - temperature[of.row]);
  }
}

void MovingDrive::heat(Columns& increment, double times, double part) const {
  for_all(heated_, [&](const Parabola& of) { increment(of.row, 0) += times * of.at(part); });
}

void MovingDrive::hold(Columns& increment, double part) const {
  for_all(held_, [&](const Parabola& of) { increment(of.row, 0) = of.at(part); });
}

}  // namespace scree::thermal
