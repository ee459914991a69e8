#include "tools/run/gnuplot.h"

#include <cstdio>
#include <fstream>
#include <string_view>

#include <sys/wait.h>

#include <fmt/format.h>

#include "engine/base/atomic_file.h"
#include "engine/base/check.h"
#include "engine/base/ignored_pipe_signal.h"

namespace scree::run {

std::string gnuplot_text(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') quoted += c;
    quoted += c == '\n' || c == '\r' ? ' ' : c;
  }
  return quoted + "'";
}

namespace {

// As a shell has it.
int status_of(int waited) {
  constexpr int by_signal = 128;
  return WIFEXITED(waited) ? WEXITSTATUS(waited) : by_signal + WTERMSIG(waited);
}

void draw(const std::string& commands) {
  constexpr int no_such_command = 127;  // of a shell
  const RunError not_started("gnuplot could not be started. Run tools/setup, or apt-get install gnuplot-nox");
  const IgnoredPipeSignal ignored;
  // Without the user's own settings, which change pictures; if it cannot open its file it draws on standard output.
  std::FILE* gnuplot = popen("gnuplot -d > /dev/null", "w");
  if (gnuplot == nullptr) throw not_started;
  const bool taken = std::fputs(commands.c_str(), gnuplot) >= 0 && std::fflush(gnuplot) == 0;
  const int status = status_of(pclose(gnuplot));
  if (status == no_such_command) throw not_started;
  if (status != 0 || !taken) throw RunError(fmt::format("gnuplot failed with status {}; what it said stands above", status));
}

// That gnuplot could not write all of it, it does not say.
void expect_whole(const std::filesystem::path& picture) {
  constexpr std::string_view end = "IEND\xae\x42\x60\x82";
  std::string found(end.size(), '\0');
  std::ifstream file(picture, std::ios::binary | std::ios::ate);
  file.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  if (!file.read(found.data(), static_cast<std::streamsize>(found.size())) || found != end)
    throw RunError("the picture that gnuplot wrote is not whole. Is the disk full?");
}

}  // namespace

void draw_by_gnuplot(const std::function<std::string(const std::filesystem::path&)>& commands_for,
                     const std::filesystem::path& picture) {
  write_atomically(picture, [&](const std::filesystem::path& temporary) {
    draw(commands_for(temporary));
    expect_whole(temporary);
  });
}

}  // namespace scree::run
