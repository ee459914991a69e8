#include "tools/scene/doctor.h"

#include <algorithm>

#include <fmt/format.h>

#include "tools/scene/suspicions.h"

namespace scree {

namespace {

std::size_t free_bodies(const Scene& scene) {
  return static_cast<std::size_t>(
      std::count_if(scene.bodies.begin(), scene.bodies.end(), [](const auto& body) { return !body.fixed; }));
}

Model motion(const Scene& scene) {
  if (scene.packing) return {"motion", false, "the scene starts from a packing, where the blocks lie already"};
  if (!scene.settle) return {"motion", false, "the scene has no settle section, so the blocks stay where they are placed"};
  const Eigen::Vector3d& g = scene.settle->options.gravity;
  return {
      "motion", true,
      fmt::format("the scene has a settle section: {} of {} bodies are free and fall by ({:g}, {:g}, {:g}) m/s2 for at most "
                  "{:g} s",
                  free_bodies(scene), scene.bodies.size(), g.x(), g.y(), g.z(), scene.settle->options.limit)};
}

// The law of the joints, and how many pairs have another.
std::string words_of(const thermal::JointOptions& joint) {
  std::string text = "joints are " + thermal::name_of(joint.law);
  if (const auto* beta = std::get_if<thermal::StiffnessFactor>(&joint.law)) {
    text = fmt::format("joints of stiffness factor {:g}", beta->factor);
  } else if (const auto* h = std::get_if<thermal::JointConductance>(&joint.law)) {
    text = fmt::format("joints of {:g} W/m2/K", h->conductance);
  }
  return joint.rules.empty() ? text : text + fmt::format(", and contact.joints has {}", joint.rules.size());
}

std::vector<Model> heat_models(const Scene& scene) {
  const std::string absent = "the scene has no heat section";
  if (!scene.heat) return {{"conduction in blocks", false, absent}, {"heat through contacts", false, absent}};
  const thermal::HeatOptions& heat = *scene.heat;
  const bool euler = heat.time.integrator == thermal::Integrator::explicit_euler;
  std::vector<Model> models{
      {"conduction in blocks", true,
       fmt::format("the scene has a heat section: {:g} s in {} steps", heat.time.until, euler ? "explicit" : "implicit")},
      {"heat through contacts", true, fmt::format("heat passes between blocks that touch: {}", words_of(heat.joint))}};
  const std::size_t boundaries = heat.boundaries.size();
  models.push_back({"boundaries", boundaries > 0,
                    boundaries > 0 ? fmt::format("heat.boundaries has {}", boundaries) : "all surfaces are insulated"});
  if (scene.effective_window) {
    models.push_back(
        {"effective conductivity", true, "the scene has heat.effective_conductivity: steady states of its box of space"});
  }
  const std::size_t sources = heat.sources.size();
  models.push_back(
      {"sources", sources > 0, sources > 0 ? fmt::format("heat.sources has {}", sources) : "heat.sources is empty"});
  return models;
}

void append(Sentences& sentences, const Sentences& more) {
  sentences.insert(sentences.end(), more.begin(), more.end());
}

template <int dim>
std::vector<BodyCount> count_bodies(const mesh::BlockMesh<dim>& mesh) {
  std::vector<BodyCount> counts;
  for (const mesh::Body& body : mesh.bodies) counts.push_back({.name = body.name});
  for (const mesh::Block& block : mesh.blocks) {
    BodyCount& count = counts[block.body.index()];
    ++count.blocks;
    count.elements += block.elements.size();
    count.nodes += block.nodes.size();
  }
  return counts;
}

std::string count_table(std::vector<BodyCount> rows) {
  BodyCount total{.name = "all"};
  std::size_t width = 4;
  for (const BodyCount& row : rows) {
    total.blocks += row.blocks;
    total.elements += row.elements;
    total.nodes += row.nodes;
    width = std::max(width, row.name.size());
  }
  rows.push_back(total);
  std::string text = fmt::format("  {:<{}}  {:>8}  {:>9}  {:>9}\n", "body", width, "blocks", "elements", "nodes");
  for (const BodyCount& row : rows) {
    text += fmt::format("  {:<{}}  {:>8}  {:>9}  {:>9}\n", row.name, width, row.blocks, row.elements, row.nodes);
  }
  return text;
}

}  // namespace

std::vector<Model> models_of(const Scene& scene) {
  std::vector<Model> models{motion(scene)};
  for (Model& model : heat_models(scene)) models.push_back(std::move(model));
  return models;
}

template <int dim>
CheckReport check_scene(const Scene& scene, const mesh::BlockMesh<dim>& mesh) {
  CheckReport report{models_of(scene), count_bodies(mesh), {}};
  Sentences& sentences = report.suspicious;
  append(sentences, unused_materials(scene));
  append(sentences, free_without_motion(scene));
  append(sentences, cold_bare_temperatures(scene));
  if (!scene.settle && !scene.packing && !scene.heat) {
    sentences.push_back("the scene has neither a settle nor a heat section: nothing happens");
  }
  if (scene.packing) return report;  // the blocks lie where the packing says, not where they are meshed
  append(sentences, overlapping_bodies(mesh));
  if constexpr (dim == 3) {
    if (scene.settle) append(sentences, falling_forever(mesh, scene.settle->options.gravity));
  }
  if (scene.settle || !scene.heat) return report;
  append(sentences, isolated_blocks(mesh, *scene.contact, *scene.heat));
  append(sentences, probes_in_voids(mesh, scene.probes));
  return report;
}
template CheckReport check_scene(const Scene&, const mesh::BlockMesh<2>&);
template CheckReport check_scene(const Scene&, const mesh::BlockMesh<3>&);

std::string to_text(const CheckReport& report) {
  std::string text = "modelled\n";
  for (const Model& model : report.models) {
    text += fmt::format("  {:<3}  {:<21}  {}\n", model.modelled ? "yes" : "no", model.name, model.reason);
  }
  text += "size\n" + count_table(report.bodies);
  text += report.suspicious.empty() ? "nothing is suspicious\n" : "suspicious\n";
  for (const std::string& sentence : report.suspicious) text += fmt::format("  - {}\n", sentence);
  return text;
}

}  // namespace scree
