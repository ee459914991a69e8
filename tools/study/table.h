// A table with a row per run, as CSV and HDF5.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace scree::study {

// Numbers, or texts. A missing number is NaN and an empty cell.
struct Column {
  std::string name;
  std::vector<double> numbers = {};
  std::vector<std::string> texts = {};
  bool is_text = false;

  [[nodiscard]] std::size_t size() const { return is_text ? texts.size() : numbers.size(); }
  [[nodiscard]] std::string cell(std::size_t row) const;  // as in CSV, without quotes
};

struct Table {
  std::vector<Column> columns;

  [[nodiscard]] const Column* find(const std::string& name) const;
  [[nodiscard]] std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
};

// RFC 4180, with a head.
std::string to_csv(const Table& table);

// One data set per column, all of one length, and their order as `columns`. `read_table` throws InputError.
void write_hdf5(const Table& table, const std::filesystem::path& file);
Table read_table(const std::filesystem::path& file);

}  // namespace scree::study
