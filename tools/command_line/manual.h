// The manual page of the command.
#pragma once

#include <string>
#include <vector>

#include "tools/command_line/command_table.h"

namespace scree::command_line {

// scree.1 in the macros of man(7), without a date, so that the same program gives the same page.
std::string manual(const std::vector<CommandRow>& commands, const std::string& version);

}  // namespace scree::command_line
