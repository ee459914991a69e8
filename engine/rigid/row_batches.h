// The order in which the solver goes through contacts, such that several threads may go through them at once and any number of
// them does the same.
//
// Bodies are cut into slabs along the axis of their greatest spread, as many to each. The contacts of a slab's bodies among
// themselves and with the next slab's are a batch: batches of even number share no body, nor do those of odd number, so all
// of the even ones are done at once, then all of the odd ones. Contacts across more than two slabs come last, one by one. The
// number of slabs is a matter of the bodies, never of the threads.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "engine/base/phases.h"

namespace scree::rigid {

// The slab of each body; `slabs` of them.
std::vector<int> slabs_of(const std::vector<Eigen::Vector3d>& centres, int slabs);

// Of a contact between bodies of two slabs; -1 for a slab: a fixed body.
int batch_of(int first_slab, int second_slab, int slabs);

// Things in the order of their batches: number b from ends[b] to ends[b + 1]; the last holds those across several slabs.
struct Batches {
  std::vector<std::size_t> ends;
  [[nodiscard]] int count() const { return static_cast<int>(ends.size()) - 1; }
};

// Calls pass(begin, end) for all batches, `passes` times over.
template <class Pass>
void for_batches(const Batches& batches, int passes, const Pass& pass) {
  const int across = batches.count() - 1;
  const std::array<int, 3> sizes{(across + 1) / 2, across / 2, batches.ends[across] < batches.ends[across + 1] ? 1 : 0};
  run_phases(sizes, passes, [&](int phase, int number) {
    const int batch = phase == 2 ? across : 2 * number + phase;
    pass(batches.ends[batch], batches.ends[batch + 1]);
  });
}

}  // namespace scree::rigid
