// What is allowed in a scene, and yet seldom meant. Each returns sentences.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/checked_input.h"
#include "engine/packing/asked_pairs.h"
#include "tools/scene/scene.h"

namespace scree {

using Sentences = std::vector<std::string>;

Sentences unused_materials(const Scene& scene);

// Something is held fixed and something is not, and nothing moves.
Sentences free_without_motion(const Scene& scene);

// A bare number of 25 for a temperature is 25 K, one of 45 for an angle 45 radians.
Sentences bare_values(const Checked& checked);
// ... of one number, as the text at this path of the input gives it; its value in SI.
std::optional<std::string> bare_value(const std::string& path, const std::string& text, double value, const Quantity& quantity);

// Output times by the million, frames by the hundred thousand.
Sentences too_many_frames_of_a_fall(const Scene& scene);
Sentences too_many_outputs(const Scene& scene);

// Blocks that lie in each other before anything moves. Two fixed ones do in the corners of a box of walls; where there is heat,
// what they share is heated twice. To look at different bodies only costs next to nothing where they are apart.
template <int dim>
Sentences overlapping_blocks(const mesh::BlockMesh<dim>& mesh, packing::Pairs asked);

// Free blocks with no fixed block below them, as gravity goes.
Sentences falling_forever(const mesh::BlockMesh<3>& mesh, const Eigen::Vector3d& gravity);

// A window of the effective conductivity that reaches beyond all blocks: what is void there counts as part of the sample.
template <int dim>
Sentences window_beyond_blocks(const mesh::BlockMesh<dim>& mesh, const Aabb<3>& window);

// Blocks that no heat can reach through a contact, in bodies that no boundary or source heats; and, of a scene that has a
// section on contacts, that there are none.
template <int dim>
Sentences isolated_blocks(const mesh::BlockMesh<dim>& mesh, const contact::ContactSet<dim>& contacts, const Scene& scene);

}  // namespace scree
