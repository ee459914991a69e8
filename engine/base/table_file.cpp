#include "engine/base/table_file.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/nearest.h"
#include "engine/base/trimmed.h"

namespace scree {

namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  // spreadsheets begin with it

struct Cell {
  std::string_view text;
  int column = 1;
};

class Reader {
 public:
  Reader(const std::filesystem::path& file, const std::vector<Argument>& arguments, const ValueRule& rule)
      : file_(file.string()), arguments_(arguments), rule_(rule) {}

  ReadTable read(std::istream& stream) {
    std::string line;
    while (std::getline(stream, line)) {
      ++line_;
      if (line_ == 1 && line.starts_with(byte_order_mark)) line.erase(0, byte_order_mark.size());
      const std::string_view text = trimmed(std::string_view(line).substr(0, line.find('#')));
      if (text.empty()) continue;
      const std::vector<Cell> cells = split(std::string_view(line).substr(0, line.find('#')));
      if (cells.size() != 2) {
        refuse(1, fmt::format("a line of {} columns", cells.size()), "must have two, with a comma between them", "");
      } else if (!argument_) {
        read_head(cells);
      } else {
        read_pair(cells);
      }
      if (!argument_) break;  // without a head nothing else can be understood
    }
    if (problems_.empty() && places_.empty()) refuse(0, "without numbers", "must have a head and at least one pair", "");
    if (!problems_.empty()) throw InputError(std::move(problems_));
    return {argument_->name, LinearTable(std::move(places_), std::move(values_))};
  }

 private:
  static std::vector<Cell> split(std::string_view line) {
    std::vector<Cell> cells;
    std::size_t begin = 0;
    while (true) {
      const std::size_t comma = line.find(',', begin);
      const std::string_view piece = line.substr(begin, comma == std::string_view::npos ? comma : comma - begin);
      const std::size_t lead = std::min(piece.find_first_not_of(" \t"), piece.size());
      cells.push_back({trimmed(piece), static_cast<int>(begin + lead) + 1});
      if (comma == std::string_view::npos) return cells;
      begin = comma + 1;
    }
  }

  void refuse(int column, std::string value, std::string rule, std::string suggestion) {
    ValueRule here;
    here.key = "table of " + rule_.key;
    here.where = {file_, column == 0 ? 0 : line_, column};
    problems_.push_back(here.problem(std::move(value), std::move(rule), std::move(suggestion)));
  }

  // "time [h]": a name, and a unit of the quantity.
  std::optional<UnitConverter> read_title(const Cell& cell, const Quantity& quantity) {
    const auto open = cell.text.find('[');
    if (open == std::string_view::npos || cell.text.back() != ']') {
      refuse(cell.column, std::string(cell.text), "must be a name and a unit",
             fmt::format("Write {} [{}]", trimmed(cell.text.substr(0, open)), quantity.unit));
      return std::nullopt;
    }
    const auto unit = unit_converter(cell.text.substr(open + 1, cell.text.size() - open - 2), quantity);
    if (const auto* problem = std::get_if<UnitProblem>(&unit)) {
      refuse(cell.column, std::string(cell.text), problem->reason, problem->suggestion);
      return std::nullopt;
    }
    return std::get<UnitConverter>(unit);
  }

  void read_head(const std::vector<Cell>& cells) {
    const std::string_view name = trimmed(cells[0].text.substr(0, cells[0].text.find('[')));
    std::vector<std::string> names;
    for (const Argument& argument : arguments_) {
      names.push_back(argument.name);
      if (argument.name == name) argument_ = argument;
    }
    if (!argument_) {
      return refuse(cells[0].column, std::string(cells[0].text),
                    fmt::format("the first column must be {} and its unit", fmt::join(names, ", ")),
                    suggest(std::string(name), names));
    }
    place_unit_ = read_title(cells[0], argument_->quantity);
    value_unit_ = read_title(cells[1], rule_.quantity);
    if (!place_unit_ || !value_unit_) argument_.reset();
  }

  std::optional<double> read_number(const Cell& cell, const UnitConverter& unit) {
    const auto number = parse_quantity(cell.text, quantity::number);
    const auto* problem = std::get_if<UnitProblem>(&number);
    const double value = problem == nullptr ? unit(std::get<double>(number)) : 0;
    if (problem == nullptr && std::isfinite(value)) return value;
    refuse(cell.column, std::string(cell.text),
           problem == nullptr ? "too large for a number in double precision" : problem->reason, "");
    return std::nullopt;
  }

  void read_pair(const std::vector<Cell>& cells) {
    const auto place = read_number(cells[0], *place_unit_);
    const auto value = read_number(cells[1], *value_unit_);
    if (!place || !value) return;
    if (!places_.empty() && *place <= places_.back()) {
      return refuse(cells[0].column, std::string(cells[0].text), "must be above the one before",
                    "A jump is two places close together");
    }
    if (!rule_.holds(*value)) {
      return refuse(cells[1].column, fmt::format("{:g} {}", *value, rule_.quantity.unit), "must be " + rule_.words(), "");
    }
    places_.push_back(*place);
    values_.push_back(*value);
  }

  std::string file_;
  const std::vector<Argument>& arguments_;
  const ValueRule& rule_;
  int line_ = 0;
  std::optional<Argument> argument_;
  std::optional<UnitConverter> place_unit_;
  std::optional<UnitConverter> value_unit_;
  std::vector<double> places_;
  std::vector<double> values_;
  std::vector<Problem> problems_;
};

}  // namespace

ReadTable read_table(const std::filesystem::path& file, const std::vector<Argument>& arguments, const ValueRule& rule) {
  const auto refuse = [&](const std::string& why) {
    throw InputError(rule.problem(file.string(), fmt::format("the table cannot be read: {}", why)));
  };
  // A pipe would be waited for, and a device may have no end.
  std::error_code ignored;
  const auto status = std::filesystem::status(file, ignored);
  if (std::filesystem::is_directory(status)) refuse("a folder");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) refuse("no regular file");
  std::ifstream stream(file);
  if (!stream) refuse(std::strerror(errno));
  return Reader(file, arguments, rule).read(stream);
}

}  // namespace scree
