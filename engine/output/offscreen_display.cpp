#include "engine/output/offscreen_display.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include "engine/base/check.h"

namespace scree::output {

namespace {

constexpr int not_installed = 127;

// Becomes the server, which writes the number of the display it found free to `report`.
[[noreturn]] void serve(int report, pid_t parent, const char* descriptor) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(1);  // it ended before the line above
  ::fcntl(report, F_SETFD, 0);
  const int nothing = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::dup2(nothing, STDOUT_FILENO);
  ::dup2(nothing, STDERR_FILENO);
  ::setpgid(0, 0);  // so that Ctrl-C reaches the program, which then ends the server
  ::execlp("Xvfb", "Xvfb", "-displayfd", descriptor, "-screen", "0", "1600x1200x24", "-nolisten", "tcp", nullptr);
  ::_exit(errno == ENOENT ? not_installed : 1);
}

std::string read_line(int descriptor) {
  std::string line;
  for (char c = 0;;) {
    const ssize_t count = ::read(descriptor, &c, 1);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0 || c == '\n') return line;
    line += c;
  }
}

}  // namespace

OffscreenDisplay::OffscreenDisplay() {
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) throw RunError(fmt::format("no pipe to Xvfb ({})", std::strerror(errno)));
  const std::string descriptor = std::to_string(pipe[1]);
  const pid_t parent = ::getpid();
  server_ = ::fork();
  if (server_ == 0) serve(pipe[1], parent, descriptor.c_str());
  ::close(pipe[1]);
  const std::string number = server_ < 0 ? "" : read_line(pipe[0]);
  ::close(pipe[0]);
  if (number.empty()) {
    int status = 0;
    if (server_ > 0) TEMP_FAILURE_RETRY(::waitpid(server_, &status, 0));
    const bool missing = WIFEXITED(status) && WEXITSTATUS(status) == not_installed;
    throw RunError(missing ? "pictures need Xvfb, which is not installed. Run tools/setup, or apt-get install xvfb"
                           : "pictures need Xvfb, which did not start. Try `Xvfb -displayfd 1` to see why");
  }
  if (const char* before = std::getenv("DISPLAY")) display_before_ = before;
  ::setenv("DISPLAY", fmt::format(":{}", number).c_str(), 1);
}

OffscreenDisplay::~OffscreenDisplay() {
  if (display_before_) {
    ::setenv("DISPLAY", display_before_->c_str(), 1);
  } else {
    ::unsetenv("DISPLAY");
  }
  ::kill(server_, SIGTERM);
  TEMP_FAILURE_RETRY(::waitpid(server_, nullptr, 0));
}

}  // namespace scree::output
