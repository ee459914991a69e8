// Ctrl-C and SIGTERM end a run at the next safe point.
#pragma once

#include <exception>

namespace scree::run {

struct Interrupted : std::exception {
  [[nodiscard]] const char* what() const noexcept override { return "interrupted"; }
};

// From here on SIGINT and SIGTERM are remembered; a second one ends the process at once.
void catch_interrupts();

// Throws Interrupted if one of them came.
void check_interrupt();

}  // namespace scree::run
