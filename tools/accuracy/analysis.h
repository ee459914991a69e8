// What a ladder says: errors against a reference, observed orders, and the runs that no other beats.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tools/accuracy/rung.h"

namespace scree::accuracy {

// The columns of a probes.csv.
struct ProbeHistory {
  std::vector<double> times;                          // [s]
  std::map<std::string, std::vector<double>> values;  // by probe, one per time [K]
};

// Value of a probe at a time [K], or nothing if the reference does not know that probe.
using Reference = std::function<std::optional<double>(const std::string& probe, double time)>;

// Throws InputError if the file cannot be read.
ProbeHistory read_probes(const std::string& file);

// A history as the reference for others with the same output times.
Reference reference_from(const ProbeHistory& history);

// Fills in the errors of `measured` over all times after the start. Throws InputError if the reference knows none of the
// probes.
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
