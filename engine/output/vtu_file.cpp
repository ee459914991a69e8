#include "engine/output/vtu_file.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <lz4.h>

#include "engine/base/atomic_file.h"
#include "engine/base/check.h"

namespace scree::output {

namespace {

constexpr std::size_t bytes_in_block = 1 << 16;

// As in vtkCellType.h.
struct VtkCell {
  std::uint8_t type;
  std::int32_t corners;
};

VtkCell vtk_cell(CellType type) {
  switch (type) {
    case CellType::vertex:
      return {1, 1};
    case CellType::line:
      return {3, 2};
    case CellType::triangle:
      return {5, 3};
    case CellType::quadrilateral:
      return {9, 4};
    case CellType::tetrahedron:
      return {10, 4};
    case CellType::wedge:
      return {13, 6};
    case CellType::hexahedron:
      return {12, 8};
  }
  std::abort();
}

void append_numbers(const std::vector<std::uint64_t>& numbers, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof numbers[0]);
}

// The values of one array, compressed.
void append_values(const void* values, std::size_t size, std::string& bytes) {
  const std::size_t blocks = (size + bytes_in_block - 1) / bytes_in_block;
  append_numbers({blocks, bytes_in_block, size % bytes_in_block}, bytes);
  std::size_t its_size = bytes.size();  // where the compressed size of the block stands
  append_numbers(std::vector<std::uint64_t>(blocks), bytes);
  std::array<char, LZ4_COMPRESSBOUND(bytes_in_block)> packed;
  for (std::size_t at = 0; at < size; at += bytes_in_block, its_size += sizeof(std::uint64_t)) {
    const auto count = static_cast<int>(std::min(bytes_in_block, size - at));
    const int taken = LZ4_compress_default(static_cast<const char*>(values) + at, packed.data(), count, packed.size());
    SCREE_ENSURE(taken > 0);
    const auto recorded = static_cast<std::uint64_t>(taken);
    std::memcpy(bytes.data() + its_size, &recorded, sizeof recorded);
    bytes.append(packed.data(), recorded);
  }
}

template <class T>
constexpr const char* type_name = "UInt8";
template <>
constexpr const char* type_name<double> = "Float64";
template <>
constexpr const char* type_name<std::int32_t> = "Int32";

template <class T>
void append_array(const std::string& name, int components, const T* values, std::size_t count, EncodedArrays& encoded) {
  encoded.entries.push_back({type_name<T>, name, components, encoded.bytes.size()});
  append_values(values, count * sizeof(T), encoded.bytes);
}

// What the XML says of arrays whose bytes begin at `start` of the appended section.
std::string elements(std::span<const EncodedArrays::Entry> entries, std::uint64_t start) {
  std::string text;
  for (const EncodedArrays::Entry& entry : entries) {
    text += fmt::format(R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="appended" offset="{}"/>)", entry.type,
                        entry.name, entry.components, start + entry.offset);
    text += '\n';
  }
  return text;
}

// The bytes are marked as raw by the document's default for that attribute, not at the element itself: ParaView 5.11 stops at
// an appended section with an attribute if its XML parser is one that puts off what it has not seen the end of (README.md).
constexpr std::string_view opening =
    "<?xml version=\"1.0\"?>\n"
    "<!DOCTYPE VTKFile [<!ATTLIST AppendedData encoding CDATA \"raw\">]>\n"
    "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
    "compressor=\"vtkLZ4DataCompressor\">\n<UnstructuredGrid>\n";
constexpr std::string_view before_bytes = "</Piece>\n</UnstructuredGrid>\n<AppendedData>_";
constexpr std::string_view after_bytes = "\n</AppendedData>\n</VTKFile>\n";

}  // namespace

void encode(const std::vector<Array>& arrays, EncodedArrays& encoded) {
  encoded.entries.clear();
  encoded.bytes.clear();
  for (const Array& array : arrays) {
    std::visit([&](const auto& values) { append_array(array.name, array.components, values.data(), values.size(), encoded); },
               array.values);
  }
}

EncodedGrid encoded(const Grid& grid) {
  std::vector<std::int32_t> ends;
  std::vector<std::uint8_t> types;
  std::int32_t end = 0;
  for (const CellType type : grid.types) {
    const VtkCell cell = vtk_cell(type);
    types.push_back(cell.type);
    ends.push_back(end += cell.corners);
  }
  SCREE_EXPECT(static_cast<std::size_t>(end) == grid.connectivity.size());
  EncodedGrid made{grid.points.size(), grid.types.size(), {}};
  const double* coordinates = grid.points.empty() ? nullptr : grid.points.front().data();
  append_array("Points", 3, coordinates, 3 * grid.points.size(), made.arrays);
  append_array("connectivity", 1, grid.connectivity.data(), grid.connectivity.size(), made.arrays);
  append_array("offsets", 1, ends.data(), ends.size(), made.arrays);
  append_array("types", 1, types.data(), types.size(), made.arrays);
  return made;
}

void write_vtu(const std::filesystem::path& file, const EncodedFrame& frame) {
  std::uint64_t start = 0;
  const auto next = [&](const EncodedArrays& arrays) { return std::exchange(start, start + arrays.bytes.size()); };
  const std::span grid_entries(frame.grid.arrays.entries);
  const std::uint64_t grid_start = next(frame.grid.arrays);
  std::string head(opening);
  // ParaView shows this as the time of a .vtu opened on its own.
  head += fmt::format(
      R"(<FieldData><DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">{}</DataArray>)", frame.time);
  head += "</FieldData>\n";
  head += fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", frame.grid.points, frame.grid.cells);
  head += fmt::format("<PointData>\n{}</PointData>\n", elements(frame.points.entries, next(frame.points)));
  head += fmt::format("<CellData>\n{}", elements(frame.cells.entries, next(frame.cells)));
  head += fmt::format("{}</CellData>\n", elements(frame.more_cells.entries, next(frame.more_cells)));
  head += fmt::format("<Points>\n{}</Points>\n", elements(grid_entries.first(1), grid_start));
  head += fmt::format("<Cells>\n{}</Cells>\n", elements(grid_entries.subspan(1), grid_start));
  head += before_bytes;
  write_text(file, std::array<std::string_view, 6>{head, frame.grid.arrays.bytes, frame.points.bytes, frame.cells.bytes,
                                                   frame.more_cells.bytes, after_bytes});
}

}  // namespace scree::output
