// Whether what a matrix was made of has changed so little that the matrix still serves.
#pragma once

#include <Eigen/Core>

namespace scree::thermal {

// Whether no entry of `now` is further from that of `before` than this share of it; of positive ones, one by one.
inline bool little_changed(const Eigen::VectorXd& now, const Eigen::VectorXd& before, double share) {
  return ((now - before).array().abs() <= share * before.array()).all();
}

}  // namespace scree::thermal
