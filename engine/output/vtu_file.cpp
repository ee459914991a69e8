#include "engine/output/vtu_file.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <lz4.h>
#include <Eigen/Geometry>

#include "engine/base/atomic_file.h"
#include "engine/base/check.h"

namespace scree::output {

namespace {

constexpr std::size_t bytes_in_block = 1 << 16;
constexpr std::size_t worth_pages = 1 << 16;  // of bytes that frames share: the ends of pages add at most 12 kB
constexpr std::size_t arrays_of_grid = 4;

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

// The values of one array, compressed where they will stand.
void append_values(const void* values, std::size_t size, PageBuffer& bytes) {
  const std::size_t blocks = (size + bytes_in_block - 1) / bytes_in_block;
  std::vector<std::uint64_t> head{blocks, bytes_in_block, size % bytes_in_block};
  const std::size_t start = bytes.size();
  const std::size_t head_size = (head.size() + blocks) * sizeof head[0];
  bytes.room(head_size);
  bytes.grow(head_size);
  for (std::size_t at = 0; at < size; at += bytes_in_block) {
    const auto count = static_cast<int>(std::min(bytes_in_block, size - at));
    constexpr int most = LZ4_COMPRESSBOUND(bytes_in_block);
    const int taken = LZ4_compress_default(static_cast<const char*>(values) + at, bytes.room(most), count, most);
    SCREE_ENSURE(taken > 0);
    bytes.grow(static_cast<std::size_t>(taken));
    head.push_back(static_cast<std::uint64_t>(taken));
  }
  std::memcpy(bytes.data() + start, head.data(), head_size);
}

template <class T>
constexpr const char* type_name = "UInt8";
template <>
constexpr const char* type_name<double> = "Float64";
template <>
constexpr const char* type_name<float> = "Float32";
template <>
constexpr const char* type_name<std::int32_t> = "Int32";

template <class T>
void append_array(const std::string& name, int components, const T* values, std::size_t count, EncodedArrays& encoded) {
  encoded.entries.push_back({type_name<T>, name, components, encoded.bytes.size()});
  append_values(values, count * sizeof(T), encoded.bytes);
}

void append_arrays(const std::vector<Array>& arrays, EncodedArrays& encoded) {
  for (const Array& array : arrays) {
    std::visit([&](const auto& values) { append_array(array.name, array.components, values.data(), values.size(), encoded); },
               array.values);
  }
}

// Far from the origin, as in coordinates of a country's survey, single precision has too few digits for what is there.
bool single_precision_is_enough(const Grid& grid) {
  if (!grid.to_look_at) return false;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : grid.points) box.extend(point);
  if (box.isEmpty()) return false;
  const double furthest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  return furthest * 0.5 * std::numeric_limits<float>::epsilon() <= 1e-6 * box.diagonal().norm();
}

void append_points(const Grid& grid, EncodedArrays& encoded) {
  const std::size_t count = 3 * grid.points.size();
  const double* coordinates = grid.points.empty() ? nullptr : grid.points.front().data();
  if (single_precision_is_enough(grid)) {
    append_array("Points", 3, std::vector<float>(coordinates, coordinates + count).data(), count, encoded);
  } else {
    append_array("Points", 3, coordinates, count, encoded);
  }
}

using Entries = std::span<const EncodedArrays::Entry>;

// What the XML says of arrays whose bytes begin at `start` of the appended section.
std::string elements(Entries entries, std::uint64_t start) {
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
constexpr std::string_view before_bytes = "<AppendedData>_";
constexpr std::string_view after_bytes = "\n</AppendedData>\n</VTKFile>\n";

// All before the appended section, where the bytes of the frame's own arrays stand behind those of the grid.
std::string xml(const EncodedGrid& grid, const Frame& frame, Entries own) {
  const Entries shared(grid.arrays.entries);
  const std::uint64_t start = grid.arrays.bytes.size();
  std::string text(opening);
  // ParaView shows this as the time of a .vtu opened on its own.
  text += fmt::format(
      R"(<FieldData><DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">{}</DataArray>)", frame.time);
  text += "</FieldData>\n";
  text += fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", grid.points, grid.cells);
  text += fmt::format("<PointData>\n{}</PointData>\n", elements(own.first(frame.points.size()), start));
  text += fmt::format("<CellData>\n{}", elements(own.subspan(frame.points.size()), start));
  text += fmt::format("{}</CellData>\n", elements(shared.subspan(arrays_of_grid), 0));
  text += fmt::format("<Points>\n{}</Points>\n", elements(shared.first(1), 0));
  text += fmt::format("<Cells>\n{}</Cells>\n", elements(shared.subspan(1, arrays_of_grid - 1), 0));
  return text + "</Piece>\n</UnstructuredGrid>\n";
}

// Room for all of it at once: memory that is not touched costs nothing, and growing would hold much of it twice.
void make_room(const Grid& grid, const std::vector<Array>& cells, PageBuffer& bytes) {
  std::size_t size = grid.points.size() * sizeof(Eigen::Vector3d) + grid.connectivity.size() * sizeof(std::int32_t) +
                     grid.types.size() * (sizeof(std::int32_t) + sizeof(std::uint8_t));
  for (const Array& array : cells) {
    std::visit([&](const auto& values) { size += values.size() * sizeof values[0]; }, array.values);
  }
  bytes.room(size + size / 128 + 2 * bytes_in_block);  // what LZ4 makes of numbers that it cannot compress
}

}  // namespace

EncodedGrid encoded(const Grid& grid, const std::vector<Array>& cells) {
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
  make_room(grid, cells, made.arrays.bytes);
  append_points(grid, made.arrays);
  append_array("connectivity", 1, grid.connectivity.data(), grid.connectivity.size(), made.arrays);
  append_array("offsets", 1, ends.data(), ends.size(), made.arrays);
  append_array("types", 1, types.data(), types.size(), made.arrays);
  append_arrays(cells, made.arrays);
  made.whole_pages = made.arrays.bytes.size() >= worth_pages;
  if (made.whole_pages) made.arrays.bytes.fill_page(0, '\0');
  return made;
}

void write_vtu(const std::filesystem::path& file, const EncodedGrid& grid, const Frame& frame, EncodedArrays& scratch) {
  scratch.entries.clear();
  scratch.bytes.clear();
  append_arrays(frame.points, scratch);
  append_arrays(frame.cells, scratch);
  PageBuffer head;
  head.append(xml(grid, frame, scratch.entries));
  if (grid.whole_pages) {  // so that all parts begin and end with a page
    head.fill_page(before_bytes.size(), ' ');
    scratch.bytes.fill_page(after_bytes.size(), '\0');
  }
  head.append(before_bytes);
  scratch.bytes.append(after_bytes);
  write_atomically(file, std::array{head.view(), grid.arrays.bytes.view(), scratch.bytes.view()},
                   grid.whole_pages ? Way::direct : Way::cached);
}

}  // namespace scree::output
