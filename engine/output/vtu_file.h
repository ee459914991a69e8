// .vtu files, array by array, so that what is the same in all frames of a series is compressed once.
//
// VTK's XML format, version 1.0, raw appended binary: each array as [number of blocks, bytes a block, bytes of the last block
// if it is not full, compressed bytes of each block] in UInt64 and the blocks, compressed by LZ4.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/page_buffer.h"
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
  PageBuffer bytes;
};

// What frames share. If it is large, it fills whole pages, and then files are laid out so that they can be written directly
// from where it is.
struct EncodedGrid {
  std::size_t points = 0;
  std::size_t cells = 0;
  EncodedArrays arrays;  // points, connectivity, offsets, types, and then those of the cells
  bool whole_pages = false;
};
EncodedGrid encoded(const Grid& grid, const std::vector<Array>& cells);

// Throws RunError, and leaves no file. `scratch` keeps its memory from frame to frame.
void write_vtu(const std::filesystem::path& file, const EncodedGrid& grid, const Frame& frame, EncodedArrays& scratch);

}  // namespace scree::output
