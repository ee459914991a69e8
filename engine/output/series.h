// Time series that ParaView opens: one .pvd and a compressed .vtu per time in a folder beside it.
//
// A file appears under its name only when it is whole, and the .pvd names only files that are, so whatever ends a
// run, the series is readable up to the last finished time.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "engine/mesh/block_mesh.h"
#include "engine/output/series_index.h"

namespace scree::output {

enum class CellType : std::uint8_t { vertex, line, triangle, quadrilateral, tetrahedron, wedge, hexahedron };

// Points and cells. 2-D data has z = 0.
struct Grid {
  std::vector<Eigen::Vector3d> points;     // [m]
  std::vector<CellType> types;             // of each cell
  std::vector<std::int32_t> connectivity;  // corners of cell 0, of cell 1, ...
};

// Values at the points or cells of a grid; the name is what the user sees. Units go into the name's documentation, SI.
struct Array {
  std::string name;
  int components = 1;
  std::variant<std::vector<double>, std::vector<std::int32_t>> values;
};

struct Frame {
  double time = 0;  // [s]
  std::vector<Array> points;
  std::vector<Array> cells;
};

// Block by block: its cells, or its elements if it has none.
template <int dim>
Grid make_grid(const mesh::BlockMesh<dim>& mesh);

class Series {
 public:
  // A series `name`.pvd in `directory` with its data in `directory`/`name`/; the .pvd appears with the first frame. An older
  // series of that name is removed; with `keep_until` its frames up to and including that time stay (a resumed run), and its
  // damage, if it has any, is a RunError. Throws RunError if nothing can be written.
  Series(std::filesystem::path directory, std::string name, std::optional<double> keep_until = std::nullopt);

  // Appends a frame, later than the one before. Throws RunError (disk full) and leaves the series as it was before.
  // The same values give the same bytes.
  void write(const Grid& grid, const Frame& frame);

  [[nodiscard]] std::size_t frames() const { return entries_.size(); }

 private:
  std::filesystem::path directory_;
  std::filesystem::path index_;
  std::string name_;
  std::vector<SeriesEntry> entries_;
};

}  // namespace scree::output
