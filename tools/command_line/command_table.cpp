#include "tools/command_line/command_table.h"

#include <set>
#include <sstream>

namespace scree::command_line {

namespace {

// What an option takes, by its name: CLI11 knows text from numbers, but not what a text names.
Value value_of(const CLI::Option& option, const std::string& name) {
  static const std::set<std::string> files{"scene", "study", "--picture", "--animation", "--page", "--slurm", "--parallel"};
  static const std::set<std::string> directories{"directory", "--out"};
  if (option.get_items_expected_max() == 0) return Value::none;
  if (files.contains(name)) return Value::file;
  if (directories.contains(name)) return Value::directory;
  return Value::free_text;
}

// CLI11 describes a choice as "TEXT:{settle,heat,contacts}".
std::vector<std::string> choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const auto open = type.find('{');
  const auto close = type.find('}', open);
  std::vector<std::string> choices;
  if (open == std::string::npos || close == std::string::npos) return choices;
  std::istringstream list(type.substr(open + 1, close - open - 1));
  for (std::string choice; std::getline(list, choice, ',');) choices.push_back(choice);
  return choices;
}

OptionRow row_of(const CLI::Option& option) {
  OptionRow row;
  row.positional = option.get_positional();
  row.name = row.positional ? option.get_name(true) : "--" + option.get_lnames().front();
  row.description = option.get_description();
  row.required = option.get_required();
  row.value = value_of(option, row.name);
  row.choices = choices_of(option);
  if (!row.choices.empty()) row.value = Value::choice;
  return row;
}

// Also those in the groups of a command, which CLI11 keeps as nameless commands.
void add_options(const CLI::App& command, std::vector<OptionRow>& rows) {
  for (const CLI::Option* option : command.get_options()) rows.push_back(row_of(*option));
  for (const CLI::App* group : command.get_subcommands([](const CLI::App* app) { return app->get_name().empty(); })) {
    add_options(*group, rows);
  }
}

}  // namespace

std::vector<CommandRow> command_table(const CLI::App& app) {
  std::vector<CommandRow> commands;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    CommandRow row{command->get_name(), command->get_description(), {}};
    add_options(*command, row.options);
    commands.push_back(std::move(row));
  }
  return commands;
}

}  // namespace scree::command_line
