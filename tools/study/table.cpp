#include "tools/study/table.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>

#include <fmt/format.h>

#include "engine/base/atomic_file.h"
#include "engine/base/check.h"
#include "engine/base/csv.h"
#include "engine/base/hdf5_image.h"
#include "engine/base/hdf5_reader.h"

namespace scree::study {

namespace {

std::string line(const Table& table, auto cell_of) {
  std::string text;
  for (const Column& column : table.columns) text += csv_cell(cell_of(column)) + ',';
  text.back() = '\n';
  return text;
}

Column read_column(const Hdf5Reader& in, const std::string& name) {
  Column column{name};
  column.is_text = in.holds_texts(name);
  column.is_text ? void(column.texts = in.texts(name)) : void(column.numbers = in.doubles(name));
  return column;
}

bool is_whole(const Table& table) {
  return !table.columns.empty() && std::all_of(table.columns.begin(), table.columns.end(),
                                               [&](const Column& column) { return column.size() == table.rows(); });
}

}  // namespace

std::string Column::cell(std::size_t row) const {
  if (is_text) return texts[row];
  return std::isnan(numbers[row]) ? std::string() : fmt::format("{}", numbers[row]);
}

const Column* Table::find(const std::string& name) const {
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const Column& column) { return column.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

std::string to_csv(const Table& table) {
  std::string csv = line(table, [](const Column& column) { return column.name; });
  for (std::size_t row = 0; row < table.rows(); ++row) {
    csv += line(table, [&](const Column& column) { return column.cell(row); });
  }
  return csv;
}

void write_hdf5(const Table& table, const std::filesystem::path& file) {
  Hdf5Image image(sizeof(double) * table.columns.size() * table.rows());
  std::vector<std::string> names;
  for (const Column& column : table.columns) {
    names.push_back(column.name);
    column.is_text ? image.put(column.name, column.texts) : image.put(column.name, column.numbers);
  }
  image.put("columns", names);
  write_text(file, image.bytes());
}

Table read_table(const std::filesystem::path& file) {
  try {
    const Hdf5Reader in(file);
    Table table;
    for (const std::string& name : in.texts("columns")) table.columns.push_back(read_column(in, name));
    if (is_whole(table)) return table;
  } catch (const Hdf5Error&) {
    // said below, in words that help
  } catch (const std::bad_alloc&) {
    // a column longer than memory
  } catch (const std::length_error&) {
    // or than any list
  }
  Problem problem;
  problem.key = "the table";
  problem.value = file.string();
  problem.rule = "must be the table of a study";
  problem.suggestion = "`scree study STUDY` and `scree study STUDY --gather` write it";
  throw InputError(problem);
}

}  // namespace scree::study
