#include "engine/rigid/polyhedron_shape.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace scree::rigid {

namespace {

// Least extent along the normal of one of its faces [m].
double thickness_of(const mesh::ConvexPiece& piece) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& face : piece.faces) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto& vertex : piece.vertices) {
      const double height = face.normal.dot(vertex);
      low = std::min(low, height);
      high = std::max(high, height);
    }
    least = std::min(least, high - low);
  }
  return least;
}

}  // namespace

PolyhedronShape::PolyhedronShape(mesh::ConvexPiece piece) : piece_(std::move(piece)), thickness_(thickness_of(piece_)) {
  m_shapeType = CUSTOM_CONVEX_SHAPE_TYPE;
  setMargin(0);
  for (const auto& vertex : piece_.vertices) radius_ = std::max(radius_, vertex.norm());
}

void PolyhedronShape::getAabb(const btTransform& pose, btVector3& low, btVector3& high) const {
  low = high = pose(to_bullet(piece_.vertices.front()));
  for (const auto& vertex : piece_.vertices) {
    const btVector3 at = pose(to_bullet(vertex));
    low.setMin(at);
    high.setMax(at);
  }
}

btVector3 PolyhedronShape::localGetSupportingVertexWithoutMargin(const btVector3& direction) const {
  const Eigen::Vector3d along = from_bullet(direction);
  return to_bullet(*std::max_element(piece_.vertices.begin(), piece_.vertices.end(),
                                     [&](const auto& a, const auto& b) { return a.dot(along) < b.dot(along); }));
}

void PolyhedronShape::batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3* directions, btVector3* vertices,
                                                                        int count) const {
  for (int i = 0; i < count; ++i) vertices[i] = localGetSupportingVertexWithoutMargin(directions[i]);
}

void PolyhedronShape::calculateLocalInertia(btScalar mass, btVector3& inertia) const {
  inertia.setValue(1, 1, 1);
  inertia *= mass * radius_ * radius_;
}

CompoundShape::CompoundShape(const std::vector<std::unique_ptr<PolyhedronShape>>& pieces,
                             std::vector<std::vector<Eigen::Vector3d>> surface_edges)
    : surface_edges_(std::move(surface_edges)) {
  for (const auto& piece : pieces) {
    addChildShape(btTransform::getIdentity(), piece.get());
    radius_ = std::max(radius_, piece->radius());
  }
}

// Of a surface that is curved inwards, or met at a small angle, each node has a neighbour that is a little further.
bool CompoundShape::stands_out(std::int32_t node, const Eigen::Vector3d& direction) const {
  constexpr double a_little = 0.2;
  const auto& edges = surface_edges_[static_cast<std::size_t>(node)];
  return !edges.empty() &&
         std::all_of(edges.begin(), edges.end(), [&](const Eigen::Vector3d& edge) { return edge.dot(direction) < a_little; });
}

double radius_of(const btCollisionShape& shape) {
  return shape.isCompound() ? static_cast<const CompoundShape&>(shape).radius()
                            : static_cast<const PolyhedronShape&>(shape).radius();
}

}  // namespace scree::rigid
