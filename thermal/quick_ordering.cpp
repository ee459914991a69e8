#include "thermal/quick_ordering.h"

#include <vector>

#include <amd.h>

#include "thermal/kirchhoff_matrix.h"

namespace scree::thermal {

namespace {

SparseMatrix pattern_of(const HeatModel& model, const FreeNodes& free) {
  if (is_symmetric(model)) return free.lower_block(model.conductance);
  return free.lower_block(SparseMatrix(model.conductance + model.varying->unit_conductance));
}

}  // namespace

FactorSize quick_factor_size(const HeatModel& model, const FreeNodes& free) {
  const SparseMatrix lower = pattern_of(model, free);
  const auto size = static_cast<int>(lower.cols());
  std::vector<int> order(lower.cols());
  double info[AMD_INFO];
  const int status = amd_order(size, lower.outerIndexPtr(), lower.innerIndexPtr(), order.data(), nullptr, info);
  if (status != AMD_OK) return {.possible = false};
  return {info[AMD_LNZ] + size, size + info[AMD_NDIV] + 2 * info[AMD_NMULTSUBS_LDL], true};
}

}  // namespace scree::thermal
