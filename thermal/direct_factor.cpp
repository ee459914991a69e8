#include "thermal/direct_factor.h"

#include <optional>

#include "engine/base/late_library.h"

namespace scree::thermal {

namespace {

template <class Factor>
std::unique_ptr<Factor> made_by(const char* name) {
  return std::unique_ptr<Factor>(late_function<Factor*()>("libscree_factor.so", name)());
}

class Cholesky : public DirectFactor {
 public:
  FactorSize analyse(const Matrix& matrix) override {
    analysed_ = true;
    return factor_->analyse(matrix);
  }
  void factorise(const Matrix& matrix) override {
    if (!analysed_) analyse(matrix);
    factor_->factorise(matrix);
    if (sound()) solve_.emplace(factor_->factor());
  }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) override { return solve_.value().solve(rhs); }
  [[nodiscard]] bool sound() const override { return factor_->sound(); }

 private:
  std::unique_ptr<CholeskyFactor> factor_ = made_by<CholeskyFactor>("scree_make_cholesky");
  std::optional<SupernodalSolve> solve_;
  bool analysed_ = false;
};

}  // namespace

std::unique_ptr<DirectFactor> make_cholesky() {
  return std::make_unique<Cholesky>();
}

std::unique_ptr<DirectFactor> make_lu() {
  return made_by<DirectFactor>("scree_make_lu");
}

}  // namespace scree::thermal
