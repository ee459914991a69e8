#include "tools/command_line/manual.h"

#include <fmt/format.h>

namespace scree::command_line {

namespace {

// A hyphen stays one, a backslash is none of roff's, and a line cannot begin with a request.
std::string roff(const std::string& text) {
  std::string quoted;
  for (const char c : text) {
    if (c == '-') {
      quoted += "\\-";
    } else if (c == '\\') {
      quoted += "\\e";
    } else {
      quoted += c;
    }
  }
  return quoted.starts_with('.') || quoted.starts_with('\'') ? "\\&" + quoted : quoted;
}

std::string synopsis(const CommandRow& command) {
  std::string line = fmt::format("\\fBscree {}\\fR", command.name);
  for (const OptionRow& option : command.options) {
    if (!option.positional) continue;
    line += option.required ? fmt::format(" \\fI{}\\fR", option.name) : fmt::format(" [\\fI{}\\fR]", option.name);
  }
  return line + " [options]";
}

std::string option_entry(const OptionRow& option) {
  std::string value;
  if (option.value == Value::choice) {
    for (const std::string& choice : option.choices) value += (value.empty() ? " " : "|") + choice;
  } else if (option.value != Value::none && !option.positional) {
    value = option.value == Value::file        ? " \\fIFILE\\fR"
            : option.value == Value::directory ? " \\fIDIR\\fR"
                                               : " \\fIVALUE\\fR";
  }
  return fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", roff(option.name), value, roff(option.description));
}

constexpr const char* ending = R"(.SH EXIT STATUS
.TP
.B 0
The run is complete and sound.
.TP
.B 1
It did not settle, converge or balance, or could not go on.
.TP
.B 2
Bad input.
.TP
.B 130
It was interrupted.
.SH ENVIRONMENT
.TP
.B NO_COLOR
If set and not empty, nothing is coloured. Without it only a terminal gets colours.
.SH FILES
.TP
.I summary.json
The evidence of a run, in its directory, beside \fIscene.yaml\fR, \fIprobes.csv\fR, \fIpacking.h5\fR and the series
\fIsettle.pvd\fR, \fIheat.pvd\fR and \fIcontacts.pvd\fR for ParaView.
.SH EXAMPLE
.nf
scree check scenes/small_pile.yaml
scree run scenes/small_pile.yaml \-\-out out/small_pile \-\-set heat.until="2 h"
scree report out/small_pile
.fi
)";

}  // namespace

std::string manual(const std::vector<CommandRow>& commands, const std::string& version) {
  std::string page = fmt::format(
      ".TH SCREE 1 \"\" \"Scree {}\" \"User commands\"\n.SH NAME\nscree \\- heat in heaps: blocks fall, pile up and are "
      "heated\n"
      ".SH SYNOPSIS\n",
      roff(version));
  for (const CommandRow& command : commands) page += fmt::format("{}\n.br\n", synopsis(command));
  page +=
      ".SH DESCRIPTION\nSettles bodies that fall apart into blocks, and solves the heat inside every block and across every "
      "contact. A scene is a YAML file; \\fBscree keys\\fR prints all it may say.\n";
  for (const CommandRow& command : commands) {
    page += fmt::format(".SS scree {}\n{}\n", command.name, roff(command.description));
    for (const OptionRow& option : command.options) page += option_entry(option);
  }
  return page + ending;
}

}  // namespace scree::command_line
