#include "thermal/maximum_principle.h"

#include <algorithm>
#include <cmath>

namespace scree::thermal {

namespace {

constexpr double rounding = 1e-12;  // of K_ij/sqrt(K_ii K_jj)

void count(const SparseMatrix& matrix, MaximumPrinciple& result) {
  const Eigen::VectorXd diagonal = matrix.diagonal();
  for (int column = 0; column < matrix.outerSize(); ++column) {
    for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry) {
      if (entry.row() <= column || entry.value() == 0) continue;
      ++result.pairs;
      const double scaled = entry.value() / std::sqrt(diagonal[entry.row()] * diagonal[column]);
      if (!(scaled > rounding)) continue;
      ++result.reversed;
      result.largest = std::max(result.largest, scaled);
    }
  }
}

}  // namespace

MaximumPrinciple maximum_principle(const HeatModel& model) {
  MaximumPrinciple result;
  count(model.conductance, result);
  if (model.varying) count(model.varying->unit_conductance, result);
  return result;
}

}  // namespace scree::thermal
