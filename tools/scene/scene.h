// A scene as the user wrote it, checked and in SI: what each stage gets its options from.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "contact/find_contacts.h"
#include "engine/base/material.h"
#include "engine/mesh/body_spec.h"
#include "engine/output/probes.h"
#include "engine/output/stored_field.h"
#include "engine/rigid/settle.h"
#include "thermal/heat_options.h"

namespace scree {

struct SettleStage {
  rigid::SettleOptions options;
  SourceLocation clearance_at;  // of options.clearance, that only the meshes can judge
  int seed = 0;                 // another one, another packing of the same bodies; 0: they start exactly where they are placed
  double largest_overlap = 0.02;  // of two blocks at rest, over the mean edge, that a sound run may have [-]
  bool accept_moving = false;     // a pile still moving at the limit is accepted: exit 0, and the summary says so
};

struct Scene {
  std::filesystem::path file;
  std::string title;
  int dimension = 3;
  Table<MaterialId, Material> materials;
  std::vector<mesh::BodySpec> bodies;  // BodyId counts in this order
  // At most one of the two: how the blocks come to their places. Neither: they stay where they were placed.
  std::optional<SettleStage> settle;
  std::optional<std::filesystem::path> packing;  // start from this packing file
  SourceLocation packing_at;                     // where it is named, for messages
  // Both or neither.
  std::optional<contact::ContactOptions> contact;
  std::optional<thermal::HeatOptions> heat;
  std::optional<Aabb<3>> effective_window;           // of which to find the effective conductivity [m]; 2-D ignores z
  std::optional<output::StoredField> initial_field;  // instead of heat->initial_temperature
  double frames_every =
      0;  // time between frames of heat.pvd, a multiple of heat->time.output_every; 0: at all output times [s]
  std::vector<output::ProbeSpec> probes;
  std::vector<std::filesystem::path> tables;     // files that functions and curves come from
  std::map<std::string, SourceLocation> places;  // where each key is written
  std::vector<std::string> bare_values;          // sentences on those that are probably meant in another unit than SI
  std::string effective;  // the scene as YAML with every default filled in; reading it gives the same scene
};

}  // namespace scree
