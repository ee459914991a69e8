// What a ladder says: errors against a reference, observed orders, and the runs that no other beats.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/output/probe_history.h"
#include "tools/accuracy/rung.h"

namespace scree::accuracy {

using output::ProbeHistory;

// Value of a probe at a time [K], or nothing if the reference does not know that probe.
using Reference = std::function<std::optional<double>(const std::string& probe, double time)>;

// A history as the reference for others with the same output times.
Reference reference_from(const ProbeHistory& history);

// The exact values that stand beside a history's own.
Reference exact_of(const ProbeHistory& history);

// Fills in the errors of `measured` over all times, but not the start of a run in time. Throws InputError if the reference
// knows none of the probes.
void compare(const ProbeHistory& history, const Reference& reference, Measured& measured);

// The slope of log(error) over log(size) by least squares; nothing for fewer than two points with a positive error.
std::optional<double> observed_order(const std::vector<std::pair<double, double>>& size_and_error);

// Marks the runs that no other run beats in both time and error.
void mark_front(std::vector<Measured>& runs);

// What varies and how fast the error falls with it.
struct Order {
  std::string of;  // "mesh size" or "time step"
  std::string at;  // what is held fixed
  double order = 0;
};
std::vector<Order> observed_orders(const std::vector<Measured>& runs);

}  // namespace scree::accuracy
