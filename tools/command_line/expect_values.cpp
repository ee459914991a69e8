#include "tools/command_line/expect_values.h"

#include <string>

namespace scree::command_line {

void expect_values(CLI::App& app) {
  const CLI::Validator not_empty([](const std::string& value) { return value.empty() ? "must not be empty" : std::string(); },
                                 "");
  for (CLI::Option* option : app.get_options([](const CLI::Option*) { return true; })) option->check(not_empty);
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) expect_values(*command);
}

}  // namespace scree::command_line
