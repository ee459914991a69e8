#include "engine/output/probe_table.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "engine/base/atomic_file.h"
#include "engine/base/check.h"
#include "engine/base/csv.h"
#include "engine/base/plain_number.h"
#include "engine/output/not_as_left.h"

namespace scree::output {

namespace {

constexpr std::string_view exact_ending = " exact";

// Comments and names of columns.
std::string head(const std::vector<std::string>& comments, const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& comment : comments) text += fmt::format("# {}\n", comment);
  text += "time";
  for (const std::string& name : names) text += ',' + csv_cell(name);
  return text + '\n';
}

// The whole lines of a file. One that ends with the file instead of a newline was not finished; getline then reports the end.
std::vector<std::string> finished_lines(const std::filesystem::path& file) {
  std::ifstream old(file, std::ios::binary);
  if (!old) throw not_as_left("probes", file, fmt::format("must be a file that can be read ({})", std::strerror(errno)));
  std::vector<std::string> lines;
  for (std::string line; std::getline(old, line) && !old.eof();) lines.push_back(line + '\n');
  return lines;
}

}  // namespace

std::string exact_column(const std::string& probe) {
  return probe + std::string(exact_ending);
}

std::optional<std::string> probe_of_exact_column(const std::string& column) {
  if (!column.ends_with(exact_ending)) return std::nullopt;
  return column.substr(0, column.size() - exact_ending.size());
}

ProbeTable::ProbeTable(std::filesystem::path file, const std::vector<std::string>& comments,
                       const std::vector<std::string>& names)
    : file_(std::move(file)) {
  write_unflushed(file_, head(comments, names));
}

ProbeTable::ProbeTable(std::filesystem::path file, const std::vector<std::string>& comments,
                       const std::vector<std::string>& names, double keep_until)
    : file_(std::move(file)) {
  const auto lines = finished_lines(file_);
  const std::string first = head(comments, names);
  std::string text;
  double last = -1;
  for (const std::string& line : lines) {
    if (text.size() >= first.size()) {
      const auto time = plain_number(std::string_view(line).substr(0, line.find(',')));
      if (!time || !(*time <= keep_until)) break;
      last = *time;
    }
    text += line;
  }
  if (!text.starts_with(first) || last != keep_until) {
    throw not_as_left("probes", file_,
                      fmt::format("must have its head and its row at {} s, from where the run would go on", keep_until));
  }
  write_text(file_, text);
}

void ProbeTable::append(double time, const std::vector<double>& values) {
  std::string row = fmt::format("{}", time);
  for (const double value : values) row += fmt::format(",{}", value);
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file_, error);
  errno = 0;
  std::ofstream table(file_, std::ios::binary | std::ios::app);
  table << row << '\n' << std::flush;
  if (table && !error) return;
  const std::error_code reason = error ? error : std::error_code(errno, std::generic_category());
  table.close();
  if (!error) std::filesystem::resize_file(file_, size, error);
  throw RunError(not_written(file_, reason));
}

}  // namespace scree::output
