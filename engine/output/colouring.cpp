#include "engine/output/colouring.h"

#include <algorithm>

#include <vtkColorSeries.h>
#include <vtkColorTransferFunction.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>

namespace scree::output {

Colouring make_colours(vtkDataArray& array, std::array<double, 2> range) {
  if (array.GetDataType() == VTK_INT) {
    vtkNew<vtkColorSeries> series;
    series->SetColorScheme(vtkColorSeries::BREWER_QUALITATIVE_SET2);
    auto table = vtkSmartPointer<vtkLookupTable>::New();
    const int last = std::max(1, static_cast<int>(array.GetRange()[1]));
    table->SetNumberOfTableValues(last + 1);
    table->SetTableRange(0, last);
    for (int i = 0; i <= last; ++i) {
      const vtkColor3ub colour = series->GetColorRepeating(i);
      table->SetTableValue(i, colour.GetRed() / 255.0, colour.GetGreen() / 255.0, colour.GetBlue() / 255.0);
    }
    return {table, false};
  }
  if (!(range[1] > range[0])) range[1] = range[0] + 1;
  // Cold rock is dark blue, hot rock glows; the lightness rises all the way, so that it also reads in grey.
  auto glow = vtkSmartPointer<vtkColorTransferFunction>::New();
  glow->SetColorSpaceToLab();
  const auto add = [&](double at, double r, double g, double b) {
    glow->AddRGBPoint(range[0] + at * (range[1] - range[0]), r, g, b);
  };
  add(0, 0.22, 0.28, 0.56);
  add(0.3, 0.55, 0.30, 0.60);
  add(0.6, 0.85, 0.33, 0.32);
  add(0.8, 0.97, 0.60, 0.24);
  add(1, 1.00, 0.92, 0.60);
  return {glow, true};
}

}  // namespace scree::output
