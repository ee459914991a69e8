#include "engine/output/series.h"

#include <cstdlib>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "engine/base/atomic_file.h"
#include "engine/base/check.h"

namespace scree::output {

namespace fs = std::filesystem;

namespace {

struct VtkCell {
  int type;
  std::size_t corners;
};

VtkCell vtk_cell(CellType type) {
  switch (type) {
    case CellType::vertex:
      return {VTK_VERTEX, 1};
    case CellType::line:
      return {VTK_LINE, 2};
    case CellType::triangle:
      return {VTK_TRIANGLE, 3};
    case CellType::quadrilateral:
      return {VTK_QUAD, 4};
    case CellType::tetrahedron:
      return {VTK_TETRA, 4};
    case CellType::wedge:
      return {VTK_WEDGE, 6};
    case CellType::hexahedron:
      return {VTK_HEXAHEDRON, 8};
  }
  std::abort();
}

// VTK looks at our values where they are; it only reads them, although its interface asks for a non-const pointer.
template <class VtkArray, class T>
vtkSmartPointer<VtkArray> view(const T* values, std::size_t count, int components) {
  auto array = vtkSmartPointer<VtkArray>::New();
  array->SetNumberOfComponents(components);
  array->SetArray(const_cast<T*>(values), static_cast<vtkIdType>(count), /*save=*/1);
  return array;
}

vtkSmartPointer<vtkDataArray> view(const Array& array) {
  vtkSmartPointer<vtkDataArray> seen;
  if (const auto* reals = std::get_if<std::vector<double>>(&array.values)) {
    seen = view<vtkDoubleArray>(reals->data(), reals->size(), array.components);
  } else {
    const auto& integers = std::get<std::vector<std::int32_t>>(array.values);
    seen = view<vtkTypeInt32Array>(integers.data(), integers.size(), array.components);
  }
  seen->SetName(array.name.c_str());
  return seen;
}

void add_arrays(const std::vector<Array>& arrays, vtkIdType entries, vtkFieldData& data) {
  for (const Array& array : arrays) {
    const auto seen = view(array);
    SCREE_EXPECT(seen->GetNumberOfTuples() == entries);
    static_cast<void>(entries);
    data.AddArray(seen);
  }
}

vtkSmartPointer<vtkUnstructuredGrid> to_vtk(const Grid& grid, const Frame& frame) {
  auto data = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const double* coordinates = grid.points.empty() ? nullptr : grid.points.front().data();
  points->SetData(view<vtkDoubleArray>(coordinates, 3 * grid.points.size(), 3));
  data->SetPoints(points);

  vtkNew<vtkCellArray> cells;
  vtkNew<vtkTypeInt32Array> offsets;
  vtkNew<vtkUnsignedCharArray> types;
  const auto count = static_cast<vtkIdType>(grid.types.size());
  offsets->SetNumberOfValues(count + 1);
  types->SetNumberOfValues(count);
  std::size_t end = 0;
  offsets->SetValue(0, 0);
  for (vtkIdType i = 0; i < count; ++i) {
    const VtkCell cell = vtk_cell(grid.types[static_cast<std::size_t>(i)]);
    end += cell.corners;
    offsets->SetValue(i + 1, static_cast<std::int32_t>(end));
    types->SetValue(i, static_cast<unsigned char>(cell.type));
  }
  SCREE_EXPECT(end == grid.connectivity.size());
  cells->SetData(offsets, view<vtkTypeInt32Array>(grid.connectivity.data(), grid.connectivity.size(), 1));
  data->SetCells(types, cells);

  add_arrays(frame.points, data->GetNumberOfPoints(), *data->GetPointData());
  add_arrays(frame.cells, data->GetNumberOfCells(), *data->GetCellData());
  // ParaView shows this as the time of a .vtu opened on its own.
  vtkNew<vtkDoubleArray> time;
  time->SetName("TimeValue");
  time->InsertNextValue(frame.time);
  data->GetFieldData()->AddArray(time);
  return data;
}

// The file's content. Writing to memory leaves the disk to write_text, which notices a full one even at the last byte; VTK's
// own writer does not look at how closing the file went.
std::string vtu_text(const Grid& grid, const Frame& frame, const fs::path& file) {
  const auto data = to_vtk(grid, frame);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(data);
  writer->SetDataModeToBinary();
  writer->SetCompressorTypeToLZ4();
  writer->SetHeaderTypeToUInt64();
  writer->SetByteOrderToLittleEndian();
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0 || writer->GetErrorCode() != vtkErrorCode::NoError) {
    throw RunError(fmt::format("{}: could not be written (VTK: {})", file.string(),
                               vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode())));
  }
  return writer->GetOutputString();
}

// Removes all frames of a series but those in `kept`, and what an interrupted write left behind.
void remove_frames(const fs::path& folder, const std::string& name, const std::set<fs::path>& kept) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string file = entry.path().filename().string();
    const bool frame = file.starts_with(name + "_") && entry.path().extension() == ".vtu";
    if ((frame || file.starts_with(".part-" + name + "_")) && !kept.contains(entry.path())) fs::remove(entry.path());
  }
}

}  // namespace

Series::Series(fs::path directory, std::string name, std::optional<double> keep_until)
    : directory_(std::move(directory)), index_(directory_ / (name + ".pvd")), name_(std::move(name)) {
  try {
    fs::create_directories(directory_ / name_);
    fs::remove(directory_ / fmt::format(".part-{}.pvd", name_));
    std::set<fs::path> kept;
    if (keep_until && fs::exists(index_)) {
      for (SeriesEntry& entry : read_index(index_)) {
        if (entry.time > *keep_until) continue;
        kept.insert(directory_ / entry.file);
        entries_.push_back(std::move(entry));
      }
    }
    // The index goes first, so that it never names a file that is gone.
    if (entries_.empty()) {
      fs::remove(index_);
    } else {
      write_index(index_, entries_);
    }
    remove_frames(directory_ / name_, name_, kept);
  } catch (const fs::filesystem_error& error) {
    throw RunError(
        fmt::format("{}: the series could not be started ({}). Choose another --out", index_.string(), error.code().message()));
  }
}

void Series::write(const Grid& grid, const Frame& frame) {
  SCREE_EXPECT(entries_.empty() || frame.time > entries_.back().time);
  SeriesEntry entry{frame.time, fmt::format("{0}/{0}_{1:06}.vtu", name_, entries_.size())};
  const fs::path file = directory_ / entry.file;
  write_text(file, vtu_text(grid, frame, file));
  entries_.push_back(std::move(entry));
  try {
    write_index(index_, entries_);
  } catch (...) {
    entries_.pop_back();
    std::error_code ignored;
    fs::remove(file, ignored);
    throw;
  }
}

}  // namespace scree::output
