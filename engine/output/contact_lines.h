// Contacts as lines between the blocks they join; for this room only.
#pragma once

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

namespace scree::output {

// From a frame of `contacts.pvd` and the frame of `heat.pvd` at the same time. The arrays of a contact go to its lines, real
// values by their magnitude.
vtkSmartPointer<vtkUnstructuredGrid> contact_lines(vtkUnstructuredGrid& contacts, vtkUnstructuredGrid& blocks);

}  // namespace scree::output
