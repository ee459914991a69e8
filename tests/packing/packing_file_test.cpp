#include <fstream>
#include <limits>
#include <sstream>

#include <gmock/gmock.h>
#include <hdf5.h>

#include "engine/base/check.h"
#include "engine/base/hdf5_handle.h"
#include "engine/packing/packing.h"
#include "tests/temp_folder.h"

namespace scree::packing {
namespace {

using testing::HasSubstr;

class PackingFile : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "packing.h5"; }

 private:
  test::TempFolder folder_;
};

// Numbers that a detour over text or float would spoil.
template <int dim>
Packing<dim> awkward_packing() {
  Packing<dim> packing;
  packing.key = "0123456789abcdef";
  packing.mesh.bodies.push_back({"plate", MaterialId{1}, true, {0, 0, 0}, "box: (1, 1, 0.1) m\n"});
  packing.mesh.bodies.push_back({"a stone, with more", MaterialId{}, false, {0.1, -1.0 / 3, 5e-324}});
  for (std::size_t block = 0; block < 2; ++block) {
    typename mesh::BlockMesh<dim>::Element element;
    for (std::size_t corner = 0; corner <= dim; ++corner) {
      const double value = 0.1 * static_cast<double>(corner + 1) / 3 + static_cast<double>(block);
      element[corner] = packing.mesh.nodes.push_back(Point<dim>::Constant(value));
    }
    packing.mesh.elements.push_back(element);
    const std::size_t nodes = dim + 1;
    packing.mesh.blocks.push_back({BodyId{block},
                                   {nodes * block, nodes * (block + 1)},
                                   {block, block + 1},
                                   {block, block + 1},
                                   Eigen::Quaterniond(0.4, -0.1, 0.2, 1.0 / 3 + static_cast<double>(block)).normalized()});
    mesh::Cell cell{dim == 2 ? mesh::CellKind::quadrilateral : mesh::CellKind::wedge, {}};
    for (std::size_t i = 0; i < mesh::corner_count(cell.kind); ++i) cell.nodes[i] = NodeId{block + i};
    packing.mesh.cells.push_back(cell);
    const SurfaceId surface = packing.mesh.surface_names.push_back({BodyId{block}, "x, low"});
    mesh::SurfaceFace<dim> face{{}, surface};
    std::copy_n(element.begin() + 1, dim, face.nodes.begin());
    packing.mesh.surfaces.push_back(face);
    packing.poses.push_back({{1.0 / 3, -0.0, 1e300}, Eigen::Quaterniond(0.1, 0.2, 0.3, 0.4).normalized()});
  }
  return packing;
}

template <int dim>
void expect_same_surfaces(const mesh::BlockMesh<dim>& a, const mesh::BlockMesh<dim>& b) {
  EXPECT_EQ(a.surfaces, b.surfaces);
  ASSERT_EQ(a.surface_names.size(), b.surface_names.size());
  for (const SurfaceId surface : a.surface_names.ids()) {
    EXPECT_EQ(a.surface_names[surface].body, b.surface_names[surface].body);
    EXPECT_EQ(a.surface_names[surface].name, b.surface_names[surface].name);
  }
}

