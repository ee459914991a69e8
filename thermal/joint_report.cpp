#include "thermal/joint_report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "engine/base/check.h"
#include "thermal/contact_conduction.h"

namespace scree::thermal {

namespace {

// Sums over the contacts of a pair, from which the report's means come.
struct Sums {
  double conductance = 0;       // [W/K]
  double unit_conductance = 0;  // what it would be at beta 1 [W/K]
  double size_over_k = 0;       // sum of L/k [m2 K/W]
};

template <int dim>
Table<BlockId, double> block_sizes(const mesh::BlockMesh<dim>& mesh) {
  Table<BlockId, double> sizes(mesh.blocks.size());
  for (const BlockId b : mesh.blocks.ids()) {
    double volume = 0;
    for (const ElementId e : mesh.blocks[b].elements) volume += mesh::element_volume(mesh, e);
    sizes[b] = std::pow(volume, 1.0 / dim);
  }
  return sizes;
}

// The conductance of a contact as a joint's: without end where nothing resists.
template <int dim>
double conductance_of(const contact::Contact<dim>& contact, double mean_conductivity, const JointLaw& law) {
  if (std::holds_alternative<PerfectJoint>(law)) return std::numeric_limits<double>::infinity();
  return contact_conductance(contact, {mean_conductivity, 0}, law);
}

// [W/m/K]; not a number where a formula has no value at 20 C. A joint of a conductance needs none, but has no beta and Bi then.
template <int dim>
double known_conductivity(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                          const contact::Contact<dim>& contact) {
  try {
    return mean_conductivity(mesh, materials, contact);
  } catch (const InputError&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

template <int dim>
void count(const contact::Contact<dim>& contact, JointReport& report) {
  using contact::Kind;
  ++(contact.kind == Kind::point_face  ? report.point_face
     : contact.kind == Kind::edge_edge ? report.edge_edge
                                       : report.overlap);
  report.area += contact.area;
  if (contact.kind == Kind::point_face) report.touching_area += 0.5 * contact.area;
  if (contact.kind == Kind::overlap) report.touching_area += contact.area;
}

void finish(const Sums& sums, JointReport& report) {
  const auto contacts = static_cast<double>(report.point_face + report.edge_edge + report.overlap);
  report.mean_conductance = sums.conductance / report.area;
  const double touching = report.touching_area > 0 ? report.touching_area : 0.5 * report.area;  // of edges both sides' count
  report.joint_conductance = sums.conductance / touching;
  report.stiffness_factor = sums.conductance / sums.unit_conductance;
  report.biot = report.joint_conductance * sums.size_over_k / contacts;
}

}  // namespace

template <int dim>
std::vector<JointReport> joint_reports(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                                       const contact::ContactSet<dim>& contacts, const JointOptions& joint,
                                       const std::vector<double>& flows) {
  SCREE_EXPECT(flows.size() == contacts.contacts.size());
  const Table<BlockId, double> sizes = block_sizes(mesh);
  std::map<std::pair<BodyId, BodyId>, std::pair<JointReport, Sums>> pairs;
  for (std::size_t c = 0; c < flows.size(); ++c) {
    const auto& contact = contacts.contacts[c];
    const BodyId owner = mesh.blocks[contact.owner].body;
    const BodyId target = mesh.blocks[contact.target].body;
    const JointLaw& law = law_between(joint, mesh.bodies, owner, target);
    auto& [report, sums] = pairs[{std::min(owner, target), std::max(owner, target)}];
    if (report.area == 0) report.least_conductance = std::numeric_limits<double>::infinity();
    report.law = name_of(law);
    const double k = known_conductivity(mesh, materials, contact);
    const double conductance = conductance_of(contact, k, law);
    count(contact, report);
    report.least_conductance = std::min(report.least_conductance, conductance / contact.area);
    report.largest_conductance = std::max(report.largest_conductance, conductance / contact.area);
    if (owner != target) report.flow += owner < target ? flows[c] : -flows[c];
    report.absolute_flow += std::abs(flows[c]);
    sums.conductance += conductance;
    sums.unit_conductance += contact_conductance(contact, {k, 0}, StiffnessFactor{1});
    sums.size_over_k += sizes[contact.owner] / k;
  }
  std::vector<JointReport> reports;
  for (auto& [bodies, entry] : pairs) {
    auto& [report, sums] = entry;
    report.first = bodies.first;
    report.second = bodies.second;
    finish(sums, report);
    reports.push_back(report);
  }
  return reports;
}

template std::vector<JointReport> joint_reports<2>(const mesh::BlockMesh<2>&, const Table<MaterialId, Material>&,
                                                   const contact::ContactSet<2>&, const JointOptions&,
                                                   const std::vector<double>&);
template std::vector<JointReport> joint_reports<3>(const mesh::BlockMesh<3>&, const Table<MaterialId, Material>&,
                                                   const contact::ContactSet<3>&, const JointOptions&,
                                                   const std::vector<double>&);

}  // namespace scree::thermal
