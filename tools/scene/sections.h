// The sections of a scene, one function each, from checked input to the structs of the stages. Each appends what is wrong with
// its own values; values that are not sound come out as zeros, and the scene is thrown away.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/checked_input.h"
#include "tools/scene/scene.h"

namespace scree {

using Problems = std::vector<Problem>;

Table<MaterialId, Material> read_materials(const Checked& materials, int dimension, Problems& problems);
std::vector<mesh::BodySpec> read_bodies(const Checked& scene, int dimension, Problems& problems);
SettleStage read_settle(const Checked& settle, Problems& problems);
// Moves the free bodies aside as the seed says, across gravity.
void start_aside(const SettleStage& settle, std::vector<mesh::BodySpec>& bodies);
contact::ContactOptions read_contact(const Checked& contact);
thermal::JointOptions read_joint(const Checked& scene, Problems& problems);
thermal::HeatOptions read_heat(const Checked& scene, Problems& problems);
std::optional<Aabb<3>> read_effective_window(const Checked& heat, int dimension, Problems& problems);
std::optional<output::StoredField> read_initial_field(const Checked& initial);
// Gives a scene with heat in time the intervals between outputs that it does not name.
void fill_in_intervals(Checked& checked);

// Refuses intervals that no run gets to the end of.
void check_rows(const Checked& output, double until, Problems& problems);
double read_frames_every(const Checked& output, Problems& problems);
std::vector<output::ProbeSpec> read_probes(const Checked& section, Problems& problems);

// What one section needs of another: a density to settle, a conductivity for heat, an integrator that can do what changes.
void check_needs(const Scene& scene, const Checked& checked, Problems& problems);

// A quantity of place and time, or of temperature, in any of its forms.
Function read_function(const Checked& value, Problems& problems);
// A table over time has to last as long as the run.
void check_lasts(const Function& function, const thermal::HeatOptions& options, Problems& problems);
Curve read_curve(const Checked& value, Problems& problems);

// How a body is turned; not at all without a rotation.
Eigen::Quaterniond read_rotation(const Checked* rotation, int dimension, Problems& problems);

// The names of a map, in its order.
std::vector<std::string> names_of(const Checked& map);

// The position of what `reference` names among `names`; a problem, and an invalid id, if there is none of that name.
template <class IdType>
IdType resolve(const Checked& reference, const std::vector<std::string>& names, const std::string& what, Problems& problems);

// Whether a box of space may be a plane, a line or a point.
enum class Flat { allowed, refused };

// A corner below the opposite one in every direction of space.
void check_corners(const Checked& region, Flat flat, int dimension, Problems& problems);

}  // namespace scree
