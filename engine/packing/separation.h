// How far two convex polyhedra are apart, or how deep one is in the other.
#pragma once

#include <functional>
#include <vector>

#include "engine/mesh/convex_pieces.h"

namespace scree::packing {

// A convex piece where it is now.
struct PlacedPiece {
  const mesh::ConvexPiece* piece = nullptr;
  std::vector<Eigen::Vector3d> vertices;  // [m]
  std::vector<Eigen::Vector3d> normals;   // of the faces
  // Of four faces each the normals' x, y and z, and how far along its normal each face lies [m]; zeros behind the last one.
  std::vector<double> by_fours;
};

PlacedPiece placed(const mesh::ConvexPiece& piece, const Pose& pose);
// Into the memory of an earlier one.
void place(const mesh::ConvexPiece& piece, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation,
           PlacedPiece& result);

PlacedPiece shifted(PlacedPiece piece, const Eigen::Vector3d& by);

// The plane that parts two pieces best, or through which the deeper is pushed out soonest.
struct Separation {
  enum class Feature { face_of_first, face_of_second, edges };
  // Along `normal` [m]: negative is the depth of the overlap (the least translation that ends it), positive a lower bound of
  // the distance, exact where a face takes part.
  double distance = 0;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // from the first to the second, unit
  Feature feature = Feature::face_of_first;
  std::int32_t of_first = 0;  // number of the face or edge
  std::int32_t of_second = 0;
};

// Separating axes: the face normals of both, and those edge pairs that make a face of the Minkowski difference (their arcs on
// the Gauss map cross; Gregorius, "The separating axis test between convex polyhedra", GDC 2013). An edge pair is preferred to
// a face only if it is better by `face_bias` [m]; 0 gives the exact answer. Stops at the first axis with more than `enough`
// [m].
Separation separation(const PlacedPiece& first, const PlacedPiece& second, double enough, double face_bias = 0);

// The best of those features for which `allowed` holds; a distance of minus infinity if there is none.
Separation separation_by(const PlacedPiece& first, const PlacedPiece& second, double face_bias,
                         const std::function<bool(const Separation&)>& allowed);

// The same along the feature found earlier, at the pieces' present places.
double separation_along(const PlacedPiece& first, const PlacedPiece& second, const Separation& earlier);

}  // namespace scree::packing
