// A packing's file: every table as a data set, what describes the file as attributes, and a digest of all of it, since HDF5
// itself would read a flipped bit back without a word.
#include <algorithm>
#include <array>
#include <new>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "engine/base/atomic_file.h"
#include "engine/base/check.h"
#include "engine/base/hash.h"
#include "engine/base/hdf5_image.h"
#include "engine/base/hdf5_reader.h"
#include "engine/packing/packing.h"

namespace scree::packing {

namespace {

constexpr const char* format_name = "scree packing";
constexpr std::int64_t format_version = 7;

// The numbers of a report, in the order of the file.
constexpr std::array report_numbers{&SettleReport::simulated_time,
                                    &SettleReport::rms_speed,
                                    &SettleReport::max_speed,
                                    &SettleReport::unbalanced_force,
                                    &SettleReport::max_displacement,
                                    &SettleReport::window,
                                    &SettleReport::max_penetration,
                                    &SettleReport::mean_penetration,
                                    &SettleReport::deepest_overlap,
                                    &SettleReport::mean_edge,
                                    &SettleReport::top};

// A packing as plain lists.
struct Lists {
  std::vector<double> nodes, velocities, poses, report;         // rows of dim, 3, 7 (translation; rotation x y z w), 1
  std::vector<double> orientations;                             // rows of 4 (x y z w), of the blocks before their poses
  std::vector<double> net_force;                                // one per block, of a settled packing
  std::vector<std::int64_t> elements, blocks, bodies, outcome;  // rows of dim + 1, 7, 2, 1
  std::vector<std::int64_t> cells;                              // rows of kind and 8 nodes, -1 for one it does not have
  std::vector<std::int64_t> surfaces, surface_bodies;           // rows of dim nodes and the surface, 1
  std::vector<std::string> texts;      // the names of the bodies, of the surfaces, then the criterion, if any
  std::vector<std::string> made_from;  // one per body
};

template <int dim>
Lists pack(const Packing<dim>& packing) {
  Lists lists;
  lists.nodes.reserve(dim * packing.mesh.nodes.size());
  lists.elements.reserve((dim + 1) * packing.mesh.elements.size());
  lists.surfaces.reserve((dim + 1) * packing.mesh.surfaces.size());
  for (const auto& node : packing.mesh.nodes) lists.nodes.insert(lists.nodes.end(), node.begin(), node.end());
  for (const auto& element : packing.mesh.elements) {
    for (const NodeId node : element) lists.elements.push_back(node.value());
  }
  for (const mesh::Block& block : packing.mesh.blocks) {
    for (const std::size_t entry : {block.body.index(), block.nodes.first(), block.nodes.last(), block.elements.first(),
                                    block.elements.last(), block.cells.first(), block.cells.last()}) {
      lists.blocks.push_back(static_cast<std::int64_t>(entry));
    }
    lists.orientations.insert(lists.orientations.end(), block.orientation.coeffs().begin(), block.orientation.coeffs().end());
  }
  for (const mesh::Cell& cell : packing.mesh.cells) {
    lists.cells.push_back(static_cast<std::int64_t>(cell.kind));
    for (const NodeId node : cell.nodes) lists.cells.push_back(node.value());
  }
  for (const mesh::Body& body : packing.mesh.bodies) {
    lists.texts.push_back(body.name);
    lists.made_from.push_back(body.made_from);
    lists.bodies.insert(lists.bodies.end(), {body.material.value(), body.fixed ? 1 : 0});
    lists.velocities.insert(lists.velocities.end(), body.velocity.begin(), body.velocity.end());
  }
  for (const mesh::NamedSurface& surface : packing.mesh.surface_names) {
    lists.texts.push_back(surface.name);
    lists.surface_bodies.push_back(surface.body.value());
  }
  for (const auto& face : packing.mesh.surfaces) {
    for (const NodeId node : face.nodes) lists.surfaces.push_back(node.value());
    lists.surfaces.push_back(face.surface.value());
  }
  for (const Pose& pose : packing.poses) {
    lists.poses.insert(lists.poses.end(), pose.translation.begin(), pose.translation.end());
    lists.poses.insert(lists.poses.end(), pose.rotation.coeffs().begin(), pose.rotation.coeffs().end());
  }
  if (packing.settled) {
    lists.texts.push_back(packing.settled->criterion);
    for (const auto number : report_numbers) lists.report.push_back((*packing.settled).*number);
    lists.net_force = packing.settled->net_force.raw();
    lists.outcome.push_back(packing.settled->at_rest ? 1 : 0);
    for (const BlockId block : packing.settled->lost_blocks) lists.outcome.push_back(block.value());
  }
  return lists;
}

template <int dim>
void unpack_surfaces(const Lists& lists, mesh::BlockMesh<dim>& mesh) {
  for (std::size_t s = 0; s < lists.surface_bodies.size(); ++s) {
    const auto body = static_cast<std::size_t>(lists.surface_bodies[s]);
    mesh.surface_names.push_back({BodyId{body}, lists.texts.at(mesh.bodies.size() + s)});
  }
  for (std::size_t i = 0; i + dim < lists.surfaces.size(); i += dim + 1) {
    mesh::SurfaceFace<dim> face;
    for (std::size_t k = 0; k < dim; ++k) face.nodes[k] = NodeId{static_cast<std::size_t>(lists.surfaces[i + k])};
    face.surface = SurfaceId{static_cast<std::size_t>(lists.surfaces[i + dim])};
    mesh.surfaces.push_back(face);
  }
}

template <int dim>
mesh::BlockMesh<dim> unpack_mesh(const Lists& lists) {
  mesh::BlockMesh<dim> mesh;
  const auto at = [](const std::vector<std::int64_t>& list, std::size_t i) { return static_cast<std::size_t>(list.at(i)); };
  for (std::size_t i = 0; i < lists.nodes.size(); i += dim) mesh.nodes.push_back(Point<dim>(&lists.nodes[i]));
  for (std::size_t i = 0; i < lists.elements.size(); i += dim + 1) {
    typename mesh::BlockMesh<dim>::Element element;
    for (std::size_t corner = 0; corner <= dim; ++corner) element[corner] = NodeId{at(lists.elements, i + corner)};
    mesh.elements.push_back(element);
  }
  for (std::size_t i = 0; i < lists.blocks.size(); i += 7) {
    mesh.blocks.push_back({BodyId{at(lists.blocks, i)},
                           {at(lists.blocks, i + 1), at(lists.blocks, i + 2)},
                           {at(lists.blocks, i + 3), at(lists.blocks, i + 4)},
                           {at(lists.blocks, i + 5), at(lists.blocks, i + 6)},
                           Eigen::Quaterniond(&lists.orientations.at(4 * (i / 7)))});
  }
  for (std::size_t i = 0; i + 9 <= lists.cells.size(); i += 9) {
    mesh::Cell cell{static_cast<mesh::CellKind>(lists.cells[i]), {}};
    for (std::size_t k = 0; k < mesh::corner_count(cell.kind); ++k) cell.nodes[k] = NodeId{at(lists.cells, i + 1 + k)};
    mesh.cells.push_back(cell);
  }
  for (std::size_t b = 0; 2 * b < lists.bodies.size(); ++b) {
    const std::int64_t material = lists.bodies[2 * b];
    mesh.bodies.push_back({lists.texts.at(b), material < 0 ? MaterialId{} : MaterialId{at(lists.bodies, 2 * b)},
                           lists.bodies.at(2 * b + 1) != 0, Eigen::Vector3d(&lists.velocities.at(3 * b)),
                           lists.made_from.at(b)});
  }
  unpack_surfaces(lists, mesh);
  return mesh;
}

SettleReport unpack_report(const Lists& lists) {
  SettleReport report;
  for (std::size_t i = 0; i < report_numbers.size(); ++i) report.*report_numbers[i] = lists.report.at(i);
  report.net_force = Table<BlockId, double>(lists.net_force);
  report.criterion = lists.texts.back();
  report.at_rest = lists.outcome.at(0) != 0;
  for (std::size_t i = 1; i < lists.outcome.size(); ++i) {
    report.lost_blocks.emplace_back(static_cast<std::size_t>(lists.outcome[i]));
  }
  return report;
}

template <int dim>
Packing<dim> unpack(const Lists& lists, const std::string& key) {
  Packing<dim> packing{unpack_mesh<dim>(lists), {}, std::nullopt, key};
  for (std::size_t i = 0; i + 7 <= lists.poses.size(); i += 7) {
    const double* pose = &lists.poses[i];
    packing.poses.push_back({Eigen::Vector3d(pose), Eigen::Quaterniond(pose + 3)});
  }
  if (!lists.outcome.empty()) packing.settled = unpack_report(lists);
  return packing;
}

std::string digest(const std::string& key, const Lists& lists) {
  Hasher hasher;
  hasher.add(key);
  const auto add = [&hasher](const auto& list) {
    hasher.add(list.size()).add_bytes(list.data(), list.size() * sizeof list[0]);
  };
  for (const auto* list :
       {&lists.nodes, &lists.velocities, &lists.poses, &lists.report, &lists.orientations, &lists.net_force}) {
    add(*list);
  }
  for (const auto* list :
       {&lists.elements, &lists.blocks, &lists.bodies, &lists.outcome, &lists.cells, &lists.surfaces, &lists.surface_bodies}) {
    add(*list);
  }
  for (const auto* list : {&lists.texts, &lists.made_from}) {
    for (const std::string& text : *list) hasher.add(text);
  }
  return hasher.hex();
}

Lists read_lists(const Hdf5Reader& in) {
  Lists lists;
  for (const auto& [name, list] : {std::pair("nodes", &lists.nodes), std::pair("velocities", &lists.velocities),
                                   std::pair("poses", &lists.poses), std::pair("report", &lists.report),
                                   std::pair("orientations", &lists.orientations), std::pair("net_force", &lists.net_force)}) {
    *list = in.doubles(name);
  }
  for (const auto& [name, list] :
       {std::pair("elements", &lists.elements), std::pair("blocks", &lists.blocks), std::pair("bodies", &lists.bodies),
        std::pair("outcome", &lists.outcome), std::pair("cells", &lists.cells), std::pair("surfaces", &lists.surfaces),
        std::pair("surface_bodies", &lists.surface_bodies)}) {
    *list = in.integers(name);
  }
  lists.texts = in.texts("texts");
  lists.made_from = in.texts("made_from");
  return lists;
}

InputError refusal(const std::filesystem::path& file, const std::string& value, const std::string& rule,
                   const std::string& suggestion) {
  Problem problem;
  problem.where.file = file.string();
  problem.key = "packing";
  problem.value = value;
  problem.rule = rule;
  problem.suggestion = suggestion;
  return InputError(problem);
}

// Who wrote it, for which dimension: reason enough to refuse it before anything else is read.
void check_kind(const Hdf5Reader& in, const std::filesystem::path& file, int dimension) {
  if (!in.has_attribute("format") || in.text_attribute("format") != format_name) {
    throw refusal(file, "another kind of HDF5 file", "must be a packing", "Give the packing.h5 of a run");
  }
  if (const std::int64_t version = in.number_attribute("version"); version != format_version) {
    throw refusal(file, fmt::format("of format version {}", version),
                  fmt::format("this program reads version {}", format_version), "Settle the scene again");
  }
  if (const std::int64_t found = in.number_attribute("dimension"); found != dimension) {
    throw refusal(file, fmt::format("in {}-D", found), fmt::format("this scene is in {}-D", dimension),
                  "Give a packing of a scene with the same dimension");
  }
}

}  // namespace

template <int dim>
void write(const Packing<dim>& packing, const std::filesystem::path& file) {
  Lists lists = pack(packing);
  Hdf5Image image(sizeof(double) * (lists.nodes.size() + lists.elements.size() + lists.cells.size() + lists.blocks.size() +
                                    lists.orientations.size() + lists.poses.size() + lists.surfaces.size()));
  image.put_attribute("format", format_name);
  image.put_attribute("version", format_version);
  image.put_attribute("dimension", dim);
  image.put_attribute("key", packing.key);
  image.put_attribute("digest", digest(packing.key, lists));
  // Each list goes once it is in the image: a large packing would be in memory twice.
  const auto put = [&image](const char* name, auto& list, std::size_t width = 1) {
    const auto values = std::exchange(list, {});
    image.put(name, values, width);
  };
  put("nodes", lists.nodes, dim);
  put("elements", lists.elements, dim + 1);
  put("blocks", lists.blocks, 7);
  put("cells", lists.cells, 9);
  put("bodies", lists.bodies, 2);
  put("velocities", lists.velocities, 3);
  put("poses", lists.poses, 7);
  put("orientations", lists.orientations, 4);
  put("report", lists.report);
  put("net_force", lists.net_force);
  put("outcome", lists.outcome);
  put("surfaces", lists.surfaces, dim + 1);
  put("surface_bodies", lists.surface_bodies);
  image.put("texts", lists.texts);
  image.put("made_from", lists.made_from);
  write_text(file, image.bytes());
}

template <int dim>
Packing<dim> read(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    throw refusal(file, "", "no such file", "Check its path, or settle the scene again");
  try {
    const Hdf5Reader in(file);
    check_kind(in, file, dim);
    const std::string key = in.text_attribute("key");
    const Lists lists = read_lists(in);
    if (digest(key, lists) == in.text_attribute("digest")) return unpack<dim>(lists, key);
  } catch (const Hdf5Error&) {
    // said below, in words that help
  } catch (const std::logic_error&) {
    // a text that is not there, or a list longer than any
  } catch (const std::bad_alloc&) {
    // a list longer than memory
  }
  throw refusal(file, "damaged", "must be a whole packing", "Give the packing.h5 of a run, or settle the scene again");
}

std::optional<std::string> stored_key(const std::filesystem::path& file) {
  try {
    const Hdf5Reader in(file);
    if (in.text_attribute("format") != format_name || in.number_attribute("version") != format_version) return std::nullopt;
    return in.text_attribute("key");
  } catch (const Hdf5Error&) {
    return std::nullopt;
  }
}

template void write<2>(const Packing<2>&, const std::filesystem::path&);
template void write<3>(const Packing<3>&, const std::filesystem::path&);
template Packing<2> read<2>(const std::filesystem::path&);
template Packing<3> read<3>(const std::filesystem::path&);

}  // namespace scree::packing
