#include "engine/base/phases.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "engine/base/threads.h"

namespace scree {

namespace {

// The threads that help, and the tasks they may take. One work at a time.
//
// The tasks of a phase are dealt out evenly, each thread having consecutive ones, and who has done its own takes those of
// others. So a thread does the same tasks in every round, and what they read and write stays in its cache: between processors
// that share none, each line takes a fifth of a microsecond.
//
// A share holds the phase, counted on and on from one work to the next, and the number of the next task in it. Who raises it by
// one has the task. What else is read here belongs to the phase of the share and does not change before all its tasks are done,
// so a thread that comes late finds that its share is no longer valid and touches nothing.
class Crew {
 public:
  static constexpr int most_helpers = 1023;

  void run(const PhasedWork& work, int helpers) {
    while (helpers_ < helpers) std::thread([this, number = ++helpers_] { help(number); }).detach();
    threads_.store(helpers + 1, std::memory_order_relaxed);
    work_ = &work;
    std::uint64_t seen = phase_.load(std::memory_order_relaxed);
    begin_ = seen + 1;
    end_ = begin_ + static_cast<std::uint64_t>(work.rounds) * work.phases;
    go_on_from(seen);
    for (int idle = 0; seen != end_; ++idle) {
      if (take_part_in_new(0, seen)) idle = 0;
      wait_a_little(idle);
    }
    if (failed_.load(std::memory_order_relaxed)) {
      failed_.store(false, std::memory_order_relaxed);
      std::rethrow_exception(std::exchange(failure_, nullptr));
    }
  }

  std::mutex& busy() { return busy_; }

 private:
  static constexpr unsigned phase_shift = 24;
  static constexpr std::uint64_t number_mask = (1U << phase_shift) - 1;
  // Looks for a new phase before the processor is offered to others, and before a helper sleeps: some tenths of a millisecond,
  // as waking it up takes longer than what the caller does between two works of a loop.
  static constexpr int patience = 5000;
  static constexpr int much_patience = patience + 600;

  // In a line of the cache of its own. The end is that of the phase in `next`.
  struct alignas(64) Share {
    std::atomic<std::uint64_t> next{0};
    std::atomic<int> end{0};
  };

  void help(int number) {
    std::uint64_t seen = 0;
    for (int idle = 0;; ++idle) {
      if (take_part_in_new(number, seen)) idle = 0;
      if (idle > much_patience) phase_.wait(seen, std::memory_order_acquire);
      wait_a_little(idle);
    }
  }

  static void wait_a_little(int idle) {
    if (idle > patience) {
      std::this_thread::yield();
    } else {
#ifdef __x86_64__
      __builtin_ia32_pause();
#endif
    }
  }

  // Does what it finds to do if there is another phase than the one seen last and it is asked to help.
  bool take_part_in_new(int number, std::uint64_t& seen) {
    const std::uint64_t phase = phase_.load(std::memory_order_acquire);
    if (phase == seen) return false;
    seen = phase;
    const int threads = threads_.load(std::memory_order_relaxed);
    if (number >= threads) return false;
    take_part(number, threads);
    return true;
  }

  // In its own share first, and in the others. All that it takes is of one phase, which is not over before it says so.
  void take_part(int number, int threads) {
    std::uint64_t phase = 0;
    int done = 0;
    for (int i = 0; i < threads; ++i) {
      Share& share = shares_[static_cast<std::size_t>((number + i) % threads)];
      while (take_from(share, phase)) ++done;
    }
    if (done > 0 && left_.fetch_sub(done, std::memory_order_acq_rel) == done) go_on_from(phase);
  }

  // Does a task if there is one, and says of which phase.
  bool take_from(Share& share, std::uint64_t& phase) {
    std::uint64_t ticket = share.next.load(std::memory_order_acquire);
    while (static_cast<int>(ticket & number_mask) < share.end.load(std::memory_order_acquire)) {
      if (!share.next.compare_exchange_weak(ticket, ticket + 1, std::memory_order_acq_rel, std::memory_order_acquire)) continue;
      phase = ticket >> phase_shift;
      do_task(place_of(phase), static_cast<int>(ticket & number_mask));
      return true;
    }
    return false;
  }

  // After one that throws the others are not done, but counted, so that the work ends.
  void do_task(int phase, int number) {
    if (failed_.load(std::memory_order_relaxed)) return;
    try {
      work_->task(work_->body, phase, number);
    } catch (...) {
      if (!failed_.exchange(true, std::memory_order_relaxed)) failure_ = std::current_exception();
    }
  }

  // Among those of the work.
  int place_of(std::uint64_t phase) const {
    return static_cast<int>((phase - begin_) % work_->phases);
  }

  void go_on_from(std::uint64_t phase) {
    while (open(++phase)) {
    }
  }

  // The next phase that has tasks, or the end, at which the work may be gone as soon as the phase is there. Whether the phase
  // is over before it has been opened entirely.
  bool open(std::uint64_t& phase) {
    while (phase != end_ && work_->sizes[place_of(phase)] == 0) ++phase;
    const bool at_end = phase == end_;
    if (!at_end) deal_out(phase, work_->sizes[place_of(phase)]);
    phase_.store(phase, std::memory_order_release);
    phase_.notify_all();
    return !at_end && left_.fetch_sub(1, std::memory_order_acq_rel) == 1;
  }

  void deal_out(std::uint64_t phase, int tasks) {
    const int threads = threads_.load(std::memory_order_relaxed);
    left_.store(tasks + 1, std::memory_order_relaxed);  // and the opening
    std::int64_t first = 0;
    for (int i = 0; i < threads; ++i) {
      Share& share = shares_[static_cast<std::size_t>(i)];
      // Nobody may take the next number of the phase that is over for one of the new phase.
      share.next.fetch_or(number_mask, std::memory_order_acq_rel);
      const std::int64_t end = static_cast<std::int64_t>(tasks) * (i + 1) / threads;
      share.end.store(static_cast<int>(end), std::memory_order_release);
      share.next.store(phase << phase_shift | static_cast<std::uint64_t>(first), std::memory_order_release);
      first = end;
    }
  }

  std::mutex busy_;
  int helpers_ = 0;
  const PhasedWork* work_ = nullptr;
  std::uint64_t begin_ = 0;  // of its phases
  std::uint64_t end_ = 0;
  std::array<Share, most_helpers + 1> shares_;
  alignas(64) std::atomic<std::uint64_t> phase_{0};  // written last
  std::atomic<int> threads_{1};                      // that take part
  alignas(64) std::atomic<int> left_{0};             // tasks of the phase that are not known to be done
  alignas(64) std::atomic<bool> failed_{false};      // read before each task, written only when one has thrown
  std::exception_ptr failure_;
};

// Never destroyed: its threads live as long as the process.
Crew& crew() {
  static Crew& crew = *new Crew;
  return crew;
}

void run_alone(const PhasedWork& work) {
  for (int step = 0; step < work.rounds * work.phases; ++step) {
    const int phase = step % work.phases;
    for (int number = 0; number < work.sizes[phase]; ++number) work.task(work.body, phase, number);
  }
}

}  // namespace

void run_phases(const PhasedWork& work) {
  const bool worth_sharing = *std::max_element(work.sizes, work.sizes + work.phases) > 1;
  const int helpers = std::min(threads_in_use() - 1, Crew::most_helpers);
  if (!work.shared || !worth_sharing || helpers == 0) return run_alone(work);
  if (const std::unique_lock lock(crew().busy(), std::try_to_lock); lock.owns_lock()) {
    crew().run(work, helpers);
  } else {
    run_alone(work);
  }
}

}  // namespace scree
