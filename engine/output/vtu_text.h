// The text of .vtu files, array by array, so that what is the same in all frames of a series is compressed once.
//
// VTK's XML format, version 1.0, inline binary: each array as base64 of [number of blocks, bytes a block, bytes of the last
// block if it is not full, compressed bytes of each block] in UInt64, then as base64 of the blocks, compressed by LZ4.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/output/frame.h"

namespace scree::output {

// One `DataArray` each, in place of what `text` held.
void encode(const std::vector<Array>& arrays, std::string& text);

struct EncodedGrid {
  std::size_t points = 0;
  std::size_t cells = 0;
  std::string text;  // `Points` and `Cells`
};
EncodedGrid encoded(const Grid& grid);

// The arrays of points and of cells as encode() makes them. Written part by part: putting together some megabytes first would
// cost more than all else of a frame. Throws RunError, and leaves no file.
void write_vtu(const std::filesystem::path& file, const EncodedGrid& grid, std::string_view point_arrays,
               std::string_view cell_arrays, std::string_view more_cell_arrays, double time);

}  // namespace scree::output
