#include "engine/output/vtu_text.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
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

// RFC 4648. Boost's is private to one of its libraries or slow.
void append_base64(const unsigned char* bytes, std::size_t count, std::string& text) {
  static constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::size_t at = text.size();
  text.resize(at + (count + 2) / 3 * 4, '=');
  for (std::size_t i = 0; i < count; i += 3) {
    const std::size_t given = std::min<std::size_t>(3, count - i);
    unsigned group = 0;
    for (std::size_t byte = 0; byte < 3; ++byte) group = group << 8 | (byte < given ? bytes[i + byte] : 0U);
    for (std::size_t digit = 0; digit <= given; ++digit) text[at + digit] = digits[group >> (18 - 6 * digit) & 63U];
    at += 4;
  }
}

// The values of one array, compressed and encoded.
void append_values(const void* values, std::size_t bytes, std::string& text) {
  const std::size_t blocks = (bytes + bytes_in_block - 1) / bytes_in_block;
  std::vector<std::uint64_t> header{blocks, bytes_in_block, bytes % bytes_in_block};
  const std::size_t room = blocks * static_cast<std::size_t>(LZ4_compressBound(bytes_in_block));
  const auto compressed = std::make_unique_for_overwrite<char[]>(room);
  std::size_t end = 0;
  for (std::size_t block = 0; block < blocks; ++block) {
    const auto* from = static_cast<const unsigned char*>(values) + block * bytes_in_block;
    const std::size_t size = std::min(bytes_in_block, bytes - block * bytes_in_block);
    const int packed = LZ4_compress_default(reinterpret_cast<const char*>(from), compressed.get() + end, static_cast<int>(size),
                                            static_cast<int>(room - end));
    SCREE_ENSURE(packed > 0);
    header.push_back(static_cast<std::uint64_t>(packed));
    end += static_cast<std::size_t>(packed);
  }
  append_base64(reinterpret_cast<const unsigned char*>(header.data()), header.size() * sizeof header[0], text);
  append_base64(reinterpret_cast<const unsigned char*>(compressed.get()), end, text);
}

template <class T>
constexpr const char* type_name = "UInt8";
template <>
constexpr const char* type_name<double> = "Float64";
template <>
constexpr const char* type_name<std::int32_t> = "Int32";

template <class T>
void append_array(const std::string& name, int components, const T* values, std::size_t count, std::string& text) {
  text +=
      fmt::format(R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="binary">)", type_name<T>, name, components);
  append_values(values, count * sizeof(T), text);
  text += "</DataArray>\n";
}

}  // namespace

void encode(const std::vector<Array>& arrays, std::string& text) {
  text.clear();
  for (const Array& array : arrays) {
    std::visit([&](const auto& values) { append_array(array.name, array.components, values.data(), values.size(), text); },
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
  EncodedGrid made{grid.points.size(), grid.types.size(), "<Points>\n"};
  const double* coordinates = grid.points.empty() ? nullptr : grid.points.front().data();
  append_array("Points", 3, coordinates, 3 * grid.points.size(), made.text);
  made.text += "</Points>\n<Cells>\n";
  append_array("connectivity", 1, grid.connectivity.data(), grid.connectivity.size(), made.text);
  append_array("offsets", 1, ends.data(), ends.size(), made.text);
  append_array("types", 1, types.data(), types.size(), made.text);
  made.text += "</Cells>\n";
  return made;
}

void write_vtu(const std::filesystem::path& file, const EncodedGrid& grid, std::string_view point_arrays,
               std::string_view cell_arrays, std::string_view more_cell_arrays, double time) {
  std::string head =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
      "compressor=\"vtkLZ4DataCompressor\">\n<UnstructuredGrid>\n";
  // ParaView shows this as the time of a .vtu opened on its own.
  head += R"(<FieldData><DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="binary">)";
  append_values(&time, sizeof time, head);
  head += "</DataArray></FieldData>\n";
  head += fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<PointData>\n", grid.points, grid.cells);
  write_text(file,
             std::array<std::string_view, 8>{head, point_arrays, "</PointData>\n<CellData>\n", cell_arrays, more_cell_arrays,
                                             "</CellData>\n", grid.text, "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n"});
}

}  // namespace scree::output
