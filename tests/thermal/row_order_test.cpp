// Rows in the order of space, and products that share what they read.
#include <algorithm>
#include <set>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "engine/base/threads.h"
#include "tests/thermal/builders.h"
#include "thermal/block_conduction.h"
#include "thermal/flow_network.h"
#include "thermal/row_order.h"
#include "thermal/row_runs.h"

namespace scree::thermal {
namespace {

// Two by two by two slabs of as many cells along each edge, the last one first.
mesh::BlockMesh<3> eight_slabs(int cells) {
  std::vector<test::Slab<3>> slabs;
  for (int i = 7; i >= 0; --i) {
    test::Slab<3> slab;
    slab.low = {i % 2 * 1.0, i / 2 % 2 * 1.0, i / 4 * 1.0};
    slab.cells = {cells, cells, cells};
    slabs.push_back(slab);
  }
  return test::slab_mesh<3>(slabs);
}

double some_field(const Point<3>& at) {
  return 300 + 7 * at.x() * at.y() + 11 * at.z() * at.z() - at.x();
}

// Summed element by element, for each node of the mesh.
Eigen::VectorXd heat_leaving(const mesh::BlockMesh<3>& mesh, double conductivity) {
  Eigen::VectorXd heat = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(mesh.nodes.size()));
  for (const auto& nodes : mesh.elements) {
    const auto matrix = element_conductance<3>(corner_points<3>(mesh, nodes), conductivity * Tensor<3>::Identity());
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b) heat[nodes[a].value()] += matrix(a, b) * some_field(mesh.nodes[nodes[b]]);
    }
  }
  return heat;
}

TEST(RowOrder, AModelWhoseRowsAreInTheOrderOfSpaceConductsAndStoresAsItsElementsDo) {
  const mesh::BlockMesh<3> mesh = eight_slabs(18);
  ASSERT_TRUE(is_worth_ordering(mesh));
  const HeatModel model = make_heat_model<3>(mesh, test::rock_only(), {}, test::options_for(mesh, 300));
  ASSERT_FALSE(model.rows.is_identity());
  ASSERT_EQ(static_cast<std::size_t>(model.capacity.size()), mesh.nodes.size());
  Eigen::VectorXd temperature(model.capacity.size());
  for (Eigen::Index row = 0; row < temperature.size(); ++row) temperature[row] = some_field(model.places.col(row));
  const Eigen::VectorXd heat = model.rows.to_nodes(FlowNetwork(&model.conductance, Sums::plain).leaving(temperature));
  const Eigen::VectorXd expected = heat_leaving(mesh, *test::rock().conductivity->value.constant());
  EXPECT_LT((heat - expected).lpNorm<Eigen::Infinity>(), 1e-12 * expected.lpNorm<Eigen::Infinity>());
  const double solid = 8.0 * 2500 * 800;  // cubic metres of rock
  EXPECT_NEAR(model.capacity.sum(), solid, 1e-9 * solid);
  for (const NodeId node : mesh.nodes.ids()) {
    EXPECT_EQ(model.places.col(model.rows[node].value()), mesh.nodes[node]);
    EXPECT_EQ(model.blocks[model.rows[node]], BlockId(node.index() / (19U * 19 * 19)));
  }
}

TEST(RowOrder, SmallMeshesOfLargeBlocksKeepTheirOrder) {
  const mesh::BlockMesh<3> mesh = eight_slabs(3);
  EXPECT_FALSE(is_worth_ordering(mesh));
  EXPECT_TRUE(make_heat_model<3>(mesh, test::rock_only(), {}, test::options_for(mesh, 300)).rows.is_identity());
}

// Nodes of a mesh, listed one by one.
struct Nodes {
  std::vector<NodeId> nodes;
  Table<NodeId, BlockId> blocks;
  std::vector<Eigen::Vector3d> places;

  void add(std::size_t block, const Eigen::Vector3d& at) {
    nodes.emplace_back(nodes.size());
    blocks.push_back(BlockId(block));
    places.push_back(at);
  }

  [[nodiscard]] std::vector<NodeId> in_order() const {
    return in_space_order(nodes, blocks, Eigen::Map<const Eigen::Matrix3Xd>(places[0].data(), 3, std::ssize(places)));
  }
};

TEST(RowOrder, GoesThroughSlabsAcrossTheLongestSideAndKeepsSmallBlocksTogether) {
  // A row of bars of two nodes each along y, listed backwards, then the nodes of a large block between them.
  constexpr int bars = 20'000;
  Nodes mesh;
  for (int i = 0; i < 2 * bars; ++i) mesh.add(i / 2, {0.3 * (i % 2), bars - 1.0 - i / 2, 0.1 * (i % 2)});
  for (int i = 0; i < bars; ++i) mesh.add(bars, {0.1, i + 0.05, 0.05});
  const std::vector<NodeId> order = mesh.in_order();
  ASSERT_EQ(order.size(), 3 * bars);
  long wrong = 0;
  for (std::size_t i = 0; i < order.size(); i += 3) {
    const std::size_t bar = bars - 1 - i / 3;
    wrong +=
        order[i] == NodeId(2 * bar) && order[i + 1] == NodeId(2 * bar + 1) && order[i + 2] == NodeId(2 * bars + i / 3) ? 0 : 1;
  }
  EXPECT_EQ(wrong, 0);
}

