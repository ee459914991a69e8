#include "tools/run/interrupt.h"

#include <csignal>

namespace scree::run {

namespace {

volatile std::sig_atomic_t interrupted = 0;

// A second one ends the process, whichever of the two it is.
void remember(int) {
  interrupted = 1;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
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
