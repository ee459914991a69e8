// One run of a ladder, and what came of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace scree::accuracy {

// What one run of the ladder has its own way.
struct Rung {
  double mesh_factor = 1;     // times every body's mesh_size [-]
  double tolerance = 0;       // of the time error [K]
  std::string integrator;     // as heat.integrator
  std::string contact_model;  // as contact.model; empty: as the scene has it
  std::string block_model;    // as heat.blocks.model; empty: as the scene has it
};

struct Measured {
  Rung rung;
  int exit_status = 0;
  bool ran = false;  // it has temperatures
  std::int64_t nodes = 0;
  std::int64_t elements = 0;
  std::int64_t steps = 0;
  double wall_seconds = 0;        // contacts, assembly and heat
  double whole_wall_seconds = 0;  // from the command line to the end
  double peak_memory_bytes = 0;
  double time_error = 0;            // the run's own estimate [K]
  double lumping_error = 0;         // the run's own estimate [K]; 0 without lumped blocks
  std::optional<double> max_error;  // over probes and output times [K]; nothing for the reference itself and for a failed run
  std::optional<double> rms_error;  // [K]
  bool on_front = false;            // no other run is both faster and more accurate
};

}  // namespace scree::accuracy
