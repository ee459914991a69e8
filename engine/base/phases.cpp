#include "engine/base/phases.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <thread>

#include "engine/base/threads.h"

namespace scree {

namespace {

// The threads that help, and the tasks they may take. One work at a time.
//
// `ticket_` holds the phase, counted on and on from one work to the next, and the number of the next task in it. Who raises it
// by one has the task. What else is read here belongs to the phase of the ticket and does not change before all its
// tasks are done, so a thread that comes late finds that its ticket is no longer valid and touches nothing.
class Crew {
 public:
  void run(const PhasedWork& work, int helpers) {
    while (helpers_ < helpers) std::thread([this, number = helpers_++] { help(number); }).detach();
    invited_.store(helpers, std::memory_order_relaxed);
    work_ = &work;
    step_ = 0;
    const std::uint64_t first = ticket_.load(std::memory_order_relaxed) >> phase_shift;
    end_ = first + 1 + static_cast<std::uint64_t>(work.rounds) * work.phases;
    open(first + 1);
    for (int idle = 0; ticket_.load(std::memory_order_acquire) >> phase_shift != end_;) {
      idle = take() ? 0 : idle + 1;
      if (idle > patience) std::this_thread::yield();
    }
  }

  std::mutex& busy() { return busy_; }

 private:
  static constexpr unsigned phase_shift = 24;
  static constexpr std::uint64_t number_mask = (1U << phase_shift) - 1;
  // Looks at a phase that has nothing left to hand out before the processor is offered to others, and before a helper sleeps:
  // some tenths of a millisecond, as waking it up takes longer than what the caller does between two works of a loop.
  static constexpr int patience = 2000;
  static constexpr int much_patience = patience + 600;

  void help(int number) {
    for (int idle = 0;;) {
      const std::uint64_t ticket = ticket_.load(std::memory_order_acquire);
      idle = number < invited_.load(std::memory_order_relaxed) && take() ? 0 : idle + 1;
      if (idle > much_patience) {
        ticket_.wait(ticket, std::memory_order_acquire);
      } else if (idle > patience) {
        std::this_thread::yield();
      }
    }
  }

  // Does a task if there is one.
  bool take() {
    std::uint64_t ticket = ticket_.load(std::memory_order_acquire);
    const auto number = static_cast<int>(ticket & number_mask);
    if (number >= size_.load(std::memory_order_acquire)) return false;
    if (!ticket_.compare_exchange_strong(ticket, ticket + 1, std::memory_order_acq_rel)) return true;
    work_->task(work_->body, step_ % work_->phases, number);
    if (left_.fetch_sub(1, std::memory_order_acq_rel) == 1) {
      ++step_;
      open((ticket >> phase_shift) + 1);
    }
    return true;
  }

  // The next phase that has tasks, or the end, at which the work may be gone as soon as the ticket is there.
  void open(std::uint64_t phase) {
    while (phase != end_ && work_->sizes[step_ % work_->phases] == 0) {
      ++phase;
      ++step_;
    }
    const int size = phase == end_ ? 0 : work_->sizes[step_ % work_->phases];
    // Nobody may take the next number of the phase that is over for one of the new phase.
    ticket_.fetch_or(number_mask, std::memory_order_acq_rel);
    left_.store(size, std::memory_order_relaxed);
    size_.store(size, std::memory_order_release);
    ticket_.store(phase << phase_shift, std::memory_order_release);
    ticket_.notify_all();
  }

  std::mutex busy_;
  int helpers_ = 0;
  std::atomic<int> invited_{0};
  const PhasedWork* work_ = nullptr;
  int step_ = 0;  // phases of the work that are over
  std::uint64_t end_ = 0;
  std::atomic<std::uint64_t> ticket_{0};
  std::atomic<int> size_{0};  // tasks of the phase
  std::atomic<int> left_{0};  // those not yet done
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
  const int helpers = threads_in_use() - 1;
  if (!work.shared || !worth_sharing || helpers == 0) return run_alone(work);
  if (const std::unique_lock lock(crew().busy(), std::try_to_lock); lock.owns_lock()) {
    crew().run(work, helpers);
  } else {
    run_alone(work);
  }
}

}  // namespace scree
