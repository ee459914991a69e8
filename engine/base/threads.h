// How many threads the parallel loops of this process use. Loops are OpenMP's, and written so that the number of threads does
// not change a bit of any result: every index writes its own slot, and what is summed over indices is summed in their order.
#pragma once

#include <cstddef>

namespace scree {

// The processors this process may run on.
[[nodiscard]] int available_processors();

// At least one. From here on, for loops that the calling thread starts.
void use_threads(int count);

[[nodiscard]] int threads_in_use();

// A loop over fewer rows than this is done before other threads have woken up.
inline constexpr long rows_worth_sharing = 4096;

// While it lives, one thread only if all the work is of fewer rows than that. The few loops that are shared for other reasons
// than rows would not make up for threads that wait between them, which takes a processor as long as work does.
class ThreadsForRows {
 public:
  explicit ThreadsForRows(std::size_t rows);
  ~ThreadsForRows();
  ThreadsForRows(const ThreadsForRows&) = delete;
  ThreadsForRows& operator=(const ThreadsForRows&) = delete;

 private:
  int before_;
};

}  // namespace scree
