// A display nobody sees. Debian's VTK draws through X only, neither EGL nor OSMesa.
#pragma once

#include <optional>
#include <string>

#include <sys/types.h>

namespace scree::output {

// An X server of our own (Xvfb) on a free display, named by DISPLAY while it lives. It also ends if this process is killed.
// Throws RunError if Xvfb is not installed or does not start.
class OffscreenDisplay {
 public:
  OffscreenDisplay();
  OffscreenDisplay(const OffscreenDisplay&) = delete;
  OffscreenDisplay& operator=(const OffscreenDisplay&) = delete;
  ~OffscreenDisplay();

 private:
  pid_t server_ = -1;
  std::optional<std::string> display_before_;
};

}  // namespace scree::output
