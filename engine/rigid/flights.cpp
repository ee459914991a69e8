#include "engine/rigid/flights.h"

#include <algorithm>

namespace scree::rigid {

Flights::Flights(const mesh::BlockMesh<3>& mesh, bool one_by_one) : flying_(mesh.bodies.size(), 0) {
  std::vector<int> blocks(mesh.bodies.size(), 0);
  for (const mesh::Block& block : mesh.blocks) {
    body_.push_back(block.body.value());
    ++blocks[block.body.index()];
  }
  if (one_by_one) return;
  for (const BodyId body : mesh.bodies.ids()) flying_[body.index()] = !mesh.bodies[body].fixed && blocks[body.index()] > 1;
}

void Flights::meet(int first_block, int second_block) {
  if (body_[first_block] == body_[second_block]) return;
  flying_[body_[first_block]] = 0;
  flying_[body_[second_block]] = 0;
}

bool Flights::together(int first_block, int second_block) const {
  return body_[first_block] == body_[second_block] && flying_[body_[first_block]] != 0;
}

int Flights::count() const {
  return static_cast<int>(std::count(flying_.begin(), flying_.end(), 1));
}

}  // namespace scree::rigid