template <int dim>
void expect_same(const Packing<dim>& a, const Packing<dim>& b) {
  EXPECT_EQ(a.key, b.key);
  EXPECT_EQ(a.mesh.nodes, b.mesh.nodes);
  EXPECT_EQ(a.mesh.elements, b.mesh.elements);
  ASSERT_EQ(a.mesh.blocks.size(), b.mesh.blocks.size());
  for (const BlockId block : a.mesh.blocks.ids()) {
    EXPECT_EQ(a.mesh.blocks[block].body, b.mesh.blocks[block].body);
    EXPECT_EQ(a.mesh.blocks[block].nodes, b.mesh.blocks[block].nodes);
    EXPECT_EQ(a.mesh.blocks[block].elements, b.mesh.blocks[block].elements);
    EXPECT_EQ(a.mesh.blocks[block].cells, b.mesh.blocks[block].cells);
    EXPECT_EQ(a.mesh.blocks[block].orientation.coeffs(), b.mesh.blocks[block].orientation.coeffs());
    EXPECT_EQ(a.poses[block].translation, b.poses[block].translation);
    EXPECT_EQ(a.poses[block].rotation.coeffs(), b.poses[block].rotation.coeffs());
  }
  ASSERT_EQ(a.mesh.cells.size(), b.mesh.cells.size());
  for (const CellId cell : a.mesh.cells.ids()) {
    EXPECT_EQ(a.mesh.cells[cell].kind, b.mesh.cells[cell].kind);
    EXPECT_EQ(a.mesh.cells[cell].nodes, b.mesh.cells[cell].nodes);
  }
  ASSERT_EQ(a.mesh.bodies.size(), b.mesh.bodies.size());
  for (const BodyId body : a.mesh.bodies.ids()) {
    EXPECT_EQ(a.mesh.bodies[body].name, b.mesh.bodies[body].name);
    EXPECT_EQ(a.mesh.bodies[body].material, b.mesh.bodies[body].material);
    EXPECT_EQ(a.mesh.bodies[body].fixed, b.mesh.bodies[body].fixed);
    EXPECT_EQ(a.mesh.bodies[body].velocity, b.mesh.bodies[body].velocity);
    EXPECT_EQ(a.mesh.bodies[body].made_from, b.mesh.bodies[body].made_from);
  }
  expect_same_surfaces(a.mesh, b.mesh);
}

