// Completion of the command in a shell.
#pragma once

#include <string>
#include <vector>

#include "tools/command_line/command_table.h"

namespace scree::command_line {

// A script for bash-completion, and a function for zsh's completion system.
std::string bash_completion(const std::vector<CommandRow>& commands);
std::string zsh_completion(const std::vector<CommandRow>& commands);

}  // namespace scree::command_line
