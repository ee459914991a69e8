#include "thermal/boundary.h"

#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/mesh/cells.h"
#include "engine/mesh/surfaces.h"
#include "thermal/problems.h"

namespace scree::thermal {

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
  Applier(const mesh::BlockMesh<dim>& mesh, HeatModel& model)
      : mesh_(mesh), model_(model), faces_(mesh::weighted_faces(mesh)), blocks_of_(mesh.bodies.size()) {
    for (const BlockId b : mesh.blocks.ids()) blocks_of_[mesh.blocks[b].body].push_back(b);
    Aabb<dim> extent;
    for (const Point<dim>& point : mesh.nodes) extent.extend(point);
    rounding_ = mesh.nodes.empty() ? 0 : 1e-9 * extent.diagonal().norm();
  }

  void apply(const Boundary& boundary) {
    if (boundary.region.surface && !mesh::find_surface(mesh_, boundary.region.body, *boundary.region.surface)) {
      no_such_surface(boundary);
    } else if (const auto* fixed = std::get_if<FixedTemperature>(&boundary.condition)) {
      fix(boundary, fixed->temperature);
    } else if (const auto* flux = std::get_if<HeatFlux>(&boundary.condition)) {
      heat_faces(boundary, flux->flux, 0);
    } else {
      heat_faces(boundary, 0, std::get<HeatFlow>(boundary.condition).flow);
    }
  }

  void apply(const Source& source) {
    double total = 0;
    bool found = false;
    for (const BlockId b : blocks_of_[source.region.body]) {
      mesh::for_each_simplex(mesh_, mesh_.blocks[b], [&](const mesh::Simplex<dim>& nodes, double weight) {
        Point<dim> centre = Point<dim>::Zero();
        for (const NodeId node : nodes) centre += mesh_.nodes[node] / (dim + 1);
        if (!inside(source.region, centre)) return;
        const double share = weight * source.power * mesh::simplex_volume<dim>(mesh_, nodes) / (dim + 1);
        for (const NodeId node : nodes) model_.load[node.value()] += share;
        total += share * (dim + 1);
        found = true;
      });
    }
    if (!found) nothing_there(source.where, "heat.sources", source.name, source.region, "at least one element's centre");
    model_.applied_flows.emplace_back(source.name, total);
  }

  void finish() {
    if (!problems_.empty()) throw InputError(problems_);
    model_.fixed_temperature.resize(static_cast<Eigen::Index>(held_.size()));
    for (const auto& [node, by] : held_) {
      model_.fixed_temperature[static_cast<Eigen::Index>(model_.fixed_nodes.size())] = by.temperature;
      model_.fixed_nodes.push_back(node);
      model_.fixed_boundary.push_back(by.boundary);
    }
  }

 private:
  struct Hold {
    double temperature;
    int boundary;
  };

  bool inside(const Region& region, const Point<dim>& point) const {
    if (!region.within) return true;
    const auto low = region.within->min().template head<dim>().array() - rounding_;
    const auto high = region.within->max().template head<dim>().array() + rounding_;
    return (point.array() >= low).all() && (point.array() <= high).all();
  }

  void no_such_surface(const Boundary& boundary) {
    const Region& region = boundary.region;
    const std::vector<std::string> names = mesh::surface_names(mesh_, region.body);
    const std::string& body = mesh_.bodies[region.body].name;
    const std::string hint = names.empty() ? fmt::format("Body {} has no named surfaces; use `within`", body)
                                           : fmt::format("Body {} has {}", body, fmt::join(names, ", "));
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

  void fix(const Boundary& boundary, double temperature) {
    const int index = static_cast<int>(model_.boundary_names.size());
    model_.boundary_names.push_back(boundary.name);
    const std::vector<NodeId> nodes = nodes_in(boundary.region);
    bool conflict = false;
    for (const NodeId node : nodes) {
      const Hold& held = held_.try_emplace(node, Hold{temperature, index}).first->second;
      if (held.temperature == temperature || conflict) continue;
      conflict = true;
      const std::string rule = fmt::format("\"{}\" holds the node at {} m at {:g} K", model_.boundary_names[held.boundary],
                                           text<dim>(mesh_.nodes[node]), held.temperature);
      problems_.push_back(problem("heat.boundaries: " + boundary.name, fmt::format("{:g} K", temperature), rule,
                                  "Make one of the two regions smaller, so that no node is in both"));
      problems_.back().where = boundary.where;
    }
    if (nodes.empty()) nothing_there(boundary.where, "heat.boundaries", boundary.name, boundary.region, "at least one node");
  }

  // Adds flux times area to the faces in the region, and spreads `flow` over them by area.
  void heat_faces(const Boundary& boundary, double flux, double flow) {
    std::vector<std::pair<FaceId, double>> heated;
    double area = 0;
    std::optional<SurfaceId> surface;
    if (boundary.region.surface) surface = mesh::find_surface(mesh_, boundary.region.body, *boundary.region.surface);
    for (const FaceId f : faces_.ids()) {
      if (mesh_.blocks[faces_[f].block].body != boundary.region.body) continue;
      bool in = !surface || mesh::on_surface<dim>(mesh_, faces_[f].nodes, *surface);
      for (const NodeId node : faces_[f].nodes) in = in && inside(boundary.region, mesh_.nodes[node]);
      if (!in) continue;
      heated.emplace_back(f, faces_[f].weight * mesh::face_area<dim>(mesh_, faces_[f]));
      area += heated.back().second;
    }
    if (heated.empty()) {
      nothing_there(boundary.where, "heat.boundaries", boundary.name, boundary.region,
                    "at least one boundary face with all its corners");
      return;
    }
    const double per_area = flux + flow / area;
    for (const auto& [f, face_size] : heated) {
      for (const NodeId node : faces_[f].nodes) model_.load[node.value()] += per_area * face_size / dim;
    }
    model_.applied_flows.emplace_back(boundary.name, per_area * area);
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
  Table<FaceId, mesh::WeightedFace<dim>> faces_;
  Table<BodyId, std::vector<BlockId>> blocks_of_;
  double rounding_ = 0;  // [m]
  std::map<NodeId, Hold> held_;
  std::vector<Problem> problems_;
};

}  // namespace

template <int dim>
void apply_boundaries(const mesh::BlockMesh<dim>& mesh, const HeatOptions& options, HeatModel& model) {
  Applier<dim> applier(mesh, model);
  for (const Boundary& boundary : options.boundaries) applier.apply(boundary);
  for (const Source& source : options.sources) applier.apply(source);
  applier.finish();
}

template void apply_boundaries<2>(const mesh::BlockMesh<2>&, const HeatOptions&, HeatModel&);
template void apply_boundaries<3>(const mesh::BlockMesh<3>&, const HeatOptions&, HeatModel&);

}  // namespace scree::thermal
