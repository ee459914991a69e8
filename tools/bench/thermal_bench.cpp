// Times the inner pieces of the heat stage: assembly, products with K beside the bandwidth of the memory, the solver, writing.
#include <array>
#include <filesystem>
#include <optional>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include "engine/base/huge_pages.h"
#include "engine/base/threads.h"
#include "engine/mesh/make_blocks.h"
#include "engine/output/series.h"
#include "thermal/flow_network.h"
#include "thermal/free_nodes.h"
#include "thermal/heat_balance.h"
#include "thermal/heat_solver.h"

namespace scree::bench {
namespace {

enum class Grid { even, shaken };

// A cube of 1 m in hexahedra, `cells` along each edge; shaken, no two cells are the same.
mesh::BlockMesh<3> cube(std::int64_t cells, Grid grid) {
  mesh::BodySpec body;
  body.name = "cube";
  body.shape = mesh::Box{.size = Eigen::Vector3d::Ones()};
  body.mesh_size = 1 / static_cast<double>(cells);
  body.cells = mesh::CellKind::hexahedron;
  body.material = MaterialId{0};
  mesh::BlockMesh<3> mesh = mesh::make_blocks<3>({body});
  if (grid == Grid::even) return mesh;
  std::mt19937 generator(1);
  const auto random = [&] { return 0.1 * body.mesh_size * (2.0 * static_cast<double>(generator()) / 4294967296.0 - 1); };
  for (Point<3>& node : mesh.nodes) node += Point<3>(random(), random(), random());
  return mesh;
}

Table<MaterialId, Material> rock() {
  Material material;
  material.name = "rock";
  material.density = 2500;
  material.conductivity = 3.1;
  material.specific_heat = 880;
  return Table<MaterialId, Material>({material});
}

thermal::HeatModel model_of(const mesh::BlockMesh<3>& mesh) {
  thermal::HeatOptions options;
  options.initial_temperature = Table<BodyId, Function>(mesh.bodies.size(), Function(300));
  return thermal::make_heat_model<3>(mesh, rock(), {}, options);
}

void count_bytes(benchmark::State& state, double bytes) {
  state.counters["bytes_per_second"] = benchmark::Counter(bytes, benchmark::Counter::kIsIterationInvariantRate);
}

// What the memory can do: a = b + 3 c over arrays far larger than the caches.
void triad(benchmark::State& state) {
  use_threads(static_cast<int>(state.range(0)));
  constexpr std::int64_t size = 20'000'000;
  std::vector<double> a(size, 1.0), b(size, 2.0), c(size, 3.0);
  for (auto _ : state) {
#pragma omp parallel for schedule(static)
    for (std::int64_t i = 0; i < size; ++i) a[i] = b[i] + 3 * c[i];
    benchmark::DoNotOptimize(a.data());
  }
  count_bytes(state, 3.0 * size * sizeof(double));
}

// Two columns at once, as stabilised steps take them. Counted are the bytes that must be moved: K, and both vectors once.
void product(benchmark::State& state, Grid grid) {
  const thermal::HeatModel model = model_of(cube(state.range(0), grid));
  use_threads(static_cast<int>(state.range(1)));
  const thermal::FlowNetwork flows(&model.conductance, thermal::Sums::plain);
  const Eigen::Index size = model.capacity.size();
  std::array<Eigen::VectorXd, 2> x{Eigen::VectorXd(2 * size), Eigen::VectorXd(2 * size)};
  for (Eigen::VectorXd& vector : x) {
    prefer_huge_pages(vector.data(), 2 * static_cast<std::size_t>(size) * sizeof(double));
    vector.setRandom();
  }
  for (auto _ : state) {
    flows.for_each_flow<2>(x[0].data(), [to = x[1].data()](int row, const double* flow) {
      to[2 * static_cast<std::ptrdiff_t>(row)] = flow[0];
      to[2 * static_cast<std::ptrdiff_t>(row) + 1] = flow[1];
    });
    benchmark::DoNotOptimize(x[1].data());
  }
  const double entry = sizeof(double) + sizeof(int);
  const double matrix = grid == Grid::even ? 0 : static_cast<double>(model.conductance.nonZeros()) * entry;
  count_bytes(state, matrix + 2.0 * 2 * static_cast<double>(size) * sizeof(double));
}

void assembly(benchmark::State& state, Grid grid) {
  const mesh::BlockMesh<3> mesh = cube(state.range(0), grid);
  use_threads(static_cast<int>(state.range(1)));
  for (auto _ : state) benchmark::DoNotOptimize(model_of(mesh).conductance.nonZeros());
  state.counters["nodes"] = static_cast<double>(mesh.nodes.size());
}

// A shaken cube by either solver: what a new matrix takes, and then a right side.
struct Equations {
  Equations(std::int64_t cells, thermal::LinearSolver kind) : model(model_of(cube(cells, Grid::shaken))), free(model) {
    thermal::Drives drives(model);
    linear = thermal::HeatBalance(model).linearised(model.initial, drives.at(0));
    solver.emplace(model, free, kind, thermal::SolverUse{});
  }
  thermal::HeatModel model;
  thermal::FreeNodes free;
  thermal::Linearised linear;
  std::optional<thermal::HeatSolver> solver;
};

void new_matrix(benchmark::State& state, thermal::LinearSolver kind) {
  use_threads(static_cast<int>(state.range(1)));
  Equations equations(state.range(0), kind);
  double step = 100;
  for (auto _ : state) equations.solver->prepare(equations.linear, step *= 1.01);
}

void solve(benchmark::State& state, thermal::LinearSolver kind) {
  use_threads(static_cast<int>(state.range(1)));
  Equations equations(state.range(0), kind);
  equations.solver->prepare(equations.linear, 100);
  const Eigen::MatrixXd heat = Eigen::MatrixXd::Random(equations.free.size(), 1);
  for (auto _ : state) benchmark::DoNotOptimize(equations.solver->solve(heat).data());
}

void frame(benchmark::State& state) {
  const mesh::BlockMesh<3> mesh = cube(state.range(0), Grid::even);
  const auto folder = std::filesystem::temp_directory_path() / "scree_bench_series";
  output::Series series(folder, "heat");
  series.share(output::make_grid(mesh), {});
  std::vector<double> temperature(mesh.nodes.size(), 300);
  double time = 0;
  for (auto _ : state) {
    for (double& value : temperature) value += 0.123 * value / 7;
    series.write(output::Frame{time += 1, {{"temperature", 1, temperature}}, {}});
  }
  std::filesystem::remove_all(folder);
}

// Of so many cells along an edge.
template <int most_threads, int... cells>
void sizes(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"cells", "threads"})->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
  for (const int count : {cells...}) {
    for (int threads = 1; threads <= most_threads; ++threads) bench->Args({count, threads});
  }
}

