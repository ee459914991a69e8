#include "thermal/direct_factor.h"

#include <cmath>
#include <limits>
#include <new>
#include <optional>

#include "engine/base/late_library.h"
#include "engine/base/phases.h"
#include "engine/base/written_later.h"
#include "thermal/supernodal_factor.h"
#include "thermal/supernodal_solve.h"

namespace scree::thermal {

namespace {

// Numbers too small for single precision are zeros: where they are kept as such, each takes the processor a hundred times as
// long.
float single(double value) {
  constexpr double least = std::numeric_limits<float>::min();
  return std::abs(value) < least ? 0.0F : static_cast<float>(value);
}

class Cholesky : public DirectFactor {
 public:
  FactorSize analyse(const Matrix& matrix) override {
    size_ = analysis_->analyse(matrix);
    return *size_;
  }
  void factorise(const Matrix& matrix) override {
    if (!size_) analyse(matrix);
    if (!factor_ && size_->possible) make_room(matrix);
    sound_ = factor_ && factor_->factorise(matrix, values_.data());
    rough_is_new_ = false;
  }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) override { return solve_.value().solve(values_.data(), rhs); }
  Eigen::MatrixXd estimate(const Eigen::MatrixXd& rhs) override {
    if (!rough_is_new_) round_values();
    return solve_.value().solve(rough_.data(), rhs);
  }
  [[nodiscard]] bool sound() const override { return sound_; }

 private:
  // What there is no memory for is not factorised.
  void make_room(const Matrix& matrix) {
    const SupernodalPattern pattern = analysis_->pattern();
    solve_.emplace(pattern);
    try {
      values_.resize(solve_->entries());
    } catch (const std::bad_alloc&) {
      return;
    }
    factor_.emplace(pattern, matrix, analysis_->kernels());
  }
  void round_values() {
    rough_.resize(values_.size());
    for_short_chunks(values_.size(), [&](Chunk chunk) {
      for (std::size_t i = chunk.begin; i < chunk.end; ++i) rough_[i] = single(values_[i]);
    });
    rough_is_new_ = true;
  }

  std::unique_ptr<CholeskyAnalysis> analysis_{
      late_function<CholeskyAnalysis*()>("libscree_factor.so", "scree_make_cholesky")()};
  std::optional<FactorSize> size_;
  std::optional<SupernodalFactor> factor_;
  std::optional<SupernodalSolve> solve_;
  VectorWrittenLater<double> values_;
  VectorWrittenLater<float> rough_;  // the values in single precision, once they are asked for
  bool sound_ = false;
  bool rough_is_new_ = false;
};

}  // namespace

std::unique_ptr<DirectFactor> make_cholesky() {
  return std::make_unique<Cholesky>();
}

}  // namespace scree::thermal
