#include "tools/scene/suspicions.h"

#include <algorithm>

#include <fmt/format.h>

namespace scree {

namespace {

constexpr double many_frames = 1e5;

}  // namespace

Sentences unused_materials(const Scene& scene) {
  Sentences sentences;
  for (const MaterialId material : scene.materials.ids()) {
    const bool used = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                  [&](const mesh::BodySpec& body) { return body.material == material; });
    if (!used) sentences.push_back(fmt::format("no body is made of material {}", scene.materials[material].name));
  }
  return sentences;
}

Sentences free_without_motion(const Scene& scene) {
  Sentences sentences;
  if (scene.settle || scene.packing) return sentences;
  const bool some_fixed = std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const auto& body) { return body.fixed; });
  for (const mesh::BodySpec& body : scene.bodies) {
    const bool moving = body.velocity.norm() > 0;
    if (!moving && (body.fixed || !some_fixed)) continue;
    sentences.push_back(fmt::format("body {} is free{}, but nothing moves without a settle section", body.name,
                                    moving ? " and has a velocity" : ""));
  }
  return sentences;
}

Sentences too_many_frames_of_a_fall(const Scene& scene) {
  if (!scene.settle) return {};
  const rigid::SettleOptions& fall = scene.settle->options;
  const double frames = fall.limit / std::max(fall.frame_interval, fall.step);
  if (frames <= many_frames) return {};
  return {fmt::format("up to {:.2g} frames of the fall will be written: raise settle.frame_interval", frames)};
}

Sentences too_many_outputs(const Scene& scene) {
  constexpr double many_rows = 1e6;
  if (!scene.heat || scene.heat->time.steady) return {};
  const double until = scene.heat->time.until, every = scene.heat->time.output_every;
  Sentences sentences;
  if (until / every > many_rows) {
    sentences.push_back(fmt::format("output.every of {:g} s makes {:.2g} output times in {:g} s", every, until / every, until));
  }
  const double frames = until / (scene.frames_every > 0 ? scene.frames_every : every);
  if (frames > many_frames)
    sentences.push_back(fmt::format("{:.2g} frames will be written: raise output.frames_every", frames));
  return sentences;
}

}  // namespace scree
