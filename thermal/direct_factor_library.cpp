#include <dlfcn.h>

#include <Eigen/CholmodSupport>
#include <Eigen/UmfPackSupport>

#include "thermal/direct_factor.h"

namespace scree::thermal {

namespace {

// A threaded BLAS may round differently with another number of threads, and a resumed run must repeat the same bits. Only
// OpenBLAS has threads among Debian's free ones, and whether it is there is known when the program starts, not when it is
// built.
void use_one_blas_thread() {
  using SetThreads = void (*)(int);
  if (const auto set = reinterpret_cast<SetThreads>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))) set(1);
}

class Cholesky : public DirectFactor {
 public:
  Cholesky() {
    use_one_blas_thread();
    cholesky_.cholmod().print = 0;  // failures are ours to report
  }
  void factorise(const Matrix& matrix) override {
    if (!analysed_) analyse(matrix);
    cholesky_.factorize(matrix);
  }
  FactorSize analyse(const Matrix& matrix) override {
    cholesky_.analyzePattern(matrix);
    analysed_ = true;
    return {cholesky_.cholmod().lnz, cholesky_.cholmod().fl, cholesky_.cholmod().status == CHOLMOD_OK};
  }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) override { return cholesky_.solve(rhs); }
  [[nodiscard]] bool sound() const override { return cholesky_.info() == Eigen::Success; }

 private:
  Eigen::CholmodSupernodalLLT<Matrix, Eigen::Lower> cholesky_;
};

class Lu : public DirectFactor {
 public:
  Lu() { use_one_blas_thread(); }
  void factorise(const Matrix& matrix) override {
    kept_ = matrix;  // the library reads it again when it solves
    if (!analysed_) analyse(kept_);
    lu_.factorize(kept_);
  }
  FactorSize analyse(const Matrix& matrix) override {
    lu_.analyzePattern(matrix);
    analysed_ = true;
    return {};  // known only after the factorisation
  }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) override { return lu_.solve(rhs); }
  [[nodiscard]] bool sound() const override { return lu_.info() == Eigen::Success; }

 private:
  Matrix kept_;
  Eigen::UmfPackLU<Matrix> lu_;
};

}  // namespace

}  // namespace scree::thermal

scree::thermal::DirectFactor* scree_make_cholesky() {
  return new scree::thermal::Cholesky;
}

scree::thermal::DirectFactor* scree_make_lu() {
  return new scree::thermal::Lu;
}
