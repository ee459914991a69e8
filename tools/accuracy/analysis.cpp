#include "tools/accuracy/analysis.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "engine/base/check.h"

namespace scree::accuracy {

namespace {

[[noreturn]] void refuse(const std::string& value, const std::string& rule) {
  Problem problem;
  problem.key = "output.probes";
  problem.value = value;
  problem.rule = rule;
  throw InputError(problem);
}

bool same_models(const Rung& a, const Rung& b) {
  return a.integrator == b.integrator && a.contact_model == b.contact_model && a.block_model == b.block_model;
}

bool same_but_mesh(const Rung& a, const Rung& b) {
  return a.tolerance == b.tolerance && same_models(a, b);
}

bool same_but_tolerance(const Rung& a, const Rung& b) {
  return a.mesh_factor == b.mesh_factor && same_models(a, b);
}

std::string words(const Rung& rung) {
  std::string text = rung.integrator;
  for (const std::string& model : {rung.contact_model, rung.block_model}) {
    if (!model.empty()) text += ", " + model;
  }
  return text;
}

// What is known of a probe at the output time nearest to the asked one.
Reference columns_as_reference(std::vector<double> times, std::map<std::string, std::vector<double>> columns) {
  return
      [times = std::move(times), columns = std::move(columns)](const std::string& probe, double time) -> std::optional<double> {
        const auto column = columns.find(probe);
        if (column == columns.end()) return std::nullopt;
        const auto at = std::min_element(times.begin(), times.end(),
                                         [&](double a, double b) { return std::abs(a - time) < std::abs(b - time); });
        return column->second[static_cast<std::size_t>(at - times.begin())];
      };
}

}  // namespace

Reference reference_from(const ProbeHistory& history) {
  return columns_as_reference(history.times, history.values);
}

Reference exact_of(const ProbeHistory& history) {
  return columns_as_reference(history.times, history.exact);
}

void compare(const ProbeHistory& history, const Reference& reference, Measured& measured) {
  double largest = 0;
  double squares = 0;
  std::size_t count = 0;
  for (const auto& [probe, values] : history.values) {
    for (std::size_t i = output::first_compared(history); i < values.size(); ++i) {
      const auto expected = reference(probe, history.times[i]);
      if (!expected) continue;
      const double error = std::abs(values[i] - *expected);
      largest = std::max(largest, error);
      squares += error * error;
      ++count;
    }
  }
  if (count == 0) refuse("none to compare", "at least one probe must be known to the reference");
  measured.max_error = largest;
  measured.rms_error = std::sqrt(squares / static_cast<double>(count));
}

std::optional<double> observed_order(const std::vector<std::pair<double, double>>& size_and_error) {
  double n = 0;
  double x = 0;
  double y = 0;
  double xx = 0;
  double xy = 0;
  for (const auto& [size, error] : size_and_error) {
    if (!(size > 0) || !(error > 0)) continue;
    const double log_size = std::log(size);
    n += 1;
    x += log_size;
    y += std::log(error);
    xx += log_size * log_size;
    xy += log_size * std::log(error);
  }
  const double spread = n * xx - x * x;
  if (n < 2 || !(spread > 1e-12)) return std::nullopt;
  return (n * xy - x * y) / spread;
}

void mark_front(std::vector<Measured>& runs) {
  for (Measured& run : runs) {
    run.on_front = run.max_error && std::none_of(runs.begin(), runs.end(), [&](const Measured& other) {
                     return other.max_error && other.wall_seconds <= run.wall_seconds && *other.max_error <= *run.max_error &&
                            (other.wall_seconds < run.wall_seconds || *other.max_error < *run.max_error);
                   });
  }
}

std::vector<Order> observed_orders(const std::vector<Measured>& runs) {
  std::vector<Order> orders;
  const auto fit = [&](const std::string& of, const Measured& like, auto same, auto size_of) {
    std::vector<std::pair<double, double>> points;
    for (const Measured& run : runs) {
      if (run.max_error && same(run.rung, like.rung)) points.emplace_back(size_of(run), *run.max_error);
    }
    const auto order = observed_order(points);
    return order ? std::optional<Order>(Order{of, "", *order}) : std::nullopt;
  };
  double least_tolerance = INFINITY;
  double least_factor = INFINITY;
  for (const Measured& run : runs) {
    least_tolerance = std::min(least_tolerance, run.rung.tolerance);
    if (run.max_error) least_factor = std::min(least_factor, run.rung.mesh_factor);
  }
  std::vector<std::string> done;
  for (const Measured& run : runs) {
    const std::string family = words(run.rung);
    if (std::find(done.begin(), done.end(), family) != done.end()) continue;
    Measured like = run;
    like.rung.tolerance = run.rung.integrator != "explicit_euler" ? least_tolerance : run.rung.tolerance;
    if (auto order = fit("mesh size", like, same_but_mesh, [](const Measured& r) { return r.rung.mesh_factor; })) {
      order->at = fmt::format("{}, tolerance {:g} K", family, like.rung.tolerance);
      orders.push_back(*order);
    }
    like.rung.mesh_factor = least_factor;
    const auto step = [](const Measured& r) { return r.steps > 0 ? 1.0 / static_cast<double>(r.steps) : 0.0; };
    if (auto order = fit("time step", like, same_but_tolerance, step)) {
      order->at = fmt::format("{}, mesh factor {:g}", family, least_factor);
      orders.push_back(*order);
    }
    done.push_back(family);
  }
  return orders;
}

}  // namespace scree::accuracy
