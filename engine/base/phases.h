// Work in phases: the tasks of a phase are independent of each other, and none begins before the last phase is over.
//
// Phases may be as short as some tens of microseconds, and there may be a thousand a second. Loops of OpenMP end when every
// thread has come to their end, which on a machine with other work takes until every thread has had its turn on a processor.
// Here the calling thread does what there is to do, and other threads help if they have a processor: one that has none holds up
// nobody, unless it was stopped within a task. Each begins with the same consecutive tasks of a phase every time, and goes on
// with those that others have not come to.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/base/chunks.h"

namespace scree {

// Phases and what to do in them.
struct PhasedWork {
  const int* sizes;  // number of tasks of each phase
  int phases;
  int rounds;  // all phases are done as many times over
  void (*task)(const void* body, int phase, int number);
  const void* body;
  bool shared = true;  // or all of it done by the calling thread
};

void run_phases(const PhasedWork& work);

// Calls body(phase, number) for sizes[phase] tasks of each phase, on all threads unless it is not to be shared, and that
// `rounds` times over. What it throws first is thrown on once no thread is at work any more; which tasks were done beside that
// one is not said.
template <class Body>
void run_phases(std::span<const int> sizes, int rounds, const Body& body, bool shared = true) {
  const auto task = [](const void* any, int phase, int number) { (*static_cast<const Body*>(any))(phase, number); };
  run_phases({sizes.data(), static_cast<int>(sizes.size()), rounds, task, &body, shared});
}

// for_chunks (chunks.h) for loops that are short.
template <class Body>
void for_short_chunks(std::size_t count, const Body& body) {
  run_phases(std::array<int, 1>{static_cast<int>(chunk_count(count))}, 1,
             [&](int, int task) { body(chunk_of(count, static_cast<std::size_t>(task))); });
}

// The same for every index.
template <class Index, class Body>
void for_each_shortly(Index count, const Body& body) {
  for_short_chunks(static_cast<std::size_t>(count), [&](Chunk chunk) {
    for (auto i = static_cast<Index>(chunk.begin); i < static_cast<Index>(chunk.end); ++i) body(i);
  });
}

// The largest of value(index), at least 0. Does not depend on the number of threads.
template <class Index, class Value>
double largest_of_each(Index count, const Value& value) {
  std::vector<double> largest(chunk_count(static_cast<std::size_t>(count)), 0.0);
  for_short_chunks(static_cast<std::size_t>(count), [&](Chunk chunk) {
    double& here = largest[chunk.number];
    for (auto i = static_cast<Index>(chunk.begin); i < static_cast<Index>(chunk.end); ++i) here = std::max(here, value(i));
  });
  return largest.empty() ? 0.0 : *std::max_element(largest.begin(), largest.end());
}

}  // namespace scree
