// Runs the benchmarks in a heap like the command's.
#include <benchmark/benchmark.h>

#include "engine/base/heap_pages.h"

int main(int count, char** words) {
  scree::keep_heap_in_huge_pages();
  benchmark::Initialize(&count, words);
  if (benchmark::ReportUnrecognizedArguments(count, words)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