// Eight by eight by eight blocks of four nodes, listed in no order of note, with a plate of eight by eight nodes in their
// midst.
Nodes small_pile_on_a_plate() {
  Nodes mesh;
  for (int i = 0; i < 512; ++i) {
    if (i == 100) {
      for (int k = 0; k < 64; ++k) mesh.add(512, Eigen::Vector3d(k % 8, k / 8, 0));
    }
    const int place = i * 211 % 512;
    for (int k = 0; k < 4; ++k)
      mesh.add(i, Eigen::Vector3d(place % 8, place / 8 % 8, place / 64) + 0.1 * k * Eigen::Vector3d::Ones());
  }
  return mesh;
}

TEST(RowOrder, OfAPileThatStaysInTheCacheEveryQuarterIsAColumnOfItWithItsPartOfThePlateFirstAndThenTwoCubes) {
  const Nodes mesh = small_pile_on_a_plate();
  const std::vector<NodeId> order = mesh.in_order();
  ASSERT_EQ(order.size(), 4U * (16 + 2 * 64 * 4));
  std::set<int> columns, cubes;
  const auto corner = [](const Eigen::AlignedBox3d& box) {
    return static_cast<int>(box.min().dot(Eigen::Vector3d(1, 2, 4)) / 4);
  };
  auto next = order.begin();
  const auto of_four_nodes = [&](int blocks) {
    Eigen::AlignedBox3d box;
    for (int i = 0; i < blocks; ++i) {
      box.extend(mesh.places[next->index()]);
      const NodeId first = *next;
      for (int k = 0; k < 4; ++k) EXPECT_EQ((next++)->value(), first.value() + k);
    }
    return box;
  };
  for (int quarter = 0; quarter < 4; ++quarter) {
    EXPECT_TRUE(std::is_sorted(next, next + 16));
    Eigen::AlignedBox3d plate;
    for (int i = 0; i < 16; ++i, ++next) {
      EXPECT_EQ(mesh.blocks[*next], BlockId(512));
      plate.extend(mesh.places[next->index()]);
    }
    EXPECT_EQ(plate.sizes(), Eigen::Vector3d(3, 3, 0));
    columns.insert(corner(plate));
    for (int cube = 0; cube < 2; ++cube) {
      const Eigen::AlignedBox3d box = of_four_nodes(64);
      EXPECT_EQ(box.sizes(), Eigen::Vector3d(3, 3, 3));
      EXPECT_EQ(corner(box) % 4, corner(plate));
      cubes.insert(corner(box));
    }
  }
  EXPECT_EQ(columns.size(), 4U);
  EXPECT_EQ(cubes.size(), 8U);
}

// Rows of K like those of a solid: each has entries at the 27 nodes around its own.
SparseMatrix solid(int nodes) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto number = [&](int x, int y, int z) { return x + nodes * (y + nodes * z); };
  const auto each = [&](const auto& use) {
    for (int i = 0; i < nodes * nodes * nodes; ++i) use(i % nodes, i / nodes % nodes, i / (nodes * nodes));
  };
  each([&](int x, int y, int z) {
    for (int i = 0; i < 27; ++i) {
      const int a = x + i % 3 - 1, b = y + i / 3 % 3 - 1, c = z + i / 9 - 1;
      if (std::min({a, b, c}) < 0 || std::max({a, b, c}) >= nodes) continue;
      entries.emplace_back(number(x, y, z), number(a, b, c), 1 + std::sin(number(x, y, z) * 1.0 + number(a, b, c)));
    }
  });
  SparseMatrix matrix(nodes * nodes * nodes, nodes * nodes * nodes);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

TEST(RowRuns, ProductsInARowAreThoseOfOneThreadToTheBitForAnyNumberOfThreads) {
  const SparseMatrix matrix = solid(36);
  const RowRuns runs(matrix);
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;
  const auto seven_products = [&] {
    Columns from = Columns::Constant(matrix.rows(), 2, 1), to = Columns::Zero(matrix.rows(), 2);
    from.col(0).setLinSpaced(0, 1);
    for (int product = 0; product < 7; ++product) {
      runs.for_each_part<2>(from.data(), [&](int, int) {
        return [&](int row, const double* flow) {
          for (int c = 0; c < 2; ++c) to(row, c) = from(row, c) - 0.01 * flow[c] + 0.1 * to(row, c);
        };
      });
      from.swap(to);
    }
    return from;
  };
  const int before = threads_in_use();
  use_threads(1);
  const Columns expected = seven_products();
  for (const int threads : {2, 3, 7}) {
    use_threads(threads);
    EXPECT_EQ(seven_products(), expected) << threads << " threads";
  }
  use_threads(before);
}

}  // namespace
}  // namespace scree::thermal
