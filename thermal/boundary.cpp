#include "thermal/boundary.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/coordinate_rounding.h"
#include "engine/base/nearest.h"
#include "engine/mesh/cells.h"
#include "engine/mesh/part_in_box.h"
#include "engine/mesh/surfaces.h"
#include "thermal/looks_in_time.h"
#include "thermal/places.h"
#include "thermal/problems.h"

namespace scree::thermal {

Region::Region(BodyId of_body, std::optional<Aabb<3>> in, std::optional<std::string> on)
    : body(of_body), within(std::move(in)), surface(std::move(on)) {}

namespace {

template <int dim>
std::string text(const Eigen::Matrix<double, dim, 1>& point) {
  std::string list;
  for (int i = 0; i < dim; ++i) list += fmt::format("{}{:g}", i == 0 ? "" : ", ", point[i]);
  return fmt::format("({})", list);
}

// Puts boundaries and sources on one mesh, and collects what is wrong with them.
template <int dim>
class Applier {
 public:
  Applier(const mesh::BlockMesh<dim>& mesh, double until, const MovingBodies& moving, HeatModel& model)
      : mesh_(mesh), model_(model), until_(until), moving_(moving), blocks_of_(mesh.bodies.size()) {
    for (const BlockId b : mesh.blocks.ids()) blocks_of_[mesh.blocks[b].body].push_back(b);
    for (const Point<dim>& point : mesh.nodes) everywhere_.extend(point);
    if (!mesh.nodes.empty()) rounding_ = std::max(1e-9 * everywhere_.diagonal().norm(), coordinate_rounding(everywhere_));
  }

  void apply(const Boundary& boundary) {
    if (boundary.region.surface && !mesh::find_surface(mesh_, boundary.region.body, *boundary.region.surface)) {
      no_such_surface(boundary);
      return;
    }
    if (not_known_yet(boundary.region)) return;
    if (const auto* fixed = std::get_if<FixedTemperature>(&boundary.condition)) {
      fix(boundary, fixed->temperature);
      return;
    }
    NodeShares faces = face_shares(boundary);
    if (const auto* flux = std::get_if<HeatFlux>(&boundary.condition)) {
      model_.loads.push_back({boundary.name, std::move(faces), flux->flux});
    } else if (const auto* flow = std::get_if<HeatFlow>(&boundary.condition)) {
      spread(boundary, flow->flow, std::move(faces));
    } else if (const auto* convection = std::get_if<Convection>(&boundary.condition)) {
      model_.exchanges.push_back(
          {boundary.name, std::move(faces), Exchange::Law::convection, convection->coefficient, convection->surroundings});
    } else {
      const auto& radiation = std::get<Radiation>(boundary.condition);
      model_.exchanges.push_back(
          {boundary.name, std::move(faces), Exchange::Law::radiation, radiation.emissivity, radiation.surroundings});
    }
  }

  void apply(const Source& source) {
    if (not_known_yet(source.region)) return;
    SharesByNode shares;
    for (const BlockId b : blocks_of_[source.region.body]) {
      mesh::for_each_simplex(mesh_, mesh_.blocks[b], [&](const mesh::Simplex<dim>& nodes, double weight) {
        add_part(source.region, nodes, weight, shares);
      });
    }
    if (shares.empty()) nothing_there(source.where, "heat.sources", source.name, source.region, "a part of an element");
    model_.loads.push_back({source.name, listed(shares), source.power, true});
  }

  void finish() {
    if (!problems_.empty()) throw InputError(problems_);
    for (const auto& [node, hold] : held_) {
      model_.fixed_nodes.push_back(node);
      model_.fixed_hold.push_back(hold);
    }
  }

 private:
  using SharesByNode = std::map<NodeId, double>;

  NodeShares listed(const SharesByNode& by_node) const {
    NodeShares list;
    list.places.resize(3, static_cast<Eigen::Index>(by_node.size()));
    for (const auto& [node, share] : by_node) {
      list.places.col(static_cast<Eigen::Index>(list.nodes.size())) = place(node);
      list.nodes.push_back(node);
      list.shares.push_back(share);
    }
    return list;
  }

  bool not_known_yet(const Region& region) const { return region.within && moving_.contains(region.body); }

  static Aabb<dim> box_of(const Region& region) {
    return {region.within->min().template head<dim>(), region.within->max().template head<dim>()};
  }

  bool inside(const Region& region, const Point<dim>& point) const {
    if (!region.within) return true;
    const Aabb<dim> box = box_of(region);
    return (point.array() >= box.min().array() - rounding_).all() && (point.array() <= box.max().array() + rounding_).all();
  }

