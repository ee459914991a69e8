#include "engine/output/shown_frame.h"

#include <cmath>

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include "engine/base/check.h"
#include "engine/output/contact_lines.h"
#include "engine/output/open_vtu.h"

namespace scree::output {

namespace {

vtkSmartPointer<vtkUnstructuredGrid> read_frame(const std::filesystem::path& file) {
  try {
    return open_vtu(file);
  } catch (const std::runtime_error& error) {
    throw RunError(fmt::format("{}: could not be read ({}). Run the scene again", file.string(), error.what()));
  }
}

std::string array_names(vtkUnstructuredGrid& grid) {
  std::string names;
  for (vtkDataSetAttributes* data : std::initializer_list<vtkDataSetAttributes*>{grid.GetPointData(), grid.GetCellData()}) {
    for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
      names += fmt::format("{}{}", names.empty() ? "" : ", ", data->GetArrayName(i));
    }
  }
  return names;
}

// Makes the wanted array the scalars of the grid, with the offset added, and returns it. Vectors are drawn by their length.
vtkDataArray* select_array(vtkUnstructuredGrid& grid, const Picture& picture) {
  for (vtkDataSetAttributes* data : std::initializer_list<vtkDataSetAttributes*>{grid.GetPointData(), grid.GetCellData()}) {
    vtkDataArray* array = data->GetArray(picture.array.c_str());
    if (array == nullptr) continue;
    if (array->GetDataType() != VTK_INT) {
      vtkNew<vtkDoubleArray> shown;
      shown->SetName("shown");
      shown->SetNumberOfValues(array->GetNumberOfTuples());
      std::vector<double> tuple(array->GetNumberOfComponents());
      for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i) {
        array->GetTuple(i, tuple.data());
        const double length = std::hypot(tuple[0], tuple.size() > 1 ? tuple[1] : 0, tuple.size() > 2 ? tuple[2] : 0);
        shown->SetValue(i, (tuple.size() == 1 ? tuple[0] : length) + picture.offset);
      }
      data->SetScalars(shown);
    } else {
      data->SetScalars(array);
    }
    return data->GetScalars();
  }
  Problem problem;
  problem.key = "array";
  problem.value = picture.array;
  problem.rule = "must be one of " + array_names(grid);
  throw InputError(std::move(problem));
}

// Of the blocks at the time of a frame of contacts.
vtkSmartPointer<vtkUnstructuredGrid> blocks_at(const Picture& picture, double time) {
  const std::filesystem::path heat = picture.series.parent_path() / "heat.pvd";
  for (const SeriesEntry& entry : read_index(heat)) {
    if (entry.time == time) return read_frame(heat.parent_path() / entry.file);
  }
  throw RunError(fmt::format("{}: has no frame at {:g} s to find the blocks of the contacts in", heat.string(), time));
}

}  // namespace

ShownFrame read_shown(const Picture& picture, const SeriesEntry& entry) {
  ShownFrame frame;
  frame.time = entry.time;
  frame.grid = read_frame(picture.series.parent_path() / entry.file);
  if (picture.lines) frame.grid = contact_lines(*frame.grid, *blocks_at(picture, entry.time));
  frame.array = select_array(*frame.grid, picture);
  return frame;
}

std::vector<Eigen::Vector3d> points_in_view(vtkUnstructuredGrid& grid, const Picture& picture) {
  std::vector<Eigen::Vector3d> points;
  for (vtkIdType i = 0; i < grid.GetNumberOfPoints(); ++i) {
    const Eigen::Vector3d point(grid.GetPoint(i));
    if (picture.view && !picture.view->contains(point)) continue;
    if (!picture.cut || point.y() >= *picture.cut) points.push_back(point);
  }
  if (points.empty()) throw RunError(fmt::format("{}: there is nothing in the view to draw", picture.series.string()));
  return points;
}

}  // namespace scree::output
