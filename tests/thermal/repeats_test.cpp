// Cells and rows that repeat are worked out together: with the results of each on its own.
#include <cmath>

#include <gtest/gtest.h>

#include "engine/base/threads.h"
#include "tests/thermal/builders.h"
#include "tests/thermal/grids.h"
#include "thermal/flow_network.h"
#include "thermal/repeated_cells.h"
#include "thermal/row_runs.h"

namespace scree::thermal {
namespace {

mesh::BlockMesh<3> grid(double mesh_size, std::size_t count = 1) {
  return test::boxes_of_hexahedra({0.7, 0.3, 0.2}, mesh_size, count);
}

HeatModel model_of(const mesh::BlockMesh<3>& mesh) {
  return make_heat_model(mesh, test::rock_only(), {}, test::options_for(mesh, 300));
}

Table<BlockId, Tensor<3>> unit_conductivity(const mesh::BlockMesh<3>& mesh) {
  return Table<BlockId, Tensor<3>>(mesh.blocks.size(), Tensor<3>::Identity());
}

// The flows of each row by itself.
template <int columns>
Eigen::MatrixXd one_by_one(const SparseMatrix& matrix, const Eigen::MatrixXd& x) {
  Eigen::MatrixXd flows = Eigen::MatrixXd::Zero(x.rows(), columns);
  for (Eigen::Index row = 0; row < x.rows(); ++row) {
    for (SparseMatrix::InnerIterator entry(matrix, row); entry; ++entry) {
      for (int c = 0; c < columns; ++c) flows(row, c) += entry.value() * (x(entry.row(), c) - x(row, c));
    }
  }
  return flows;
}

template <int columns>
void expect_same_flows(const SparseMatrix& matrix) {
  using Values = Eigen::Matrix<double, Eigen::Dynamic, columns, columns == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
  const Values x = Values::Random(matrix.rows(), columns);
  Eigen::MatrixXd flows(matrix.rows(), columns);
  RowRuns(matrix).for_each_flow<columns>(x.data(), [&](int row, const double* flow) {
    for (int c = 0; c < columns; ++c) flows(row, c) = flow[c];
  });
  EXPECT_TRUE((flows.array() == one_by_one<columns>(matrix, x).array()).all());
}

TEST(RowRuns, FlowsAreThoseOfEachRowByItselfToTheBitInAGrid) {
  const HeatModel model = model_of(grid(0.05));
  expect_same_flows<1>(model.conductance);
  expect_same_flows<2>(model.conductance);
}

// No two of its cells are the same.
void shake(mesh::BlockMesh<3>& mesh, IdRange<NodeId> nodes) {
  for (const NodeId id : nodes) {
    const auto i = static_cast<double>(id.index() - nodes.first());
    mesh.nodes[id] += 1e-3 * Point<3>(std::sin(i), std::sin(2 * i), std::sin(3 * i));
  }
}

TEST(RowRuns, FlowsAreThoseOfEachRowByItselfToTheBitWhereNoRowRepeats) {
  mesh::BlockMesh<3> mesh = grid(0.05);
  shake(mesh, mesh.blocks[BlockId{0}].nodes);
  const HeatModel model = model_of(mesh);
  EXPECT_EQ(RowRuns(model.conductance).count(), mesh.nodes.size());
  expect_same_flows<1>(model.conductance);
  expect_same_flows<2>(model.conductance);
}

TEST(RowRuns, ALineOfAGridIsThreeRuns) {
  const HeatModel model = model_of(grid(0.05));  // 15 x 7 x 5 nodes
  EXPECT_EQ(model.conductance.rows(), 15 * 7 * 5);
  EXPECT_EQ(RowRuns(model.conductance).count(), 3U * 7 * 5);
}

HeatModel loose_tetrahedra(int cells) {
  test::Slab<3> slab;
  slab.cells = {cells, cells, cells};
  slab.block_per_element = true;
  const mesh::BlockMesh<3> mesh = test::slab_mesh<3>({slab});
  return make_heat_model<3>(mesh, test::rock_only(), test::matching_contacts(mesh), test::options_for(mesh, 300));
}

TEST(RowRuns, FlowsAreThoseOfEachRowByItselfToTheBitInLooseTetrahedra) {
  const HeatModel model = loose_tetrahedra(5);
  EXPECT_EQ(RowRuns(model.conductance).bundles(), static_cast<std::size_t>(model.conductance.rows()) / 4);
  expect_same_flows<1>(model.conductance);
  expect_same_flows<2>(model.conductance);
}

TEST(RowRuns, FlowsAreThoseOfEachRowByItselfForAnyNumberOfThreads) {
  const HeatModel model = loose_tetrahedra(8);
  ASSERT_GT(model.conductance.rows(), rows_worth_sharing);
  const int before = threads_in_use();
  for (const int threads : {1, 2, 3, 7}) {
    use_threads(threads);
    expect_same_flows<2>(model.conductance);
  }
  use_threads(before);
}

TEST(RepeatedCells, CellsOfAGridHaveWhatEachHasByItself) {
  const mesh::BlockMesh<3> mesh = grid(0.05);
  const RepeatedCells<3> repeated(mesh, unit_conductivity(mesh));
  for (const CellId id : mesh.cells.ids()) {
    const auto* corners = repeated.find(id);
    ASSERT_NE(corners, nullptr);
    const mesh::Cell& cell = mesh.cells[id];
    for (int corner = 0; corner < 8; ++corner) {
      const CornerOfCell alone = corner_of_cell<3>(cell.kind, cell_points(mesh, cell), Tensor<3>::Identity(), corner);
      EXPECT_NEAR((*corners)[corner].volume, alone.volume, 1e-10 * alone.volume);
      for (int other = 0; other < 8; ++other) {
        EXPECT_NEAR((*corners)[corner].conductance[other], alone.conductance[other], 1e-10 * alone.conductance[corner]);
      }
    }
  }
}

TEST(RepeatedCells, ACellLikeNoOtherIsLeftAsItIs) {
  mesh::BlockMesh<3> mesh = grid(0.1);
  mesh.nodes[NodeId{0}].x() -= 1e-6;
  const RepeatedCells<3> repeated(mesh, unit_conductivity(mesh));
  EXPECT_EQ(repeated.find(CellId{0}), nullptr);
  EXPECT_NE(repeated.find(CellId{1}), nullptr);
}

TEST(RepeatedCells, CellsOfTwoUnevenBlocksThatAreTheSameAreFoundHoweverFarApart) {
  mesh::BlockMesh<3> mesh = grid(0.05, 2);
  for (const mesh::Block& block : mesh.blocks) shake(mesh, block.nodes);
  const RepeatedCells<3> repeated(mesh, unit_conductivity(mesh));
  const std::size_t half = mesh.cells.size() / 2;
  for (std::size_t i = 0; i < half; ++i) {
    ASSERT_NE(repeated.find(CellId{i}), nullptr);
    EXPECT_EQ(repeated.find(CellId{i}), repeated.find(CellId{half + i}));
    EXPECT_NE(repeated.find(CellId{i}), repeated.find(CellId{(i + 1) % half}));
  }
}

TEST(RepeatedCells, EqualCellsOfOtherConductivityDiffer) {
  const mesh::BlockMesh<3> mesh = test::boxes_of_hexahedra({0.1, 0.1, 0.1}, 0.05, 2);
  auto conductivity = unit_conductivity(mesh);
  conductivity[BlockId{1}] *= 3;
  const RepeatedCells<3> repeated(mesh, conductivity);
  const double first = (*repeated.find(CellId{0}))[0].conductance[0];
  const double second = (*repeated.find(CellId{8}))[0].conductance[0];
  EXPECT_NEAR(second, 3 * first, 1e-15);
}

}  // namespace
}  // namespace scree::thermal
