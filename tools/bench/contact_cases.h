// Packings of any size on which the contact search is timed.
#pragma once

#include "engine/mesh/block_mesh.h"

namespace scree::bench {

// The unit cube cut into tetrahedra, six in each cell of a grid; each is a block. About `faces` boundary faces. Every joint is
// closed, and 24 blocks meet at a node.
mesh::BlockMesh<3> closed_lattice(std::size_t faces);

// The same tetrahedra, each turned at random about its centre: they overlap, as nothing in a pile does.
mesh::BlockMesh<3> turned_lattice(std::size_t faces);

// A cube of tetrahedra that fell apart on a plate, settled once in this process, and as many copies of it side by side as
// give about `faces` boundary faces.
mesh::BlockMesh<3> settled_piles(std::size_t faces);

// The same of eight cubes of 4 thousand tetrahedra each: blocks of many elements, as in most scenes.
mesh::BlockMesh<3> settled_cubes(std::size_t faces);

// Such cubes in a lattice, each joined to its neighbours on its whole sides. At least one; their number is a cube itself.
mesh::BlockMesh<3> jointed_cubes(std::size_t faces);

// Eight of them in such a lattice, and copies of that side by side: as many joints for every face whatever the size.
mesh::BlockMesh<3> jointed_eights(std::size_t faces);

}  // namespace scree::bench
