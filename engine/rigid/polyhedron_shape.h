// Blocks as Bullet's broad phase sees them: custom convex shapes without margin, or compounds of such.
#pragma once

#include <memory>
#include <vector>

#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConvexInternalShape.h>

#include "engine/mesh/convex_pieces.h"

namespace scree::rigid {

inline btVector3 to_bullet(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}
inline Eigen::Vector3d from_bullet(const btVector3& v) {
  return {v.x(), v.y(), v.z()};
}
inline Eigen::Matrix3d from_bullet(const btMatrix3x3& m) {
  Eigen::Matrix3d result;
  for (int i = 0; i < 3; ++i) result.row(i) = from_bullet(m[i]).transpose();
  return result;
}

class PolyhedronShape final : public btConvexInternalShape {
 public:
  explicit PolyhedronShape(mesh::ConvexPiece piece);

  [[nodiscard]] const mesh::ConvexPiece& piece() const { return piece_; }
  // Of the smallest sphere about the origin that holds the piece [m].
  [[nodiscard]] double radius() const { return radius_; }
  // Least extent of the piece along the normal of one of its faces [m].
  [[nodiscard]] double thickness() const { return thickness_; }

  void getAabb(const btTransform& pose, btVector3& low, btVector3& high) const override;
  btVector3 localGetSupportingVertexWithoutMargin(const btVector3& direction) const override;
  void batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3* directions, btVector3* vertices,
                                                         int count) const override;
  // Never asked: inertia comes from the tetrahedra (mass_properties.h).
  void calculateLocalInertia(btScalar mass, btVector3& inertia) const override;
  [[nodiscard]] const char* getName() const override { return "Polyhedron"; }

 private:
  mesh::ConvexPiece piece_;
  double thickness_;
  double radius_ = 0;
};

// A block of several pieces, which all have its frame and must outlive it.
class CompoundShape final : public btCompoundShape {
 public:
  // With the edges of its surface as by mesh::surface_edges, in its frame.
  CompoundShape(const std::vector<std::unique_ptr<PolyhedronShape>>& pieces,
                std::vector<std::vector<Eigen::Vector3d>> surface_edges);

  [[nodiscard]] double radius() const { return radius_; }
  // Whether none of the surface's edges leads from the node further in this direction.
  [[nodiscard]] bool stands_out(std::int32_t node, const Eigen::Vector3d& direction) const;

 private:
  double radius_ = 0;
  std::vector<std::vector<Eigen::Vector3d>> surface_edges_;
};

// Of the smallest sphere about the origin that holds a shape of these two kinds [m].
double radius_of(const btCollisionShape& shape);

}  // namespace scree::rigid