Hdf5Handle writable(const std::filesystem::path& file) {
  return {H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, file.string()};
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

template <int dim>
std::string refusal(const std::filesystem::path& file) {
  try {
    read<dim>(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST_F(PackingFile, APackingComesBackToTheBit) {
  const auto in_space = awkward_packing<3>();
  write(in_space, file());
  expect_same(in_space, read<3>(file()));
  const auto in_plane = awkward_packing<2>();
  write(in_plane, file());
  expect_same(in_plane, read<2>(file()));
  EXPECT_FALSE(read<2>(file()).settled);
}

TEST_F(PackingFile, AFileOfAnotherVersionIsRefusedAndHasNoKey) {
  for (const std::int64_t number : {6, 8}) {
    write(awkward_packing<3>(), file());
    {
      const Hdf5Handle other = writable(file());
      const Hdf5Handle version(H5Aopen(other.id(), "version", H5P_DEFAULT), H5Aclose, "version");
      ASSERT_GE(H5Awrite(version.id(), H5T_NATIVE_INT64, &number), 0);
    }
    EXPECT_THAT(refusal<3>(file()), HasSubstr("(this program reads version 7). Settle the scene again")) << number;
    EXPECT_EQ(stored_key(file()), std::nullopt) << number;
  }
}

TEST_F(PackingFile, AReportComesBackToTheBit) {
  auto packing = awkward_packing<3>();
  const double tiny = std::numeric_limits<double>::min();
  packing.settled =
      SettleReport{true, "slow and balanced", 1.0 / 3, 0.1, 0.2, 0.3, 0.4, 0.5, tiny, 0.6, 0.07, 0.05, 0.46, {}, {BlockId{1}}};
  packing.settled->net_force = Table<BlockId, double>(std::vector<double>{0, 1.0 / 7});
  write(packing, file());
  const auto back = read<3>(file());
  ASSERT_TRUE(back.settled);
  const SettleReport &a = *packing.settled, &b = *back.settled;
  EXPECT_EQ(a.at_rest, b.at_rest);
  EXPECT_EQ(a.criterion, b.criterion);
  EXPECT_EQ(a.simulated_time, b.simulated_time);
  EXPECT_EQ(a.rms_speed, b.rms_speed);
  EXPECT_EQ(a.max_speed, b.max_speed);
  EXPECT_EQ(a.unbalanced_force, b.unbalanced_force);
  EXPECT_EQ(a.max_displacement, b.max_displacement);
  EXPECT_EQ(a.window, b.window);
  EXPECT_EQ(a.max_penetration, b.max_penetration);
  EXPECT_EQ(a.mean_penetration, b.mean_penetration);
  EXPECT_EQ(a.deepest_overlap, b.deepest_overlap);
  EXPECT_EQ(a.mean_edge, b.mean_edge);
  EXPECT_EQ(a.top, b.top);
  EXPECT_EQ(a.lost_blocks, b.lost_blocks);
  EXPECT_EQ(a.net_force, b.net_force);
}

TEST_F(PackingFile, EqualPackingsGiveEqualFiles) {
  write(awkward_packing<3>(), file());
  const std::string first = bytes_of(file());
  write(awkward_packing<3>(), file());
  EXPECT_EQ(bytes_of(file()), first);
}

TEST_F(PackingFile, TheKeyIsReadAlone) {
  EXPECT_EQ(stored_key(file()), std::nullopt);
  write(awkward_packing<3>(), file());
  EXPECT_EQ(stored_key(file()), "0123456789abcdef");
  std::ofstream(file()) << "not a packing";
  EXPECT_EQ(stored_key(file()), std::nullopt);
}

// Of which C++ would make errors of its own.
TEST_F(PackingFile, TextsThatAreNotThereAndListsLongerThanMemoryAreDamage) {
  const auto refusal_with_empty = [&](const char* list, hid_t type, hsize_t size) {
    write(awkward_packing<3>(), file());
    {
      const Hdf5Handle damaged = writable(file());
      EXPECT_GE(H5Ldelete(damaged.id(), list, H5P_DEFAULT), 0);
      const Hdf5Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, "space");
      const Hdf5Handle set(H5Dcreate2(damaged.id(), list, type, space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose,
                           list);
    }
    try {
      read<3>(file());
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const Hdf5Handle text(H5Tcopy(H5T_C_S1), H5Tclose, "text");
  ASSERT_GE(H5Tset_size(text.id(), H5T_VARIABLE), 0);
  EXPECT_THAT(refusal_with_empty("texts", text.id(), 3), HasSubstr("damaged (must be a whole packing)"));
  EXPECT_THAT(refusal_with_empty("nodes", H5T_NATIVE_DOUBLE, hsize_t{1} << 50), HasSubstr("damaged"));
}

TEST_F(PackingFile, AMissingFileIsNamed) {
  EXPECT_EQ(refusal<3>(file()), file().string() + ": packing (no such file). Check its path, or settle the scene again");
}

TEST_F(PackingFile, AnotherDimensionIsRefused) {
  write(awkward_packing<2>(), file());
  EXPECT_THAT(refusal<3>(file()), HasSubstr("packing is in 2-D (this scene is in 3-D)"));
}

TEST_F(PackingFile, ATruncatedFileIsRefusedWhereverItEnds) {
  write(awkward_packing<3>(), file());
  const std::string whole = bytes_of(file());
  for (std::size_t length = 0; length < whole.size(); length += 97) {
    std::ofstream(file(), std::ios::binary) << whole.substr(0, length);
    EXPECT_THAT(refusal<3>(file()), HasSubstr("packing is damaged (must be a whole packing)")) << length;
  }
}

TEST_F(PackingFile, AFlippedBitInANumberIsNoticed) {
  write(awkward_packing<3>(), file());
  std::string bytes = bytes_of(file());
  const double seen = 0.1 * 2 / 3;
  const std::size_t at = bytes.find(std::string(reinterpret_cast<const char*>(&seen), sizeof seen));
  ASSERT_NE(at, std::string::npos);
  bytes[at] = static_cast<char>(bytes[at] ^ 1);
  std::ofstream(file(), std::ios::binary) << bytes;
  EXPECT_THAT(refusal<3>(file()), HasSubstr("packing is damaged"));
}

// None of them ends the program, whatever it is of, and what is read all the same is what was written.
TEST_F(PackingFile, AFlippedBitAnywhereIsNoticedOrChangesNothing) {
  const auto whole = awkward_packing<3>();
  write(whole, file());
  const std::string bytes = bytes_of(file());
  std::size_t refused = 0;
  for (std::size_t at = 0; at < bytes.size(); at += 7) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << at % 8));
    std::ofstream(file(), std::ios::binary) << damaged;
    try {
      const auto found = read<3>(file());
      EXPECT_EQ(found.key, whole.key);
      EXPECT_EQ(found.mesh.nodes[NodeId{0}], whole.mesh.nodes[NodeId{0}]);
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 100U);
}

TEST_F(PackingFile, AFileThatCannotBeWrittenIsARunError) {
  EXPECT_THROW(write(awkward_packing<3>(), file() / "below"), RunError);
}

}  // namespace
}  // namespace scree::packing
