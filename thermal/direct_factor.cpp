#include "thermal/direct_factor.h"

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "engine/base/huge_pages.h"
#include "engine/base/late_library.h"
#include "engine/base/phases.h"

namespace scree::thermal {

namespace {

template <class Factor>
std::unique_ptr<Factor> made_by(const char* name) {
  return std::unique_ptr<Factor>(late_function<Factor*()>("libscree_factor.so", name)());
}

// Numbers too small for single precision are zeros: where they are kept as such, each takes the processor a hundred times as
// long.
float single(double value) {
  constexpr double least = std::numeric_limits<float>::min();
  return std::abs(value) < least ? 0.0F : static_cast<float>(value);
}

class Cholesky : public DirectFactor {
 public:
  Cholesky() : Cholesky(made_by<CholeskyFactor>("scree_make_cholesky"), false) {}
  Cholesky(std::unique_ptr<CholeskyFactor> factor, bool analysed) : factor_(std::move(factor)), analysed_(analysed) {}

  FactorSize analyse(const Matrix& matrix) override {
    analysed_ = true;
    return factor_->analyse(matrix);
  }
  void factorise(const Matrix& matrix) override {
    if (!analysed_) analyse(matrix);
    if (!solve_) make_room();
    factor_->factorise(matrix);
    rough_is_new_ = false;
  }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) override { return solve_.value().solve(values_, rhs); }
  Eigen::MatrixXd estimate(const Eigen::MatrixXd& rhs) override {
    if (!rough_is_new_) round_values();
    return solve_.value().solve(rough_.data(), rhs);
  }
  [[nodiscard]] std::unique_ptr<DirectFactor> another() const override {
    std::unique_ptr<CholeskyFactor> factor(factor_->another());
    if (!factor) return nullptr;
    return std::make_unique<Cholesky>(std::move(factor), true);
  }
  [[nodiscard]] bool sound() const override { return factor_->sound(); }

 private:
  void make_room() {
    values_ = factor_->make_room();
    if (values_ == nullptr) return;
    solve_.emplace(factor_->pattern());
    prefer_huge_pages(values_, solve_->entries() * sizeof(double));
  }
  void round_values() {
    const std::size_t count = solve_.value().entries();
    if (rough_.size() == 0) {
      rough_.resize(static_cast<Eigen::Index>(count));
      prefer_huge_pages(rough_.data(), count * sizeof(float));
    }
    float* rough = rough_.data();
    for_short_chunks(count, [&](Chunk chunk) {
      for (std::size_t i = chunk.begin; i < chunk.end; ++i) rough[i] = single(values_[i]);
    });
    rough_is_new_ = true;
  }

  std::unique_ptr<CholeskyFactor> factor_;
  bool analysed_;
  std::optional<SupernodalSolve> solve_;
  double* values_ = nullptr;
  Eigen::VectorXf rough_;  // the values in single precision, once they are asked for
  bool rough_is_new_ = false;
};

}  // namespace

std::unique_ptr<DirectFactor> make_cholesky() {
  return std::make_unique<Cholesky>();
}

std::unique_ptr<DirectFactor> make_lu() {
  return made_by<DirectFactor>("scree_make_lu");
}

}  // namespace scree::thermal
