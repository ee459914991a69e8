// What an ensemble says: mean, spread and how sure the mean is.
#pragma once

#include <vector>

#include "tools/study/study.h"
#include "tools/study/table.h"

namespace scree::study {

struct Statistics {
  std::size_t count = 0;
  double mean = 0;
  double deviation = 0;  // of the sample, with n - 1; NaN for fewer than two
  double low = 0;        // of the 95 % confidence interval of the mean by Student's t; NaN for fewer than two
  double high = 0;
};

// Over the values that are not missing; NaN where there are too few.
Statistics statistics_of(const std::vector<double>& values);

// A row per combination: what varies but the ensemble, and for every figure reported NAME.count, .mean, .deviation, .low and
// .high over the members that are complete; of a time at which a probe gets to a temperature only .count, the number of those
// that do, where one of them does not.
Table ensembles_of(const Study& study, const Table& runs);

}  // namespace scree::study
