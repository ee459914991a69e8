// Which steps in time cost least, and why.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "thermal/time_scheme.h"

namespace scree::thermal {

struct ChosenScheme {
  std::unique_ptr<TimeScheme> scheme;
  std::function<std::string()> why;  // in words, for the summary; may wait for what the long steps are made of
};

// As the options say or, if they leave it open, what costs least: stabilised explicit steps by the number of their products,
// implicit ones by the symbolic analysis of their factorisation, which is made only where a quick ordering promises that it
// will pay, or short steps by the one and longer ones by the other. The choice is arithmetic with the model's figures and the
// same everywhere. Where the first steps are explicit whatever that analysis says, it is made beside them. Refers to the model.
ChosenScheme choose_scheme(const HeatModel& model, const TimeOptions& options);

}  // namespace scree::thermal
