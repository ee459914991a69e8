// How much memory runs may take together.
#pragma once

#include <cstdint>

namespace scree::study {

// What the machine can still give, or a control group's limit if that is less [bytes].
std::int64_t available_memory();

}  // namespace scree::study
