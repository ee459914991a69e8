// .vtu files, array by array, so that what is the same in all frames of a series is compressed once.
//
// VTK's XML format, version 1.0, raw appended binary: each array as [number of blocks, bytes a block, bytes of the last block
// if it is not full, compressed bytes of each block] in UInt64 and the blocks, compressed by LZ4.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/output/frame.h"

namespace scree::output {

// What stands in the appended section of a file, one array behind the other, and what its XML says of them.
struct EncodedArrays {
  struct Entry {
    const char* type;  // VTK's name
    std::string name;
    int components;
    std::uint64_t offset;  // of its first byte in `bytes`
  };
  std::vector<Entry> entries;
  std::string bytes;
};

// In place of what `encoded` held, in its memory.
void encode(const std::vector<Array>& arrays, EncodedArrays& encoded);

struct EncodedGrid {
  std::size_t points = 0;
  std::size_t cells = 0;
  EncodedArrays arrays;  // points, connectivity, offsets, types
};
EncodedGrid encoded(const Grid& grid);

// Arrays as encode() makes them.
struct EncodedFrame {
  const EncodedGrid& grid;
  const EncodedArrays& points;
  const EncodedArrays& cells;
  const EncodedArrays& more_cells;
  double time = 0;  // [s]
};

// Written part by part: putting together some megabytes first would cost more than all else of a frame. Throws RunError, and
// leaves no file.
void write_vtu(const std::filesystem::path& file, const EncodedFrame& frame);

}  // namespace scree::output
