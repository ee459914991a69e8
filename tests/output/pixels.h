// Counts pixels of a picture by their colour.
#pragma once

#include <algorithm>
#include <filesystem>

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

namespace scree::output {

// Pixels of one kind of colour and their mean place, counted from the lower left.
struct Patch {
  int pixels = 0;
  double row = 0;
  double column = 0;
};

// Among the first `columns` columns.
template <class IsWanted>
Patch find_pixels(const std::filesystem::path& png, int columns, const IsWanted& is_wanted) {
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(png.c_str());
  reader->Update();
  vtkImageData& image = *reader->GetOutput();
  Patch patch;
  for (int row = 0; row < image.GetDimensions()[1]; ++row) {
    for (int column = 0; column < columns; ++column) {
      const auto* rgb = static_cast<unsigned char*>(image.GetScalarPointer(column, row, 0));
      if (!is_wanted(rgb[0], rgb[1], rgb[2])) continue;
      ++patch.pixels;
      patch.row += row;
      patch.column += column;
    }
  }
  patch.row /= std::max(1, patch.pixels);
  patch.column /= std::max(1, patch.pixels);
  return patch;
}

}  // namespace scree::output
