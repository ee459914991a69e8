// The part of a run's page that tells of its pile.
#pragma once

#include "tools/report/summary_values.h"

namespace scree::report {

// `settle` of a summary.json, with its certificate.
void add_settle(Page& page, const Json& settle);

}  // namespace scree::report
