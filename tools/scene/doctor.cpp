#include "tools/scene/doctor.h"

#include <algorithm>

#include <fmt/format.h>

#include "tools/scene/heat_models.h"
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
  append(sentences, scene.bare_values);
  append(sentences, too_many_frames_of_a_fall(scene));
  append(sentences, too_many_outputs(scene));
  if (!scene.settle && !scene.packing && !scene.heat) {
    sentences.push_back("the scene has neither a settle nor a heat section: nothing happens");
  }
  if (!scene.settle && scene.effective_window) append(sentences, window_beyond_blocks(mesh, *scene.effective_window));
  if (scene.packing) return report;  // the run that made it has judged how the blocks lie
  append(sentences,
         overlapping_blocks(mesh, scene.settle && !scene.heat ? packing::Pairs::with_a_free_block : packing::Pairs::all));
  if constexpr (dim == 3) {
    if (scene.settle) append(sentences, falling_forever(mesh, scene.settle->options.gravity));
  }
  if (scene.settle || !scene.heat) return report;
  const auto search = thermal::contact_search(scene.heat->joint, mesh.bodies, *scene.contact);
  append(sentences, isolated_blocks(mesh, contact::find_contacts(mesh, search), scene));
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
