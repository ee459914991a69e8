// What a factorisation asks of BLAS and LAPACK. Matrices stand column by column, `ld` numbers from one column to the next.
#pragma once

namespace scree::thermal {

struct DenseKernels {
  // C = alpha A B^T + beta C; C of `rows` and `columns`, A and B of `inner` columns.
  void (*multiply)(int rows, int columns, int inner, double alpha, const double* a, int a_ld, const double* b, int b_ld,
                   double beta, double* c, int c_ld);
  // The same of A A^T, in the lower triangle of C.
  void (*square)(int rows, int inner, double alpha, const double* a, int a_ld, double beta, double* c, int c_ld);
  // The lower triangle of A = L L^T becomes L. Whether there is one.
  bool (*factorise)(int rows, double* a, int ld);
  // B becomes B L^-T.
  void (*divide)(int rows, int columns, const double* l, int l_ld, double* b, int b_ld);
  // Whether several threads may call them.
  bool at_once;
};

}  // namespace scree::thermal
