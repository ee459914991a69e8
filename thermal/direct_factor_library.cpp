#include <dlfcn.h>

#include <Eigen/CholmodSupport>

#include "thermal/direct_factor.h"

// BLAS and LAPACK, which have no header of their own in C++.
extern "C" {
void dgemm_(const char*, const char*, const int*, const int*, const int*, const double*, const double*, const int*,
            const double*, const int*, const double*, double*, const int*);
void dsyrk_(const char*, const char*, const int*, const int*, const double*, const double*, const int*, const double*, double*,
            const int*);
void dpotrf_(const char*, const int*, double*, const int*, int*);
void dtrsm_(const char*, const char*, const char*, const char*, const int*, const int*, const double*, const double*,
            const int*, double*, const int*);
}

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

void multiply(int rows, int columns, int inner, double alpha, const double* a, int a_ld, const double* b, int b_ld, double beta,
              double* c, int c_ld) {
  dgemm_("N", "T", &rows, &columns, &inner, &alpha, a, &a_ld, b, &b_ld, &beta, c, &c_ld);
}

void square(int rows, int inner, double alpha, const double* a, int a_ld, double beta, double* c, int c_ld) {
  dsyrk_("L", "N", &rows, &inner, &alpha, a, &a_ld, &beta, c, &c_ld);
}

bool factorise(int rows, double* a, int ld) {
  int failed = 0;
  dpotrf_("L", &rows, a, &ld, &failed);
  return failed == 0;
}

void divide(int rows, int columns, const double* l, int l_ld, double* b, int b_ld) {
  constexpr double one = 1;
  dtrsm_("R", "L", "T", "N", &rows, &columns, &one, l, &l_ld, b, &b_ld);
}

// Eigen's interface to CHOLMOD keeps the factor to itself and to what is made of it.
class Supernodes : public Eigen::CholmodSupernodalLLT<DirectFactor::Matrix, Eigen::Lower> {
 public:
  [[nodiscard]] const cholmod_factor& factor() const { return *m_cholmodFactor; }
};

class Cholmod : public CholeskyAnalysis {
 public:
  Cholmod() {
    use_one_blas_thread();
    // Nested dissection of CHOLMOD's own, by METIS' bisections. METIS' takes SIGTERM for itself meanwhile, and jumps out of its
    // work with it, whichever thread it comes to.
    cholesky_.cholmod().default_nesdis = 1;
    cholesky_.cholmod().print = 0;  // failures are ours to report
  }
  FactorSize analyse(const Matrix& matrix) override {
    cholesky_.analyzePattern(matrix);
    if (cholesky_.cholmod().status != CHOLMOD_OK) return {.possible = false};
    return {static_cast<double>(cholesky_.factor().xsize), cholesky_.cholmod().fl, true};
  }
  [[nodiscard]] SupernodalPattern pattern() const override {
    const cholmod_factor& factor = cholesky_.factor();
    const auto integers = [](const void* array) { return static_cast<const int*>(array); };
    return {static_cast<int>(factor.n), static_cast<int>(factor.nsuper),
            integers(factor.super),     integers(factor.pi),
            integers(factor.s),         integers(factor.px),
            integers(factor.Perm)};
  }
  [[nodiscard]] DenseKernels kernels() const override {
    return {multiply, square, thermal::factorise, divide, blas_may_be_called_at_once()};
  }

 private:
  Supernodes cholesky_;
};

}  // namespace

}  // namespace scree::thermal

scree::thermal::CholeskyAnalysis* scree_make_cholesky() {
  return new scree::thermal::Cholmod;
}
