#include <dlfcn.h>
#include <omp.h>

#include <memory>

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

// OpenBLAS made for a single thread hands the same memory to two that call it.
bool blas_may_be_called_at_once() {
  using Parallel = int (*)();
  const auto parallel = reinterpret_cast<Parallel>(dlsym(RTLD_DEFAULT, "openblas_get_parallel"));
  return parallel == nullptr || parallel() != 0;
}

// CHOLMOD has loops of its own on four threads, however many are asked for, which spin on two processors and gain nothing.
class OneOpenMpThread {
 public:
  OneOpenMpThread() { omp_set_max_active_levels(0); }
  ~OneOpenMpThread() { omp_set_max_active_levels(levels_); }
  OneOpenMpThread(const OneOpenMpThread&) = delete;
  OneOpenMpThread& operator=(const OneOpenMpThread&) = delete;

 private:
  int levels_ = omp_get_max_active_levels();
};

// Eigen's interface to CHOLMOD keeps the factor to itself and to what is made of it.
class Supernodes : public Eigen::CholmodSupernodalLLT<DirectFactor::Matrix, Eigen::Lower> {
 public:
  [[nodiscard]] const cholmod_factor& factor() const { return *m_cholmodFactor; }
  double* make_room() {
    constexpr int yes = 1;  // L L^T, by supernodes, both of which it is by the analysis; packed and in order say nothing then
    cholmod_change_factor(CHOLMOD_REAL, yes, yes, yes, yes, m_cholmodFactor, &cholmod());
    return static_cast<double*>(m_cholmodFactor->x);
  }
  void take_analysis(const Supernodes& other) {
    m_cholmodFactor = cholmod_copy_factor(other.m_cholmodFactor, &cholmod());
    m_isInitialized = m_cholmodFactor != nullptr;
    m_analysisIsOk = m_isInitialized;
    m_info = m_isInitialized ? Eigen::Success : Eigen::NumericalIssue;
  }
};

class Cholmod : public CholeskyFactor {
 public:
  Cholmod() {
    use_one_blas_thread();
    cholesky_.cholmod().print = 0;  // failures are ours to report
  }
  FactorSize analyse(const Matrix& matrix) override {
    cholesky_.analyzePattern(matrix);
    if (cholesky_.cholmod().status != CHOLMOD_OK) return {.possible = false};
    return {static_cast<double>(cholesky_.factor().xsize), cholesky_.cholmod().fl, true};
  }
  void factorise(const Matrix& matrix) override {
    const OneOpenMpThread alone;
    cholesky_.factorize(matrix);
  }
  [[nodiscard]] bool sound() const override { return cholesky_.info() == Eigen::Success; }
  double* make_room() override { return cholesky_.make_room(); }
  [[nodiscard]] SupernodalPattern pattern() const override {
    const cholmod_factor& factor = cholesky_.factor();
    const auto integers = [](const void* array) { return static_cast<const int*>(array); };
    return {static_cast<int>(factor.n), static_cast<int>(factor.nsuper),
            integers(factor.super),     integers(factor.pi),
            integers(factor.s),         integers(factor.px),
            integers(factor.Perm)};
  }
  [[nodiscard]] CholeskyFactor* another() const override {
    if (!blas_may_be_called_at_once()) return nullptr;
    auto copy = std::make_unique<Cholmod>();
    copy->cholesky_.take_analysis(cholesky_);
    return copy->sound() ? copy.release() : nullptr;
  }

 private:
  Supernodes cholesky_;
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
  bool analysed_ = false;
  Matrix kept_;
  Eigen::UmfPackLU<Matrix> lu_;
};

}  // namespace

}  // namespace scree::thermal

scree::thermal::CholeskyFactor* scree_make_cholesky() {
  return new scree::thermal::Cholmod;
}

scree::thermal::DirectFactor* scree_make_lu() {
  return new scree::thermal::Lu;
}
