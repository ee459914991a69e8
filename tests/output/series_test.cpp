#include "engine/output/series.h"

#include <algorithm>
#include <cmath>
#include <regex>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "engine/base/check.h"
#include "engine/base/page_buffer.h"
#include "tests/file_limit.h"
#include "tests/output/support.h"

namespace scree::output {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

mesh::BlockMesh<3> random_tets(int count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  mesh::BlockMesh<3> mesh;
  mesh.bodies.push_back({"rock", MaterialId{0}, false, {}});
  for (int i = 0; i < count; ++i) {
    std::array<Point<3>, 4> corners;
    for (Point<3>& corner : corners) corner = {coordinate(random), coordinate(random), coordinate(random)};
    add_block<3>(mesh, BodyId{0}, corners);
  }
  return mesh;
}

// Values that show every lost bit: irrational, denormal, huge.
Frame frame_of(const mesh::BlockMesh<3>& mesh, double time) {
  Frame frame{time, {}, {}};
  std::vector<double> temperature;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) temperature.push_back(std::sqrt(2.0 + static_cast<double>(i)) + time);
  temperature[0] = 5e-324;
  temperature[1] = -1.7976931348623157e308;
  std::vector<double> flux;
  std::vector<std::int32_t> block;
  for (std::size_t i = 0; i < mesh.elements.size(); ++i) {
    block.push_back(static_cast<std::int32_t>(i));
    for (int c = 0; c < 3; ++c) flux.push_back(std::sin(3.0 * static_cast<double>(i) + c));
  }
  frame.points.push_back({"temperature", 1, temperature});
  frame.cells.push_back({"heat_flux", 3, flux});
  frame.cells.push_back({"block", 1, block});
  frame.cells.push_back({"heat_flow", 1, std::vector<float>(flux.begin(), flux.begin() + std::ssize(block))});
  return frame;
}

vtkSmartPointer<vtkUnstructuredGrid> read_back(const fs::path& file) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

double component(vtkDataArray& array, std::size_t value) {
  const auto index = static_cast<vtkIdType>(value);
  const int components = array.GetNumberOfComponents();
  return array.GetComponent(index / components, static_cast<int>(index % components));
}

std::string vtk_type(double) {
  return "double";
}
std::string vtk_type(float) {
  return "float";
}
std::string vtk_type(std::int32_t) {
  return "int";
}

void expect_equal(vtkDataArray* stored, const Array& written) {
  ASSERT_NE(stored, nullptr) << written.name;
  EXPECT_EQ(stored->GetDataTypeAsString(),
            std::visit([](const auto& values) { return vtk_type(values.front()); }, written.values));
  ASSERT_EQ(stored->GetNumberOfComponents(), written.components);
  std::visit(
      [&](const auto& values) {
        ASSERT_EQ(stored->GetNumberOfValues(), static_cast<vtkIdType>(values.size()));
        for (std::size_t i = 0; i < values.size(); ++i) {
          EXPECT_EQ(component(*stored, i), values[i]) << written.name << i;
        }
      },
      written.values);
}

// The (time, file) pairs of a .pvd, read by other means than the writer's.
std::vector<std::pair<double, std::string>> index_of(const fs::path& pvd) {
  const std::string text = content(pvd);
  const std::regex entry("timestep=\"([^\"]*)\" part=\"0\" file=\"([^\"]*)\"");
  std::vector<std::pair<double, std::string>> frames;
  for (std::sregex_iterator match(text.begin(), text.end(), entry), end; match != end; ++match) {
    frames.emplace_back(std::stod((*match)[1]), (*match)[2]);
  }
  return frames;
}

std::vector<double> times_of(const fs::path& pvd) {
  std::vector<double> times;
  for (const auto& frame : index_of(pvd)) times.push_back(frame.first);
  return times;
}

std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path().filename().string());
  std::sort(files.begin(), files.end());
  return files;
}

class SeriesTest : public ::testing::Test {
 protected:
  void write_frames(Series& series, std::initializer_list<double> times) {
    for (const double time : times) series.write(grid_, frame_of(mesh_, time));
  }

  TempFolder folder_;
  fs::path pvd_ = folder_.path() / "heat.pvd";
  fs::path data_ = folder_.path() / "heat";
  mesh::BlockMesh<3> mesh_ = random_tets(50);
  Grid grid_ = make_grid(mesh_);
};

