// What the matrix of Newton's iteration was made from. It serves for several steps, so a run that goes on from a file needs it.
#pragma once

#include <Eigen/Core>

namespace scree::thermal {

struct MatrixOrigin {
  Eigen::VectorXd temperature;  // one per row of the model [K]; empty if there is no such matrix
  double time = 0;              // [s]
  double scale = 0;             // of J beside C [s]
};

}  // namespace scree::thermal
