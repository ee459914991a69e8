#include "thermal/quick_ordering.h"

#include <vector>

#include <amd.h>

namespace scree::thermal {

FactorSize quick_factor_size(const SparseMatrix& lower) {
  const auto size = static_cast<int>(lower.cols());
  std::vector<int> order(lower.cols());
  double info[AMD_INFO];
  const int status = amd_order(size, lower.outerIndexPtr(), lower.innerIndexPtr(), order.data(), nullptr, info);
  if (status != AMD_OK) return {.possible = false};
  return {info[AMD_LNZ] + size, size + info[AMD_NDIV] + 2 * info[AMD_NMULTSUBS_LDL], true};
}

}  // namespace scree::thermal
