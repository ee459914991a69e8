#include "tools/run/interrupt.h"

#include <csignal>

namespace scree::run {

namespace {

volatile std::sig_atomic_t interrupted = 0;

void remember(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
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
