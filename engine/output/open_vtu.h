// A .vtu file as VTK holds it; for this room only.
#pragma once

#include <filesystem>

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

namespace scree::output {

// Its cells have the nodes that their types ask for. Throws std::runtime_error with the reason if the file cannot be read.
vtkSmartPointer<vtkUnstructuredGrid> open_vtu(const std::filesystem::path& file);

}  // namespace scree::output
