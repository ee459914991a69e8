#include "tools/study/ensembles.h"

#include <cmath>
#include <limits>
#include <map>

#include <boost/math/distributions/students_t.hpp>

namespace scree::study {

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();
constexpr double confidence = 0.95;

// Rows of each combination, in the order of the combinations.
std::vector<std::vector<std::size_t>> rows_by_point(const Table& runs) {
  std::map<double, std::vector<std::size_t>> rows;
  const Column& point = *runs.find("point");
  for (std::size_t row = 0; row < runs.rows(); ++row) rows[point.numbers[row]].push_back(row);
  std::vector<std::vector<std::size_t>> list;
  list.reserve(rows.size());
  for (auto& [number, members] : rows) list.push_back(std::move(members));
  return list;
}

Column first_of_each(const Column& column, const std::vector<std::vector<std::size_t>>& points) {
  Column first{column.name, {}, {}, column.is_text};
  for (const auto& rows : points) {
    if (column.is_text) {
      first.texts.push_back(column.texts[rows.front()]);
    } else {
      first.numbers.push_back(column.numbers[rows.front()]);
    }
  }
  return first;
}

// Of a figure's members that are sound. Where some never get to a temperature, or not yet, the mean of the times of the others
// says nothing of them all.
Statistics statistics_of_members(const Report& report, const std::vector<double>& values) {
  const Statistics all = statistics_of(values);
  if (report.probe.empty() || all.count == values.size()) return all;
  return {all.count, missing, missing, missing, missing};
}

}  // namespace

Statistics statistics_of(const std::vector<double>& values) {
  Statistics result{0, missing, missing, missing, missing};
  double sum = 0;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    ++result.count;
    sum += value;
  }
  if (result.count == 0) return result;
  const auto n = static_cast<double>(result.count);
  result.mean = sum / n;
  if (result.count < 2) return result;
  double squares = 0;
  for (const double value : values) {
    if (!std::isnan(value)) squares += (value - result.mean) * (value - result.mean);
  }
  result.deviation = std::sqrt(squares / (n - 1));
  const double t = boost::math::quantile(boost::math::students_t(n - 1), (1 + confidence) / 2);
  result.low = result.mean - t * result.deviation / std::sqrt(n);
  result.high = result.mean + t * result.deviation / std::sqrt(n);
  return result;
}

Table ensembles_of(const Study& study, const Table& runs) {
  const auto points = rows_by_point(runs);
  const std::vector<std::string>& status = runs.find("status")->texts;
  Table table;
  table.columns.push_back(first_of_each(*runs.find("point"), points));
  for (const Factor& factor : study.factors) table.columns.push_back(first_of_each(*runs.find(factor.name()), points));
  for (const Report& report : study.reports) {
    const Column& column = *runs.find(report.column);
    if (column.is_text) continue;
    std::vector<Column> statistics;
    for (const char* name : {".count", ".mean", ".deviation", ".low", ".high"}) statistics.push_back({report.column + name});
    for (const auto& rows : points) {
      std::vector<double> values;
      values.reserve(rows.size());
      for (const std::size_t row : rows) {
        if (status[row] == "complete") values.push_back(column.numbers[row]);
      }
      const Statistics s = statistics_of_members(report, values);
      const double figures[] = {static_cast<double>(s.count), s.mean, s.deviation, s.low, s.high};
      for (std::size_t i = 0; i < statistics.size(); ++i) statistics[i].numbers.push_back(figures[i]);
    }
    for (Column& one : statistics) table.columns.push_back(std::move(one));
  }
  return table;
}

}  // namespace scree::study