  // The shares of an element's or a face's corners in the part of it that lies in the region.
  template <std::size_t corners>
  void add_part(const Region& region, const std::array<NodeId, corners>& nodes, double weight, SharesByNode& shares) const {
    const auto part = mesh::shares_in_box<dim, corners>(mesh::corners_of(mesh_, nodes),
                                                        region.within ? box_of(region) : everywhere_, rounding_);
    if (part.sum() <= 0) return;
    for (std::size_t corner = 0; corner < corners; ++corner)
      shares[nodes[corner]] += weight * part[static_cast<Eigen::Index>(corner)];
  }

  void no_such_surface(const Boundary& boundary) {
    const Region& region = boundary.region;
    const std::vector<std::string> names = mesh::surface_names(mesh_, region.body);
    const std::string& body = mesh_.bodies[region.body].name;
    std::string hint = fmt::format("Body {} has no named surfaces; use `within`", body);
    if (!names.empty()) hint = fmt::format("Body {} has {}", body, fmt::join(names, ", "));
    if (const auto meant = nearest(*region.surface, names)) hint = fmt::format("Did you mean {}? {}", *meant, hint);
    problems_.push_back(
        problem("heat.boundaries: " + boundary.name + ": surface", *region.surface, "must be a surface of body " + body, hint));
    problems_.back().where = boundary.where;
  }

  std::vector<NodeId> nodes_in(const Region& region) const {
    std::vector<NodeId> nodes;
    if (region.surface) {
      nodes = mesh::surface_nodes(mesh_, *mesh::find_surface(mesh_, region.body, *region.surface));
    } else {
      for (const BlockId b : blocks_of_[region.body]) {
        for (const NodeId node : mesh_.blocks[b].nodes) nodes.push_back(node);
      }
    }
    std::erase_if(nodes, [&](NodeId node) { return !inside(region, mesh_.nodes[node]); });
    return nodes;
  }

  void fix(const Boundary& boundary, const Function& temperature) {
    const int index = static_cast<int>(model_.holds.size());
    model_.holds.push_back({boundary.name, temperature});
    const std::vector<NodeId> nodes = nodes_in(boundary.region);
    bool conflict = false;
    for (const NodeId node : nodes) {
      const int holder = held_.try_emplace(node, index).first->second;
      const auto time = conflict || holder == index ? std::nullopt : disagreement({holder, index}, node);
      if (!time) continue;
      conflict = true;
      const Hold& hold = model_.holds[holder];
      const std::string rule = fmt::format("\"{}\" holds the node at {} m at {:g} K", hold.name, text<dim>(mesh_.nodes[node]),
                                           hold.temperature(place(node), *time));
      problems_.push_back(problem("heat.boundaries: " + boundary.name,
                                  fmt::format("{:g} K{}", temperature(place(node), *time),
                                              *time > 0 ? fmt::format(" at {:g} s", *time) : std::string()),
                                  rule, "Make one of the two regions smaller, so that no node is in both"));
      problems_.back().where = boundary.where;
    }
    if (nodes.empty()) nothing_there(boundary.where, "heat.boundaries", boundary.name, boundary.region, "at least one node");
  }

  // A time at which the two do not hold the node at the same temperature.
  std::optional<double> disagreement(const std::pair<int, int>& holders, NodeId node) {
    const Function &one = model_.holds[holders.first].temperature, &other = model_.holds[holders.second].temperature;
    LooksInTime& looks = looks_.try_emplace(holders, until_).first->second;
    return looks.first(one.varies_in_time() || other.varies_in_time(), [&](double time) {
      const double a = one(place(node), time), b = other(place(node), time);
      return std::abs(a - b) > equal_temperatures * std::max(std::abs(a), std::abs(b));
    });
  }

  Eigen::Vector3d place(NodeId node) const { return model_.places.col(node.value()); }

  bool all_inside(const Region& region, const mesh::Face<dim>& face) const {
    return std::all_of(face.nodes.begin(), face.nodes.end(), [&](NodeId node) { return inside(region, mesh_.nodes[node]); });
  }

