#include "tools/scene/suspicions.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/input.h"
#include "engine/base/units.h"

namespace scree {

namespace {

constexpr double many_frames = 1e5;

// Appends a sentence if `text` is a number without a unit that would be very cold in kelvin.
void judge_temperature(const InputValue& value, const std::string& key, Sentences& sentences) {
  constexpr double coldest_usual = 200;  // [K]; rock, ore and soil are warmer, and most temperatures in degC are below
  const auto parsed = parse_quantity(value.text, quantity::temperature);
  const double* kelvin = std::get_if<double>(&parsed);
  const bool bare =
      !value.text.empty() && (std::isdigit(static_cast<unsigned char>(value.text.back())) || value.text.back() == '.');
  if (kelvin == nullptr || !bare || *kelvin >= coldest_usual) return;
  sentences.push_back(fmt::format("{} is {}, which is in kelvin: write {} degC if that is meant", key, value.text, value.text));
}

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

// The effective scene still has the temperatures as they were written. Those of formulas and tables carry a unit or none on
// purpose.
Sentences cold_bare_temperatures(const Scene& scene) {
  Sentences sentences;
  const InputValue root = parse_yaml(scene.effective, scene.file.string());
  const InputValue* heat = root.find("heat");
  if (heat == nullptr) return sentences;
  const InputValue& initial = *heat->find("initial");
  judge_temperature(initial, "heat.initial", sentences);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const InputValue* temperature = scene.initial_field ? nullptr : initial.find(scene.bodies[i].name);
    if (temperature != nullptr) judge_temperature(*temperature, "heat.initial." + scene.bodies[i].name, sentences);
  }
  const std::vector<InputValue>& boundaries = heat->find("boundaries")->items;
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    for (const std::vector<std::string>& keys :
         {std::vector<std::string>{"temperature"}, {"convection", "surroundings"}, {"radiation", "surroundings"}}) {
      const InputValue* value = &boundaries[i];
      for (const std::string& key : keys) value = value == nullptr ? nullptr : value->find(key);
      if (value != nullptr)
        judge_temperature(*value, fmt::format("heat.boundaries[{}].{}", i, fmt::join(keys, ".")), sentences);
    }
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
