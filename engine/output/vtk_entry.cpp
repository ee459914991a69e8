#include "engine/output/vtk_room.h"

const scree::output::VtkRoom* scree_vtk_room() {
  using namespace scree::output;
  static constexpr VtkRoom room{vtk::render, vtk::animate, vtk::read_vtu, vtk::read_stored<2>, vtk::read_stored<3>};
  return &room;
}
