#include "tools/run/interrupt.h"

#include <csignal>
#include <ctime>

namespace scree::run {

namespace {

volatile std::sig_atomic_t interrupted = 0;
timespec first_time;  // of the first one, by the monotonic clock

// What asks a process to end may ask its group, too, at once, as `timeout` does: that is no second wish.
constexpr double at_once = 0.5;  // [s]

double passed_since_first() {
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec - first_time.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec - first_time.tv_nsec);
}

// A second one ends the process, whichever of the two it is.
void remember(int signal) {
  if (interrupted == 0) {
    clock_gettime(CLOCK_MONOTONIC, &first_time);
    interrupted = 1;
  } else if (passed_since_first() > at_once) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

}  // namespace

void catch_interrupts() {
  interrupted = 0;
  std::signal(SIGINT, remember);
  std::signal(SIGTERM, remember);
}

void check_interrupt() {
  if (interrupted != 0) throw Interrupted{};
}

}  // namespace scree::run
