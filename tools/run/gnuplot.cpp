#include "tools/run/gnuplot.h"

#include <cstdio>

#include <fmt/format.h>

#include "engine/base/check.h"

namespace scree::run {

void draw_by_gnuplot(const std::string& commands, const std::filesystem::path& picture) {
  std::error_code none_there;
  std::filesystem::remove(picture, none_there);
  std::FILE* gnuplot = popen("gnuplot", "w");
  if (gnuplot == nullptr) throw RunError("gnuplot could not be started. Run tools/setup, or apt-get install gnuplot-nox");
  std::fputs(commands.c_str(), gnuplot);
  if (pclose(gnuplot) != 0 || !std::filesystem::exists(picture)) {
    throw RunError(fmt::format("gnuplot could not draw {}. Run tools/setup, or apt-get install gnuplot-nox", picture.string()));
  }
}

}  // namespace scree::run
