// Gmsh, quiet and reproducible: one model at a time, no option files, one thread, fixed seed.
#pragma once

#include <functional>

#include "engine/mesh/gmsh_library.h"
#include "engine/mesh/raw_mesh.h"

namespace scree::mesh {

// Runs `work` in a fresh Gmsh.
void with_gmsh(const std::function<void()>& work);

// How Gmsh triangulates faces.
enum class FaceMesher { mesh_adapt = 1, delaunay = 5, frontal_delaunay = 6 };

// Makes the elements of the current model about `mesh_size` long and fills dimension `dimension` with them.
void generate(int dimension, double mesh_size, FaceMesher faces = FaceMesher::frontal_delaunay);

// Lets `generate` leave no triangle among the quadrilaterals of a plane shape.
void only_quadrilaterals();

// The nodes and elements of the current model.
RawMesh model_mesh();

}  // namespace scree::mesh
