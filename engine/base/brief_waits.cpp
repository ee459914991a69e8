#include "engine/base/brief_waits.h"

#include <pthread.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <system_error>
#include <thread>

#include "engine/base/threads.h"

namespace scree {

namespace {

[[noreturn]] void sleep_for_good() {
  for (;;) pause();
}

// Signals are for threads that do something: the new ones have the mask of the one that makes them.
class WithoutSignals {
 public:
  WithoutSignals() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~WithoutSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  WithoutSignals(const WithoutSignals&) = delete;
  WithoutSignals& operator=(const WithoutSignals&) = delete;

 private:
  sigset_t before_{};
};

// A team of two for a thread that is not of the others' team: one more than there were.
void add_a_sleeper() {
  const WithoutSignals blocked;
  try {
    std::thread([] {
#pragma omp parallel num_threads(2)
      sleep_for_good();
    }).detach();
  } catch (const std::system_error&) {
    // No more threads to be had: waits are longer, and nothing else.
  }
}

bool is_told_how_to_wait() {
  return std::getenv("GOMP_SPINCOUNT") != nullptr || std::getenv("OMP_WAIT_POLICY") != nullptr;
}

}  // namespace

void wait_briefly() {
  if (threads_in_use() == 1 || threads_in_use() != available_processors() || is_told_how_to_wait()) return;
  [[maybe_unused]] static const bool once = (add_a_sleeper(), true);
}

}  // namespace scree
