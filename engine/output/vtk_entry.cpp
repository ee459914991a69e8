#include <vtkLogger.h>

#include "engine/output/vtk_room.h"

const scree::output::VtkRoom* scree_vtk_room() {
  using namespace scree::output;
  // What goes wrong is said in our own words.
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  static constexpr VtkRoom room{vtk::render, vtk::animate, vtk::read_vtu, vtk::read_stored<2>, vtk::read_stored<3>};
  return &room;
}
