#include "tools/report/pictures.h"

#include <functional>
#include <optional>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "engine/base/scratch_folder.h"
#include "engine/output/render.h"
#include "engine/packing/remaining.h"
#include "tools/report/page.h"

namespace scree::report {

namespace {

// Middle of the free blocks that are left along y, or of all if none is free; nothing in 2-D. Throws InputError for a damaged
// packing.
std::optional<double> middle(const run::RunFiles& files) {
  if (!std::filesystem::exists(files.packing())) return std::nullopt;
  mesh::BlockMesh<3> mesh;
  try {
    mesh = packing::remaining(packing::read<3>(files.packing())).mesh;
  } catch (const InputError&) {
    packing::read<2>(files.packing());
    return std::nullopt;  // there is nothing to cut
  }
  Aabb<3> free, all;
  for (const mesh::Block& block : mesh.blocks) {
    for (const NodeId node : block.nodes) {
      all.extend(mesh.nodes[node]);
      if (!mesh.bodies[block.body].fixed) free.extend(mesh.nodes[node]);
    }
  }
  return (free.isEmpty() ? all : free).center().y();
}

output::Picture picture_of(const run::RunFiles& files, const std::string& series) {
  output::Picture picture;
  picture.series = files.directory / (series + ".pvd");
  picture.width = 1000;
  picture.height = 580;
  picture.array = "body";
  if (series == "heat") {
    picture.array = "temperature";
    picture.title = "temperature [degC]";
    picture.offset = -273.15;
  }
  if (series == "contacts") {
    picture.array = "heat_flow";
    picture.title = "heat flow [W]";
    picture.lines = true;
  }
  return picture;
}

Drawn still(const ScratchFolder& workshop, const output::Picture& picture, const std::string& caption) {
  const auto png = workshop.path() / "picture.png";
  output::render(picture, png);
  return {fmt::format(R"(<img alt="{}" src="{}">)", escaped(caption), data_url(png, "image/png")), caption};
}

Drawn moving(const ScratchFolder& workshop, output::Picture picture, const std::string& caption) {
  picture.width = 840;
  picture.height = 490;
  const auto webm = workshop.path() / "animation.webm";
  output::animate(picture, {}, webm);
  return {fmt::format("<video controls loop muted src=\"{}\"></video>", data_url(webm, "video/webm")), caption};
}

}  // namespace

std::vector<Drawn> draw_pictures(const run::RunFiles& files, const Wanted& wanted) {
  const ScratchFolder workshop;
  const auto there = [&](const std::string& series) { return std::filesystem::exists(files.directory / (series + ".pvd")); };
  std::vector<Drawn> drawn;
  if (there("settle")) {
    drawn.push_back(still(workshop, picture_of(files, "settle"), "The blocks where they came to rest, by body"));
    if (wanted.animated) drawn.push_back(moving(workshop, picture_of(files, "settle"), "The fall"));
  }
  if (!there("heat")) return drawn;
  drawn.push_back(still(workshop, picture_of(files, "heat"), "Temperature at the end"));
  if (const auto y = middle(files)) {
    output::Picture cut = picture_of(files, "heat");
    cut.cut = *y;
    drawn.push_back(still(workshop, cut, fmt::format("Temperature at the end, cut at y = {:.3g} m", *y)));
  }
  if (wanted.animated) drawn.push_back(moving(workshop, picture_of(files, "heat"), "The heating"));
  if (wanted.contacts && there("contacts")) {
    drawn.push_back(still(workshop, picture_of(files, "contacts"),
                          "Contacts at the end as lines between their blocks, coloured by the size of their heat flow"));
  }
  return drawn;
}

}  // namespace scree::report
