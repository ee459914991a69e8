#include "engine/output/read_vtu.h"

#include <fstream>
#include <tuple>

#include <gmock/gmock.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "engine/base/check.h"
#include "engine/mesh/make_blocks.h"
#include "tests/output/support.h"

namespace scree::output {
namespace {

using testing::HasSubstr;

class ReadVtu : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "stone.vtu"; }

  // The eight corners of a unit cube and the cells given.
  void write(const std::vector<std::pair<int, std::vector<vtkIdType>>>& cells, bool ascii) const {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (int i = 0; i < 8; ++i) points->InsertNextPoint(i & 1, (i >> 1) & 1, i >> 2);
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(points);
    for (const auto& [type, nodes] : cells) grid->InsertNextCell(type, static_cast<vtkIdType>(nodes.size()), nodes.data());
    vtkNew<vtkXMLUnstructuredGridWriter> writer;
    writer->SetFileName(file().c_str());
    writer->SetInputData(grid);
    if (ascii) writer->SetDataModeToAscii();
    writer->Write();
  }

  [[nodiscard]] mesh::BlockMesh<3> blocks() const {
    mesh::BodySpec body;
    body.name = "stone";
    body.shape = mesh::MeshFile{file()};
    body.mesh_size = 0.5;
    return mesh::make_blocks<3>({body}, mesh_readers());
  }

  [[nodiscard]] std::string refusal() const {
    try {
      std::ignore = blocks();
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }

 private:
  TempFolder folder_;
};

// A cube in five tetrahedra.
const std::vector<std::pair<int, std::vector<vtkIdType>>> five{{VTK_TETRA, {0, 1, 2, 4}},
                                                               {VTK_TETRA, {1, 3, 2, 7}},
                                                               {VTK_TETRA, {1, 4, 5, 7}},
                                                               {VTK_TETRA, {2, 6, 4, 7}},
                                                               {VTK_TETRA, {1, 2, 4, 7}}};

TEST_F(ReadVtu, TetrahedraComeBackAsTheyWere) {
  for (const bool ascii : {true, false}) {
    write(five, ascii);
    const auto mesh = blocks();
    EXPECT_EQ(mesh.elements.size(), 5u);
    EXPECT_EQ(mesh.nodes.size(), 8u);
    double volume = 0;
    for (const ElementId e : mesh.elements.ids()) volume += mesh::element_volume(mesh, e);
    EXPECT_NEAR(volume, 1, 1e-15);
  }
}

TEST_F(ReadVtu, AClosedSurfaceIsMeshedInside) {
  write({{VTK_TRIANGLE, {0, 2, 3}},
         {VTK_TRIANGLE, {0, 3, 1}},
         {VTK_TRIANGLE, {4, 5, 7}},
         {VTK_TRIANGLE, {4, 7, 6}},
         {VTK_TRIANGLE, {0, 1, 5}},
         {VTK_TRIANGLE, {0, 5, 4}},
         {VTK_TRIANGLE, {2, 6, 7}},
         {VTK_TRIANGLE, {2, 7, 3}},
         {VTK_TRIANGLE, {0, 4, 6}},
         {VTK_TRIANGLE, {0, 6, 2}},
         {VTK_TRIANGLE, {1, 3, 7}},
         {VTK_TRIANGLE, {1, 7, 5}}},
        false);
  const auto mesh = blocks();
  double volume = 0;
  for (const ElementId e : mesh.elements.ids()) volume += mesh::element_volume(mesh, e);
  EXPECT_NEAR(volume, 1, 1e-13);
}

TEST_F(ReadVtu, OtherElementsAreNamed) {
  write({{VTK_VOXEL, {0, 1, 2, 3, 4, 5, 6, 7}}}, true);
  EXPECT_THAT(refusal(), HasSubstr("it holds 1 x Voxel"));
}

TEST_F(ReadVtu, WedgesOfEitherOrientationAndHexahedraAreRead) {
  write({{VTK_HEXAHEDRON, {0, 1, 3, 2, 4, 5, 7, 6}}}, true);
  EXPECT_EQ(blocks().cells.size(), 1u);
  write({{VTK_WEDGE, {0, 1, 2, 4, 5, 6}}, {VTK_WEDGE, {1, 2, 3, 5, 6, 7}}}, true);
  const auto mesh = blocks();
  EXPECT_EQ(mesh.cells.size(), 2u);
  double volume = 0;
  for (const ElementId e : mesh.elements.ids()) volume += mesh::element_volume(mesh, e);
  EXPECT_NEAR(volume, 1, 1e-13);
}

TEST_F(ReadVtu, ADamagedFileIsRefusedWithoutAWordFromVtk) {
  testing::internal::CaptureStderr();
  for (const bool ascii : {true, false}) {
    write(five, ascii);
    std::filesystem::resize_file(file(), std::filesystem::file_size(file()) / 2);
    EXPECT_THAT(refusal(), HasSubstr("(must be a whole .vtu mesh; it cannot be read: Error parsing XML"));
  }
  std::ofstream(file()) << "<VTKFile type=\"PolyData\"></VTKFile>";
  EXPECT_THAT(refusal(), HasSubstr("(must be a whole .vtu mesh; it cannot be read: "));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

// What VTK's writer would not write, and its reader takes at its word.
TEST_F(ReadVtu, CellsWithoutTheirNodesAreRefused) {
  testing::internal::CaptureStderr();
  const auto with_cell = [&](const char* type, const char* nodes, int count) {
    std::ofstream(file()) << R"(<VTKFile type="UnstructuredGrid" version="1.0"><UnstructuredGrid>
<Piece NumberOfPoints="4" NumberOfCells="1">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">)"
                          << nodes << R"(</DataArray><DataArray type="Int64" Name="offsets" format="ascii">)" << count
                          << R"(</DataArray><DataArray type="UInt8" Name="types" format="ascii">)" << type
                          << "</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>";
  };
  with_cell("10", "0 1 2 3", 4);
  EXPECT_EQ(refusal(), "");
  with_cell("10", "0 1 2", 3);
  EXPECT_THAT(refusal(), HasSubstr("element 0 has 3 nodes instead of 4"));
  with_cell("12", "0 1 2 3", 4);
  EXPECT_THAT(refusal(), HasSubstr("element 0 has 4 nodes instead of 8"));
  for (const char* nodes : {"0 1 2 4", "0 1 2 99999999", "0 1 2 -5"}) {
    with_cell("10", nodes, 4);
    EXPECT_THAT(refusal(), HasSubstr("element 0 uses a point that is not there")) << nodes;
  }
  for (const char* type : {"42", "99"}) {
    with_cell(type, "0 1 2 3", 4);
    EXPECT_THAT(refusal(), HasSubstr("which cannot be used")) << type;
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace scree::output