TEST_F(SeriesTest, VtkReadsBackWhatWasWrittenToTheBit) {
  Series series(folder_.path(), "heat");
  write_frames(series, {1.0 / 3});
  const auto data = read_back(data_ / "heat_000000.vtu");
  ASSERT_EQ(data->GetNumberOfPoints(), 200);
  ASSERT_EQ(data->GetNumberOfCells(), 50);
  for (const NodeId node : mesh_.nodes.ids()) {
    EXPECT_EQ(Point<3>(data->GetPoint(node.value())), mesh_.nodes[node]);
  }
  for (const ElementId element : mesh_.elements.ids()) {
    ASSERT_EQ(data->GetCellType(element.value()), VTK_TETRA);
    for (int i = 0; i < 4; ++i) {
      EXPECT_EQ(data->GetCell(element.value())->GetPointId(i), mesh_.elements[element][i].value());
    }
  }
  const Frame written = frame_of(mesh_, 1.0 / 3);
  expect_equal(data->GetPointData()->GetArray("temperature"), written.points[0]);
  expect_equal(data->GetCellData()->GetArray("heat_flux"), written.cells[0]);
  expect_equal(data->GetCellData()->GetArray("block"), written.cells[1]);
  expect_equal(data->GetCellData()->GetArray("heat_flow"), written.cells[2]);
  EXPECT_EQ(data->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0), 1.0 / 3);
}

TEST_F(SeriesTest, PointsOfAGridToLookAtAreWithinAMillionthOfItsExtentWhereverItIs) {
  grid_.to_look_at = true;
  Series series(folder_.path(), "contacts");
  for (const double away : {0.0, 5e5}) {
    for (Eigen::Vector3d& point : grid_.points) point.x() += away;
    series.write(grid_, {away, {}, {}});
  }
  const double extent = std::sqrt(3.0) * 2;
  for (const char* file : {"contacts_000000.vtu", "contacts_000001.vtu"}) {
    const auto data = read_back(folder_.path() / "contacts" / file);
    const bool near = file[14] == '0';
    EXPECT_STREQ(data->GetPoints()->GetData()->GetDataTypeAsString(), near ? "float" : "double");
    for (const NodeId node : mesh_.nodes.ids()) {
      const Point<3> written = mesh_.nodes[node] + Point<3>(near ? 0 : 5e5, 0, 0);
      EXPECT_LT((Point<3>(data->GetPoint(node.value())) - written).norm(), 1e-6 * extent);
    }
  }
}

// From some size on, files are laid out in whole pages.
TEST_F(SeriesTest, VtkReadsBackLargeFramesOfASharedGridToTheBit) {
  const auto mesh = random_tets(3000);
  const Frame all = frame_of(mesh, 7);
  Series series(folder_.path(), "heat");
  series.share(make_grid(mesh), {all.cells[1]});
  series.write({6, {}, {}});
  series.write({7, all.points, {all.cells[0]}});
  for (const char* file : {"heat_000000.vtu", "heat_000001.vtu"}) {
    const auto data = read_back(data_ / file);
    ASSERT_EQ(data->GetNumberOfPoints(), 12000);
    ASSERT_EQ(data->GetNumberOfCells(), 3000);
    for (const NodeId node : mesh.nodes.ids()) ASSERT_EQ(Point<3>(data->GetPoint(node.value())), mesh.nodes[node]);
    for (const ElementId element : mesh.elements.ids()) {
      for (int i = 0; i < 4; ++i) {
        ASSERT_EQ(data->GetCell(element.value())->GetPointId(i), mesh.elements[element][i].value());
      }
    }
    expect_equal(data->GetCellData()->GetArray("block"), all.cells[1]);
    EXPECT_EQ(fs::file_size(data_ / file) % PageBuffer::page, 0u);
  }
  const auto last = read_back(data_ / "heat_000001.vtu");
  expect_equal(last->GetPointData()->GetArray("temperature"), all.points[0]);
  expect_equal(last->GetCellData()->GetArray("heat_flux"), all.cells[0]);
  EXPECT_EQ(last->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0), 7);
}

TEST_F(SeriesTest, CellsAreShownAndNotTheirSimplices) {
  mesh::BlockMesh<3> mesh = random_tets(3);
  // The last tetrahedron's block becomes a wedge of the nodes of the last two.
  mesh::Cell cell{mesh::CellKind::wedge, {}};
  for (std::size_t i = 0; i < 6; ++i) cell.nodes[i] = NodeId{11 - i};
  mesh.cells.push_back(cell);
  mesh.blocks[BlockId{2}].cells = {0, 1};
  const Grid grid = make_grid(mesh);
  EXPECT_THAT(grid.types, ElementsAre(CellType::tetrahedron, CellType::tetrahedron, CellType::wedge));
  Series series(folder_.path(), "heat");
  series.write(grid, {1, {}, {}});
  const auto data = read_back(data_ / "heat_000000.vtu");
  ASSERT_EQ(data->GetNumberOfCells(), 3);
  EXPECT_EQ(data->GetCellType(1), VTK_TETRA);
  ASSERT_EQ(data->GetCellType(2), VTK_WEDGE);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(data->GetCell(2)->GetPointId(i), 11 - i);
}

