#include "engine/output/read_vtu.h"

#include <algorithm>
#include <string>

#include <vtkCellTypes.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include "engine/output/open_vtu.h"
#include "engine/output/vtk_room.h"

namespace scree::output {

namespace {

std::string vtk_name(int type) {
  const std::string name = vtkCellTypes::GetClassNameFromTypeId(type);
  return name.starts_with("vtk") ? name.substr(3) : name;
}

template <int corners>
mesh::RawCell<corners> cell_of(std::size_t number, const vtkIdType* nodes) {
  mesh::RawCell<corners> cell{number, {}};
  for (int i = 0; i < corners; ++i) cell.nodes[i] = static_cast<std::size_t>(nodes[i]);
  return cell;
}

mesh::RawLargeCell large_cell(mesh::CellKind kind, std::size_t number, const vtkIdType* nodes) {
  mesh::RawLargeCell cell{kind, number, {}};
  std::copy_n(nodes, mesh::corner_count(kind), cell.nodes.begin());
  return cell;
}

void add_cell(vtkUnstructuredGrid& grid, vtkIdType c, mesh::RawMesh& raw) {
  vtkIdType size = 0;
  const vtkIdType* nodes = nullptr;
  grid.GetCellPoints(c, size, nodes);
  const auto number = static_cast<std::size_t>(c);
  switch (const int type = grid.GetCellType(c); type) {
    case VTK_TETRA:
      raw.tetrahedra.push_back(cell_of<4>(number, nodes));
      break;
    case VTK_TRIANGLE:
      raw.triangles.push_back(cell_of<3>(number, nodes));
      break;
    case VTK_QUAD:
      raw.cells.push_back(large_cell(mesh::CellKind::quadrilateral, number, nodes));
      break;
    case VTK_WEDGE:
      raw.cells.push_back(large_cell(mesh::CellKind::wedge, number, nodes));
      break;
    case VTK_HEXAHEDRON:
      raw.cells.push_back(large_cell(mesh::CellKind::hexahedron, number, nodes));
      break;
    case VTK_VERTEX:
    case VTK_LINE:
      for (vtkIdType i = 0; i < size; ++i) raw.marked.push_back(static_cast<std::size_t>(nodes[i]));
      break;
    default:
      ++raw.unusable[vtk_name(type)];
  }
}

}  // namespace

mesh::RawMesh vtk::read_vtu(const std::filesystem::path& file) {
  const vtkSmartPointer<vtkUnstructuredGrid> opened = open_vtu(file);
  vtkUnstructuredGrid& grid = *opened;
  mesh::RawMesh raw;
  raw.points.reserve(static_cast<std::size_t>(grid.GetNumberOfPoints()));
  raw.point_numbers.reserve(static_cast<std::size_t>(grid.GetNumberOfPoints()));
  for (vtkIdType p = 0; p < grid.GetNumberOfPoints(); ++p) {
    Eigen::Vector3d point;
    grid.GetPoint(p, point.data());
    raw.points.push_back(point);
    raw.point_numbers.push_back(static_cast<std::size_t>(p));
  }
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c) add_cell(grid, c, raw);
  return raw;
}

}  // namespace scree::output
