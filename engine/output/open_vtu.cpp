#include "engine/output/open_vtu.h"

#include <map>
#include <new>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkCell.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkXMLUnstructuredGridReader.h>

namespace scree::output {

namespace {

constexpr auto more_than_memory = "it says that it has more points or cells than there is memory for";

// VTK tells its errors to observers; without one it prints them.
void keep_first_error(vtkObject*, unsigned long, void* kept, void* message) {
  auto& reason = *static_cast<std::string*>(kept);
  if (!reason.empty() || message == nullptr) return;
  reason = static_cast<const char*>(message);
  // "ERROR: In FILE, line N\nCLASS (ADDRESS): WORDS\n\n"
  if (const auto words = reason.find("): "); words != std::string::npos) reason.erase(0, words + 3);
  while (!reason.empty() && (reason.back() == '\n' || reason.back() == ' ')) reason.pop_back();
}

// How many nodes a cell of this type has: any number of a polygon and its like; less than none if VTK knows no such cell or
// would want more than nodes of it.
vtkIdType node_count(int type) {
  constexpr vtkIdType none = -1;
  if (type == VTK_EMPTY_CELL || type == VTK_POLYHEDRON) return none;
  const vtkSmartPointer<vtkCell> cell = ::vtk::TakeSmartPointer(vtkGenericCell::InstantiateCell(type));
  return cell == nullptr ? none : cell->GetNumberOfPoints();
}

// VTK itself takes a file at its word, and looks where there is nothing.
void check_cells(vtkUnstructuredGrid& grid) {
  std::map<int, vtkIdType> counts;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c) {
    const int type = grid.GetCellType(c);
    const auto [count, fresh] = counts.try_emplace(type, 0);
    if (fresh) count->second = node_count(type);
    if (count->second < 0) throw std::runtime_error(fmt::format("element {} is of type {}, which cannot be used", c, type));
    vtkIdType size = 0;
    const vtkIdType* nodes = nullptr;
    grid.GetCellPoints(c, size, nodes);
    if (count->second > 0 && size != count->second) {
      throw std::runtime_error(fmt::format("element {} has {} nodes instead of {}", c, size, count->second));
    }
    for (vtkIdType i = 0; i < size; ++i) {
      if (nodes[i] < 0 || nodes[i] >= grid.GetNumberOfPoints()) {
        throw std::runtime_error(fmt::format("element {} uses a point that is not there", c));
      }
    }
  }
}

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> open_vtu(const std::filesystem::path& file) {
  std::string reason;
  vtkNew<vtkCallbackCommand> on_error;
  on_error->SetCallback(keep_first_error);
  on_error->SetClientData(&reason);
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->AddObserver(vtkCommand::ErrorEvent, on_error);
  reader->AddObserver(vtkCommand::WarningEvent, on_error);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, on_error);
  reader->SetParserErrorObserver(on_error);
  reader->SetReaderErrorObserver(on_error);
  reader->SetFileName(file.c_str());
  try {
    reader->Update();
  } catch (const std::bad_alloc&) {
    throw std::runtime_error(more_than_memory);
  } catch (const std::length_error&) {
    throw std::runtime_error(more_than_memory);
  }
  if (!reason.empty()) throw std::runtime_error(reason);
  if (reader->GetErrorCode() != 0) throw std::runtime_error("VTK cannot read it");
  check_cells(*reader->GetOutput());
  return reader->GetOutput();
}

}  // namespace scree::output
