// An option that is given has a value: an empty one, as of a variable that is not set, is a mistake and no way to leave it
// away.
#pragma once

#include <CLI/CLI.hpp>

namespace scree::command_line {

// Of all options of an application and its commands.
void expect_values(CLI::App& app);

}  // namespace scree::command_line
