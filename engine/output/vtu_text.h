// The text of .vtu files, array by array, so that what is the same in all frames of a series is compressed once.
//
// VTK's XML format, version 1.0, inline binary: each array as base64 of [number of blocks, bytes a block, bytes of the last
// block if it is not full, compressed bytes of each block] in UInt64, then as base64 of the blocks, compressed by LZ4.
#pragma once

#include <string>
#include <vector>

#include "engine/output/frame.h"

namespace scree::output {

// One `DataArray` each.
std::string encoded(const std::vector<Array>& arrays);

struct EncodedGrid {
  std::size_t points = 0;
  std::size_t cells = 0;
  std::string text;  // `Points` and `Cells`
};
EncodedGrid encoded(const Grid& grid);

// The arrays of points and of cells as encoded() makes them.
std::string vtu_text(const EncodedGrid& grid, const std::string& point_arrays, const std::string& cell_arrays, double time);

}  // namespace scree::output
