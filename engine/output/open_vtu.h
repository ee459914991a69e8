// A .vtu file as VTK holds it; for this room only.
#pragma once

#include <filesystem>

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

namespace scree::output {

// Throws std::runtime_error with VTK's reason if the file cannot be read.
vtkSmartPointer<vtkUnstructuredGrid> open_vtu(const std::filesystem::path& file);

}  // namespace scree::output
