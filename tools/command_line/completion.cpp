#include "tools/command_line/completion.h"

#include <fmt/format.h>

namespace scree::command_line {

namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::string names_of_commands(const std::vector<CommandRow>& commands) {
  std::vector<std::string> names;
  names.reserve(commands.size());
  for (const CommandRow& command : commands) names.push_back(command.name);
  return joined(names);
}

std::string names_of_options(const CommandRow& command) {
  std::vector<std::string> names;
  for (const OptionRow& option : command.options) {
    if (!option.positional) names.push_back(option.name);
  }
  return joined(names);
}

// How bash completes the value of an option.
std::string bash_values(const OptionRow& option) {
  switch (option.value) {
    case Value::file:
      return R"(mapfile -t COMPREPLY < <(compgen -f -- "$word"))";
    case Value::directory:
      return R"(mapfile -t COMPREPLY < <(compgen -d -- "$word"))";
    case Value::choice:
      return fmt::format(R"(COMPREPLY=($(compgen -W "{}" -- "$word")))", joined(option.choices));
    case Value::free_text:
      return "COMPREPLY=()";
    case Value::none:
      break;
  }
  return "";
}

std::string bash_command(const CommandRow& command) {
  std::string script = fmt::format("    {})\n      case \"$before\" in\n", command.name);
  for (const OptionRow& option : command.options) {
    if (option.positional || option.value == Value::none) continue;
    script += fmt::format("        {}) {}; return ;;\n", option.name, bash_values(option));
  }
  script += fmt::format(
      "      esac\n"
      "      if [[ $word == -* ]]; then COMPREPLY=($(compgen -W \"{}\" -- \"$word\")); return; fi\n",
      names_of_options(command));
  for (const OptionRow& option : command.options) {
    if (option.positional) script += fmt::format("      {}\n", bash_values(option));
  }
  return script + "      ;;\n";
}

// Inside single quotes and a zsh specification in brackets.
std::string zsh_text(const std::string& text) {
  std::string quoted;
  for (const char c : text) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      if (c == '[' || c == ']' || c == ':' || c == '\\') quoted += '\\';
      quoted += c;
    }
  }
  return quoted;
}

std::string zsh_action(const OptionRow& option) {
  if (option.value == Value::file) return "_files";
  if (option.value == Value::directory) return "_files -/";
  if (option.value == Value::choice) return "(" + joined(option.choices) + ")";
  return " ";
}

std::string zsh_command(const CommandRow& command) {
  std::string script = fmt::format("    {})\n      _arguments", command.name);
  for (const OptionRow& option : command.options) {
    if (option.positional) {
      script += fmt::format(" \\\n        ':{}:{}'", zsh_text(option.name), zsh_action(option));
    } else if (option.value == Value::none) {
      script += fmt::format(" \\\n        '{}[{}]'", option.name, zsh_text(option.description));
    } else {
      script += fmt::format(" \\\n        '*{}[{}]:value:{}'", option.name, zsh_text(option.description), zsh_action(option));
    }
  }
  return script + "\n      ;;\n";
}

}  // namespace

std::string bash_completion(const std::vector<CommandRow>& commands) {
  std::string script =
      "# Completion of scree for bash, made from the command's own table of options: scree completion bash\n"
      "_scree() {\n"
      "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
      "  compopt -o filenames 2> /dev/null\n"
      "  if [[ $COMP_CWORD -eq 1 ]]; then\n"
      "    COMPREPLY=($(compgen -W \"" +
      names_of_commands(commands) +
      " --help --version\" -- \"$word\"))\n"
      "    return\n"
      "  fi\n"
      "  case \"${COMP_WORDS[1]}\" in\n";
  for (const CommandRow& command : commands) script += bash_command(command);
  return script + "  esac\n}\ncomplete -F _scree scree\n";
}

std::string zsh_completion(const std::vector<CommandRow>& commands) {
  std::string script =
      "#compdef scree\n"
      "# Completion of scree for zsh, made from the command's own table of options: scree completion zsh\n"
      "_scree() {\n"
      "  if (( CURRENT == 2 )); then\n"
      "    local -a commands=(\n";
  for (const CommandRow& command : commands) {
    script += fmt::format("      '{}:{}'\n", command.name, zsh_text(command.description));
  }
  script +=
      "    )\n"
      "    _describe command commands\n"
      "    return\n"
      "  fi\n"
      "  local command=$words[2]\n"
      "  shift words\n"
      "  (( CURRENT-- ))\n"
      "  case $command in\n";
  for (const CommandRow& command : commands) script += zsh_command(command);
  return script + "  esac\n}\n_scree \"$@\"\n";
}

}  // namespace scree::command_line
