// One frame of a series, ready to be drawn; for this room only.
#pragma once

#include <filesystem>
#include <vector>

#include <vtkDataArray.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include "engine/output/render.h"
#include "engine/output/series_index.h"

namespace scree::output {

struct ShownFrame {
  double time = 0;  // [s]
  vtkSmartPointer<vtkUnstructuredGrid> grid;
  vtkDataArray* array = nullptr;  // of the grid: what the colours show, real values with the picture's offset added
};

// Reads a frame and makes the picture's array its scalars; vectors are shown by their length. With Picture::lines each contact
// becomes lines from where it is to the middles of its two blocks (only to the smaller where one is more than ten times as
// large), and shows magnitudes. Throws RunError, and InputError for an array that is not there.
ShownFrame read_shown(const Picture& picture, const SeriesEntry& entry);

// Points of what is drawn, inside the view and behind the cut; RunError if there are none.
std::vector<Eigen::Vector3d> points_in_view(vtkUnstructuredGrid& grid, const Picture& picture);

}  // namespace scree::output