TEST_F(SeriesTest, AllArraysOfAFrameButItsTimeAreInTheAppendedSection) {
  const auto mesh = random_tets(50);
  Series series(folder_.path(), "heat");
  series.write(make_grid(mesh), frame_of(mesh, 1));
  const std::string text = content(folder_.path() / "heat" / "heat_000000.vtu");
  const auto count = [&](std::string_view part) {
    std::size_t found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
  };
  const Frame frame = frame_of(mesh, 1);
  EXPECT_EQ(count("<DataArray "), 5 + frame.points.size() + frame.cells.size());
  EXPECT_EQ(count("format=\"appended\""), count("<DataArray ") - 1);
}

// An element with an attribute there is what ParaView 5.11 stops at with today's parsers (README.md), so that the bytes are
// declared as raw before.
TEST_F(SeriesTest, TheAppendedSectionOpensWithoutAnAttributeAndIsRawByDeclaration) {
  const auto mesh = random_tets(50);
  Series series(folder_.path(), "heat");
  series.write(make_grid(mesh), frame_of(mesh, 1));
  const std::string text = content(folder_.path() / "heat" / "heat_000000.vtu");
  const auto declared = text.find("<!DOCTYPE VTKFile [<!ATTLIST AppendedData encoding CDATA \"raw\">]>\n<VTKFile ");
  const auto section = text.find("<AppendedData");
  ASSERT_NE(declared, std::string::npos);
  ASSERT_NE(section, std::string::npos);
  EXPECT_LT(declared, section);
  EXPECT_EQ(text.substr(section, 15), "<AppendedData>_");
}

TEST_F(SeriesTest, TheIndexNamesEveryFrameWithItsExactTime) {
  Series series(folder_.path(), "heat");
  write_frames(series, {0, 0.1, 1.0 / 3});
  EXPECT_THAT(times_of(pvd_), ElementsAre(0, 0.1, 1.0 / 3));
  for (const auto& [time, file] : index_of(pvd_)) EXPECT_TRUE(fs::exists(folder_.path() / file));
  EXPECT_EQ(series.frames(), 3u);
}

TEST_F(SeriesTest, TheSameValuesGiveTheSameBytes) {
  const TempFolder other;
  Series first(folder_.path(), "heat");
  Series second(other.path(), "heat");
  write_frames(first, {0, 1});
  write_frames(second, {0, 1});
  EXPECT_EQ(content(data_ / "heat_000001.vtu"), content(other.path() / "heat/heat_000001.vtu"));
  EXPECT_EQ(content(pvd_), content(other.path() / "heat.pvd"));
}

TEST_F(SeriesTest, TrianglesLinesAndVerticesKeepTheirType) {
  mesh::BlockMesh<2> triangle;
  triangle.bodies.push_back({"bar", MaterialId{0}, false, {}});
  add_block<2>(triangle, BodyId{0}, {Point<2>(0, 0), Point<2>(1, 0), Point<2>(0, 1)});
  Series series(folder_.path(), "shapes");
  series.write(make_grid(triangle), {0, {}, {}});
  series.write({grid_.points, {CellType::line, CellType::line}, {0, 1, 5, 7}}, {1, {}, {}});
  series.write({grid_.points, {CellType::vertex}, {3}}, {2, {}, {}});
  series.write({{}, {}, {}}, {3, {}, {}});
  const fs::path data = folder_.path() / "shapes";
  EXPECT_EQ(read_back(data / "shapes_000000.vtu")->GetCellType(0), VTK_TRIANGLE);
  EXPECT_EQ(read_back(data / "shapes_000001.vtu")->GetCellType(1), VTK_LINE);
  EXPECT_EQ(read_back(data / "shapes_000002.vtu")->GetCellType(0), VTK_VERTEX);
  EXPECT_EQ(read_back(data / "shapes_000003.vtu")->GetNumberOfCells(), 0);
}