  // The share of each node in the area of the region's faces. A box alone picks whole faces: a thin one about a side of a body
  // is how a side without a name is meant, not the rims of its neighbours.
  NodeShares face_shares(const Boundary& boundary) {
    if (!faces_) faces_ = mesh::weighted_faces(mesh_);
    SharesByNode shares;
    std::optional<SurfaceId> surface;
    if (boundary.region.surface) surface = mesh::find_surface(mesh_, boundary.region.body, *boundary.region.surface);
    for (const mesh::WeightedFace<dim>& face : *faces_) {
      if (mesh_.blocks[face.block].body != boundary.region.body) continue;
      if (surface ? mesh::on_surface<dim>(mesh_, face.nodes, *surface) : all_inside(boundary.region, face)) {
        add_part(boundary.region, face.nodes, face.weight, shares);
      }
    }
    if (shares.empty()) {
      nothing_there(boundary.where, "heat.boundaries", boundary.name, boundary.region,
                    surface ? "a part of a face" : "at least one boundary face with all its corners");
    }
    return listed(shares);
  }

  void spread(const Boundary& boundary, const Function& flow, NodeShares faces) {
    if (flow.varies_in_place()) {
      problems_.push_back(problem("heat.boundaries: " + boundary.name, "a flow that depends on place",
                                  "must be one total, W, at any time", "Give a flux (W/m2) instead"));
      problems_.back().where = boundary.where;
    }
    const double area = std::accumulate(faces.shares.begin(), faces.shares.end(), 0.0);
    for (double& share : faces.shares) share /= area;
    model_.loads.push_back({boundary.name, std::move(faces), flow, false, area});
  }

  void nothing_there(const SourceLocation& where, const std::string& list, const std::string& name, const Region& region,
                     const std::string& wanted) {
    std::string value = "body " + mesh_.bodies[region.body].name;
    if (region.surface) value += " on " + *region.surface;
    if (region.within) {
      const Point<dim> low = region.within->min().template head<dim>();
      const Point<dim> high = region.within->max().template head<dim>();
      value += fmt::format(" within {} to {} m", text<dim>(low), text<dim>(high));
    }
    Aabb<dim> extent;
    for (const BlockId b : blocks_of_[region.body]) {
      for (const NodeId node : mesh_.blocks[b].nodes) extent.extend(mesh_.nodes[node]);
    }
    const std::string hint = extent.isEmpty()
                                 ? std::string("The body has no block")
                                 : fmt::format("The body reaches from {} to {} m", text<dim>(Point<dim>(extent.min())),
                                               text<dim>(Point<dim>(extent.max())));
    problems_.push_back(problem(list + ": " + name, value, "must hold " + wanted, hint));
    problems_.back().where = where;
  }

  const mesh::BlockMesh<dim>& mesh_;
  HeatModel& model_;
  double until_;  // end of the run [s]
  const MovingBodies& moving_;
  std::optional<Table<FaceId, mesh::WeightedFace<dim>>> faces_;  // once something passes heat through faces
  Table<BodyId, std::vector<BlockId>> blocks_of_;
  Aabb<dim> everywhere_;
  double rounding_ = 0;                               // [m]
  std::map<std::pair<int, int>, LooksInTime> looks_;  // at conditions that hold the same nodes
  std::map<NodeId, int> held_;                        // which of the model's holds
  std::vector<Problem> problems_;
};

}  // namespace

template <int dim>
void apply_boundaries(const mesh::BlockMesh<dim>& mesh, const HeatOptions& options, const MovingBodies& moving,
                      HeatModel& model) {
  Applier<dim> applier(mesh, options.time.until, moving, model);
  for (const Boundary& boundary : options.boundaries) applier.apply(boundary);
  for (const Source& source : options.sources) applier.apply(source);
  applier.finish();
}

template <int dim>
DrivenNodes driven_nodes(const mesh::BlockMesh<dim>& mesh, const HeatOptions& options) {
  DrivenNodes driven;
  if (!any_perfect(options.joint)) return driven;
  HeatModel conditions;
  conditions.places = places_of(mesh);
  apply_boundaries(mesh, options, {}, conditions);
  driven = DrivenNodes(mesh.nodes.size(), 0);
  for (const NodeId node : conditions.fixed_nodes) driven[node] = 1;
  for (const Load& load : conditions.loads) {
    if (load.in_volume) continue;
    for (const NodeId node : load.on.nodes) driven[node] = 1;
  }
  for (const Exchange& exchange : conditions.exchanges) {
    for (const NodeId node : exchange.on.nodes) driven[node] = 1;
  }
  return driven;
}

template DrivenNodes driven_nodes<2>(const mesh::BlockMesh<2>&, const HeatOptions&);
template DrivenNodes driven_nodes<3>(const mesh::BlockMesh<3>&, const HeatOptions&);
template void apply_boundaries<2>(const mesh::BlockMesh<2>&, const HeatOptions&, const MovingBodies&, HeatModel&);
template void apply_boundaries<3>(const mesh::BlockMesh<3>&, const HeatOptions&, const MovingBodies&, HeatModel&);

}  // namespace scree::thermal
