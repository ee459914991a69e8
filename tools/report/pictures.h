// Pictures of a run, drawn for its report.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/run/run_files.h"

namespace scree::report {

struct Drawn {
  std::string html;  // the image or video itself
  std::string caption;
};

struct Wanted {
  bool animated = false;  // the fall and the heating, too
  bool contacts = false;  // there are some to draw
};

// What there is to see: the settled pile, the temperatures at the end, from outside and cut through the middle of what moved,
// and the heat through the contacts.
std::vector<Drawn> draw_pictures(const run::RunFiles& files, const Wanted& wanted);

}  // namespace scree::report
