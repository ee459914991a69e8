// Which colour stands for which value; for this room only.
#pragma once

#include <array>

#include <vtkDataArray.h>
#include <vtkScalarsToColors.h>
#include <vtkSmartPointer.h>

namespace scree::output {

struct Colouring {
  vtkSmartPointer<vtkScalarsToColors> colours;
  bool legend = true;
};

// Real values: from cold to glowing over the range. Integers: one colour each, from 0 to the largest of the array, without a
// legend.
Colouring make_colours(vtkDataArray& array, std::array<double, 2> range);

}  // namespace scree::output
