#include "tools/run/gnuplot.h"

#include <cstdio>

#include <sys/wait.h>

#include <fmt/format.h>

#include "engine/base/check.h"

namespace scree::run {

void draw_by_gnuplot(const std::string& commands, const std::filesystem::path& picture) {
  std::error_code none_there;
  std::filesystem::remove(picture, none_there);
  std::FILE* gnuplot = popen("gnuplot", "w");
  constexpr int no_such_command = 127;  // of a shell
  if (gnuplot != nullptr) std::fputs(commands.c_str(), gnuplot);
  const int status = gnuplot == nullptr ? -1 : pclose(gnuplot);
  if (gnuplot == nullptr || (WIFEXITED(status) && WEXITSTATUS(status) == no_such_command)) {
    throw RunError("gnuplot could not be started. Run tools/setup, or apt-get install gnuplot-nox");
  }
  if (status != 0 || !std::filesystem::exists(picture)) {
    throw RunError(fmt::format("gnuplot could not draw {}; what it said stands above", picture.string()));
  }
}

}  // namespace scree::run
