// Times the contact search: faces per second, and how many contacts a face has.
#include <benchmark/benchmark.h>

#include "contact/find_contacts.h"
#include "engine/base/threads.h"
#include "tools/bench/contact_cases.h"

namespace scree::bench {
namespace {

using Case = mesh::BlockMesh<3> (*)(std::size_t);

void search(benchmark::State& state, Case make, contact::Model model) {
  const mesh::BlockMesh<3> mesh = make(static_cast<std::size_t>(state.range(0)));
  use_threads(static_cast<int>(state.range(1)));
  contact::ContactOptions options;
  options.model = model;
  std::size_t contacts = 0;
  for (auto _ : state) contacts = contact::find_contacts<3>(mesh, options).contacts.size();
  const auto faces = static_cast<double>(mesh::boundary_faces(mesh).size());
  state.counters["faces"] = faces;
  state.counters["contacts_per_face"] = static_cast<double>(contacts) / faces;
  state.counters["faces_per_second"] = benchmark::Counter(faces, benchmark::Counter::kIsIterationInvariantRate);
}

void sizes_and_threads(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"faces", "threads"})->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
  for (const int faces : {10'000, 100'000, 1'000'000, 10'000'000}) {
    for (const int threads : {1, 2}) bench->Args({faces, threads});
  }
}

BENCHMARK_CAPTURE(search, settled, settled_piles, contact::Model::semi_spring)->Apply(sizes_and_threads);
BENCHMARK_CAPTURE(search, turned, turned_lattice, contact::Model::semi_spring)->Apply(sizes_and_threads);
BENCHMARK_CAPTURE(search, closed, closed_lattice, contact::Model::semi_spring)->Apply(sizes_and_threads);
BENCHMARK_CAPTURE(search, jointed_cubes, jointed_cubes, contact::Model::semi_spring)->Apply(sizes_and_threads);
BENCHMARK_CAPTURE(search, jointed_eights, jointed_eights, contact::Model::semi_spring)->Apply(sizes_and_threads);
BENCHMARK_CAPTURE(search, settled_cubes, settled_cubes, contact::Model::semi_spring)->Apply(sizes_and_threads);
BENCHMARK_CAPTURE(search, settled_overlap, settled_piles, contact::Model::overlap)->Apply(sizes_and_threads);
BENCHMARK_CAPTURE(search, closed_overlap, closed_lattice, contact::Model::overlap)->Apply(sizes_and_threads);
BENCHMARK_CAPTURE(search, jointed_cubes_overlap, jointed_cubes, contact::Model::overlap)->Apply(sizes_and_threads);
BENCHMARK_CAPTURE(search, jointed_eights_overlap, jointed_eights, contact::Model::overlap)->Apply(sizes_and_threads);

}  // namespace
}  // namespace scree::bench