BENCHMARK(triad)->Unit(benchmark::kMillisecond)->UseRealTime()->Arg(1)->Arg(2);
BENCHMARK_CAPTURE(product, unlike_cells, Grid::shaken)->Apply(sizes<2, 31, 74>);
BENCHMARK_CAPTURE(product, equal_cells, Grid::even)->Apply(sizes<2, 31, 74>);
BENCHMARK_CAPTURE(assembly, unlike_cells, Grid::shaken)->Apply(sizes<2, 31, 74>);
BENCHMARK_CAPTURE(assembly, equal_cells, Grid::even)->Apply(sizes<2, 31, 74>);
BENCHMARK_CAPTURE(new_matrix, cholesky, thermal::LinearSolver::cholesky)->Apply(sizes<2, 15, 31, 47, 63>);
BENCHMARK_CAPTURE(new_matrix, multigrid, thermal::LinearSolver::multigrid)->Apply(sizes<1, 15, 31, 47, 63>);
BENCHMARK_CAPTURE(solve, cholesky, thermal::LinearSolver::cholesky)->Apply(sizes<2, 15, 31, 47, 63>);
BENCHMARK_CAPTURE(solve, multigrid, thermal::LinearSolver::multigrid)->Apply(sizes<1, 15, 31, 47, 63>);
BENCHMARK(frame)->Unit(benchmark::kMillisecond)->Arg(31)->Arg(74);

}  // namespace
}  // namespace scree::bench
