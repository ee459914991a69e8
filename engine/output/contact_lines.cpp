#include "engine/output/contact_lines.h"

#include <array>
#include <cmath>
#include <vector>

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <Eigen/Geometry>

#include "engine/base/check.h"

namespace scree::output {

namespace {

// A line to the middle of a block this many times as large as the other would show nothing of either.
constexpr double too_large = 10;

vtkDataArray& cell_array(vtkUnstructuredGrid& grid, const char* name) {
  vtkDataArray* array = grid.GetCellData()->GetArray(name);
  if (array == nullptr) throw RunError(std::string("the series has no array ") + name + " to draw lines from");
  return *array;
}

// The boxes of the blocks by their numbers.
std::vector<Eigen::AlignedBox3d> boxes_of(vtkUnstructuredGrid& blocks) {
  vtkDataArray& numbers = cell_array(blocks, "block");
  std::vector<Eigen::AlignedBox3d> boxes;
  for (vtkIdType cell = 0; cell < blocks.GetNumberOfCells(); ++cell) {
    const auto block = static_cast<std::size_t>(numbers.GetComponent(cell, 0));
    if (block >= boxes.size()) boxes.resize(block + 1);
    std::array<double, 6> bounds{};
    blocks.GetCellBounds(cell, bounds.data());
    boxes[block].extend(Eigen::Vector3d(bounds[0], bounds[2], bounds[4]));
    boxes[block].extend(Eigen::Vector3d(bounds[1], bounds[3], bounds[5]));
  }
  return boxes;
}

struct Lines {
  vtkNew<vtkPoints> points;
  vtkSmartPointer<vtkUnstructuredGrid> grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  std::vector<vtkIdType> contacts;  // of each line

  void add(const Eigen::Vector3d& from, const Eigen::Vector3d& to, vtkIdType contact) {
    const std::array<vtkIdType, 2> ends{points->InsertNextPoint(from.data()), points->InsertNextPoint(to.data())};
    grid->InsertNextCell(VTK_LINE, 2, ends.data());
    contacts.push_back(contact);
  }
};

void copy_arrays(vtkUnstructuredGrid& contacts, Lines& lines) {
  for (int i = 0; i < contacts.GetCellData()->GetNumberOfArrays(); ++i) {
    vtkDataArray& from = *contacts.GetCellData()->GetArray(i);
    const auto to = vtkSmartPointer<vtkDataArray>::Take(from.NewInstance());
    to->SetName(from.GetName());
    to->SetNumberOfTuples(static_cast<vtkIdType>(lines.contacts.size()));
    for (std::size_t line = 0; line < lines.contacts.size(); ++line) {
      to->SetComponent(static_cast<vtkIdType>(line), 0, std::abs(from.GetComponent(lines.contacts[line], 0)));
    }
    lines.grid->GetCellData()->AddArray(to);
  }
}

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> contact_lines(vtkUnstructuredGrid& contacts, vtkUnstructuredGrid& blocks) {
  const auto boxes = boxes_of(blocks);
  vtkDataArray& owners = cell_array(contacts, "owner");
  vtkDataArray& targets = cell_array(contacts, "target");
  Lines lines;
  for (vtkIdType contact = 0; contact < contacts.GetNumberOfCells(); ++contact) {
    const Eigen::AlignedBox3d& owner = boxes.at(static_cast<std::size_t>(owners.GetComponent(contact, 0)));
    const Eigen::AlignedBox3d& target = boxes.at(static_cast<std::size_t>(targets.GetComponent(contact, 0)));
    const Eigen::Vector3d at(contacts.GetPoint(contact));
    const double ratio = owner.diagonal().norm() / target.diagonal().norm();
    if (ratio < too_large) lines.add(at, owner.center(), contact);
    if (ratio > 1 / too_large) lines.add(at, target.center(), contact);
  }
  lines.grid->SetPoints(lines.points);
  copy_arrays(contacts, lines);
  return lines.grid;
}

}  // namespace scree::output
