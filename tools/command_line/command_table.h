// The command's own table of subcommands and options, as CLI11 keeps it, in the form that completion and manual need.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace scree::command_line {

enum class Value { none, free_text, file, directory, choice };

struct OptionRow {
  std::string name;  // "--out", or the name of a positional argument
  std::string description;
  Value value = Value::none;
  std::vector<std::string> choices;  // of a Value::choice
  bool positional = false;
  bool required = false;
};

struct CommandRow {
  std::string name;
  std::string description;
  std::vector<OptionRow> options;
};

// One row per subcommand, in the order of --help.
std::vector<CommandRow> command_table(const CLI::App& app);

}  // namespace scree::command_line
