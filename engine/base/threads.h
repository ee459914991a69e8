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

// How many threads loops over so many rows are worth: one if they are fewer than that. The few loops that are shared for other
// reasons than rows would not make up for threads that wait between them, which takes a processor as long as work does.
[[nodiscard]] int threads_for(std::size_t rows);

// So many threads while it lives.
class ThreadsInScope {
 public:
  explicit ThreadsInScope(int count) : before_(threads_in_use()) { use_threads(count); }
  ~ThreadsInScope() { use_threads(before_); }
  ThreadsInScope(const ThreadsInScope&) = delete;
  ThreadsInScope& operator=(const ThreadsInScope&) = delete;

 private:
  int before_;
};

}  // namespace scree