TEST_F(SeriesTest, ANewSeriesRemovesTheOldOneAndNothingElse) {
  {
    Series old(folder_.path(), "heat");
    write_frames(old, {0, 1, 2});
  }
  std::ofstream(data_ / "notes.txt") << "mine";
  Series series(folder_.path(), "heat");
  EXPECT_FALSE(fs::exists(pvd_));
  EXPECT_THAT(files_in(data_), ElementsAre("notes.txt"));
}

TEST_F(SeriesTest, AResumedRunKeepsTheFramesUpToItsTimeAndGoesOnLikeAnUninterruptedOne) {
  {
    Series interrupted(folder_.path(), "heat");
    write_frames(interrupted, {0, 0.1, 0.2, 0.3});
  }
  {
    Series resumed(folder_.path(), "heat", 0.1);
    EXPECT_EQ(resumed.frames(), 2u);
    EXPECT_THAT(times_of(pvd_), ElementsAre(0, 0.1));
    EXPECT_THAT(files_in(data_), ElementsAre("heat_000000.vtu", "heat_000001.vtu"));
    write_frames(resumed, {0.2, 0.3});
  }
  const TempFolder other;
  Series whole(other.path(), "heat");
  write_frames(whole, {0, 0.1, 0.2, 0.3});
  EXPECT_EQ(content(pvd_), content(other.path() / "heat.pvd"));
  EXPECT_EQ(content(data_ / "heat_000003.vtu"), content(other.path() / "heat/heat_000003.vtu"));
}

TEST_F(SeriesTest, WhatAKilledRunLeftHalfWrittenIsSweptAway) {
  {
    Series killed(folder_.path(), "heat");
    write_frames(killed, {0, 1});
  }
  std::ofstream(data_ / ".part-heat_000002.vtu") << "<VTKFile";     // killed while writing frame 2
  std::ofstream(data_ / "heat_000002.vtu") << "whole, not listed";  // killed before the index followed
  std::ofstream(folder_.path() / ".part-heat.pvd") << "<VTK";
  std::ofstream(folder_.path() / ".earlier-heat.pvd") << "<VTK";
  const Series resumed(folder_.path(), "heat", 1);
  EXPECT_THAT(files_in(data_), ElementsAre("heat_000000.vtu", "heat_000001.vtu"));
  EXPECT_THAT(files_in(folder_.path()), ElementsAre("heat", "heat.pvd"));
}

TEST_F(SeriesTest, ResumingADamagedSeriesSaysWhatIsMissing) {
  {
    Series series(folder_.path(), "heat");
    write_frames(series, {0, 1});
  }
  fs::remove(data_ / "heat_000000.vtu");
  try {
    const Series resumed(folder_.path(), "heat", 1);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("names a frame that is missing (heat/heat_000000.vtu)"));
  }
}

TEST_F(SeriesTest, ASeriesWithoutItsIndexOrItsLastFrameIsNotGoneOnWithAndStays) {
  {
    Series series(folder_.path(), "heat");
    write_frames(series, {0, 1});
  }
  EXPECT_THROW(Series(folder_.path(), "heat", 2), InputError);
  EXPECT_THAT(times_of(pvd_), ElementsAre(0, 1));
  fs::remove(pvd_);
  EXPECT_THROW(Series(folder_.path(), "heat", 1), InputError);
  EXPECT_THAT(files_in(data_), ElementsAre("heat_000000.vtu", "heat_000001.vtu"));
}

TEST_F(SeriesTest, AFullDiskIsAnErrorAndLeavesTheSeriesAsItWas) {
  for (const int blocks : {50, 3000}) {
    mesh_ = random_tets(blocks);
    grid_ = make_grid(mesh_);
    Series series(folder_.path(), "heat");
    write_frames(series, {0});
    const std::string before = content(pvd_);
    for (const std::size_t bytes : {std::size_t{100}, fs::file_size(data_ / "heat_000000.vtu") - 1}) {
      const test::FileLimit limit(bytes);
      EXPECT_THROW(write_frames(series, {1}), RunError);
    }
    EXPECT_EQ(content(pvd_), before);
    EXPECT_THAT(files_in(data_), ElementsAre("heat_000000.vtu"));
    write_frames(series, {1});
    EXPECT_THAT(times_of(pvd_), ElementsAre(0, 1));
  }
}

TEST_F(SeriesTest, AFolderThatCannotBeMadeIsAnErrorThatNamesTheSeries) {
  std::ofstream(folder_.path() / "file") << "x";
  EXPECT_THROW(Series(folder_.path() / "file", "heat"), RunError);
}

}  // namespace
}  // namespace scree::output
