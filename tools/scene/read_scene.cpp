#include "tools/scene/read_scene.h"

#include <algorithm>
#include <tuple>

#include "engine/base/plain_path.h"
#include "tools/scene/keys.h"
#include "tools/scene/sections.h"
#include "tools/scene/suspicions.h"

namespace scree {

namespace {

void apply_overrides(const std::vector<std::string>& overrides, InputValue& root, Problems& problems) {
  for (const std::string& assignment : overrides) {
    try {
      apply_override(root, assignment);
    } catch (const InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
}

// The length of vectors has to be known before anything is checked.
int dimension_of(const InputValue& root) {
  const InputValue* dimension = root.find("dimension");
  return dimension != nullptr && dimension->text == "2" ? 2 : 3;
}

bool names_a_file(const Checked& checked) {
  if (checked.key == nullptr || !checked.sound) return false;
  return checked.key->type == KeyType::path || (checked.key->type == KeyType::table && checked.texts.empty());
}

// The tables that functions and curves come from.
void collect_tables(const Checked& checked, std::vector<std::filesystem::path>& tables) {
  if (names_a_file(checked) && checked.key->type == KeyType::table) tables.emplace_back(checked.text);
  for (const CheckedEntry& entry : checked.entries) collect_tables(entry.value, tables);
  for (const Checked& item : checked.items) collect_tables(item, tables);
}

// Paths in a file are relative to it, those of an override (which stands at no line) to the current directory.
void make_paths_absolute(Checked& checked, const std::filesystem::path& folder) {
  if (names_a_file(checked)) {
    const std::filesystem::path base = checked.where.line == 0 ? std::filesystem::current_path() : folder;
    checked.text = plain_path(base / checked.text).string();
  }
  for (CheckedEntry& entry : checked.entries) make_paths_absolute(entry.value, folder);
  for (Checked& item : checked.items) make_paths_absolute(item, folder);
}

void collect_places(const Checked& checked, std::map<std::string, SourceLocation>& places) {
  if (checked.given && !checked.path.empty()) places.emplace(checked.path, checked.where);
  for (const CheckedEntry& entry : checked.entries) collect_places(entry.value, places);
  for (const Checked& item : checked.items) collect_places(item, places);
}

// Of a key, or of the section that would hold it.
SourceLocation place_of(const Scene& scene, std::string key) {
  while (!key.empty()) {
    const auto found = scene.places.find(key);
    if (found != scene.places.end()) return found->second;
    const auto cut = key.find_last_of(".[");
    key.resize(cut == std::string::npos ? 0 : cut);
  }
  SourceLocation file;
  file.file = scene.file.string();
  return file;
}

[[noreturn]] void refuse(Problems problems) {
  std::stable_sort(problems.begin(), problems.end(), [](const Problem& a, const Problem& b) {
    return std::tie(a.where.line, a.where.column) < std::tie(b.where.line, b.where.column);
  });
  throw InputError(std::move(problems));
}

void check_packing(const Checked& packing, Problems& problems) {
  std::error_code ignored;
  if (packing.sound && !std::filesystem::is_regular_file(packing.text, ignored)) {
    problems.push_back(packing.problem(packing.text, "must be a file that exists"));
  }
}

// What is stored has no part in a steady state, so a scene need not name it; the equations are written with it.
void store_something(Table<MaterialId, Material>& materials) {
  for (Material& material : materials) {
    if (!material.density) material.density = 1;
    if (!material.specific_heat) material.specific_heat = 1;
  }
}

Scene read(InputValue root, const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  Problems problems;
  apply_overrides(overrides, root, problems);
  Scene scene;
  scene.file = file;
  scene.dimension = dimension_of(root);
  Checked checked = check_input(root, scene_keys(), scene.dimension, problems);
  fill_in_intervals(checked);
  make_paths_absolute(checked, std::filesystem::absolute(file).parent_path());

  scene.title = checked.at("title").text;
  scene.materials = read_materials(checked.at("materials"), scene.dimension, problems);
  scene.bodies = read_bodies(checked, scene.dimension, problems);
  if (const Checked* settle = checked.find("settle")) scene.settle = read_settle(*settle, problems);
  if (scene.settle) start_aside(*scene.settle, scene.bodies);
  if (const Checked* packing = checked.find("packing")) {
    check_packing(*packing, problems);
    scene.packing = packing->text;
    scene.packing_at = packing->where;
  }
  if (const Checked* contact = checked.find("contact")) scene.contact = read_contact(*contact);
  if (const Checked* heat = checked.find("heat")) {
    scene.heat = read_heat(checked, problems);
    if (!scene.heat->time.steady) check_rows(checked.at("output"), scene.heat->time.until, problems);
    scene.effective_window = read_effective_window(*heat, scene.dimension, problems);
    scene.initial_field = read_initial_field(heat->at("initial"));
  }
  scene.frames_every = read_frames_every(checked.at("output"), problems);
  scene.probes = read_probes(checked.at("output"), problems);
  for (const output::ProbeSpec& probe : scene.probes) {
    if (probe.exact && scene.heat) check_lasts(*probe.exact, *scene.heat, problems);
  }
  check_needs(scene, checked, problems);
  if (!problems.empty()) refuse(std::move(problems));
  if (scene.heat && scene.heat->time.steady) store_something(scene.materials);
  collect_tables(checked, scene.tables);
  collect_places(checked, scene.places);
  scene.bare_values = bare_values(checked);
  scene.effective = to_yaml(checked);
  return scene;
}

}  // namespace

InputError located(const Scene& scene, const InputError& error) {
  Problems problems = error.problems();
  for (Problem& problem : problems) {
    if (problem.where.file.empty()) problem.where = place_of(scene, problem.key);
  }
  return InputError(std::move(problems));
}

Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return read(read_yaml(file), file, overrides);
}

Scene read_scene_text(const std::string& text, const std::filesystem::path& folder, const std::vector<std::string>& overrides) {
  return read(parse_yaml(text, "scene"), folder / "scene", overrides);
}

}  // namespace scree
