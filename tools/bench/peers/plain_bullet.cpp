#include "tools/bench/peers/plain_bullet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>
#include <btBulletDynamicsCommon.h>

#include "engine/rigid/mass_properties.h"

// Bullet's global length, without a declaration in its headers.
extern btScalar gDbvtMargin;

namespace scree::bench {

namespace {

constexpr int iterations = 20;
constexpr double margin = 1e-4;  // [m]
constexpr double near = 1e-3;    // [m]
constexpr double gravity = 9.81;

btVector3 to_bullet(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

// Bullet's solver, which forgets friction from step to step, reminded of it.
class FrictionSolver final : public btSequentialImpulseConstraintSolver {
 protected:
  // Bullet's parameters. NOLINTNEXTLINE(readability-function-size)
  btScalar solveGroupCacheFriendlySetup(btCollisionObject** bodies, int body_count, btPersistentManifold** manifolds,
                                        int manifold_count, btTypedConstraint** constraints, int constraint_count,
                                        const btContactSolverInfo& info, btIDebugDraw* draw) override {
    const btScalar result = btSequentialImpulseConstraintSolver::solveGroupCacheFriendlySetup(
        bodies, body_count, manifolds, manifold_count, constraints, constraint_count, info, draw);
    for (int i = 0; i < m_tmpSolverContactConstraintPool.size(); ++i) remind(m_tmpSolverContactConstraintPool[i]);
    return result;
  }

 private:
  void remind(const btSolverConstraint& contact) {
    const auto& point = *static_cast<const btManifoldPoint*>(contact.m_originalContactPoint);
    const btScalar limit = contact.m_friction * contact.m_appliedImpulse;
    const btScalar last[2] = {point.m_appliedImpulseLateral1, point.m_appliedImpulseLateral2};
    for (int direction = 0; direction < 2; ++direction) {
      btSolverConstraint& friction = m_tmpSolverContactFrictionConstraintPool[contact.m_frictionIndex + direction];
      friction.m_appliedImpulse = std::clamp(last[direction], -limit, limit);
      start(friction.m_solverBodyIdA, friction.m_contactNormal1, friction.m_angularComponentA, friction.m_appliedImpulse);
      start(friction.m_solverBodyIdB, friction.m_contactNormal2, friction.m_angularComponentB, friction.m_appliedImpulse);
    }
  }

  void start(int id, const btVector3& normal, const btVector3& angular, btScalar impulse) {
    btSolverBody& body = m_tmpSolverBodyPool[id];
    if (body.m_originalBody != nullptr) body.internalApplyImpulse(normal * body.internalGetInvMass(), angular, impulse);
  }
};

struct Body {
  std::unique_ptr<btCollisionShape> shape;
  std::unique_ptr<btRigidBody> body;
  Eigen::Vector3d centre;  // where it was meshed [m]
};

std::unique_ptr<btCollisionShape> hull_of(const mesh::BlockMesh<3>& mesh, const mesh::Block& block,
                                          const Eigen::Vector3d& centre) {
  auto hull = std::make_unique<btConvexHullShape>();
  hull->setMargin(margin);  // before the points: the box that Bullet keeps has the margin of that time
  for (const NodeId node : block.nodes) hull->addPoint(to_bullet(mesh.nodes[node] - centre));
  return hull;
}

// Of what is fixed, all of which is boxes here.
std::unique_ptr<btCollisionShape> box_of(const mesh::BlockMesh<3>& mesh, const mesh::Block& block) {
  Aabb<3> box;
  for (const NodeId node : block.nodes) box.extend(mesh.nodes[node]);
  auto shape = std::make_unique<btBoxShape>(to_bullet(box.sizes() / 2));
  shape->setMargin(margin);
  return shape;
}

class PlainWorld {
 public:
  PlainWorld(const mesh::BlockMesh<3>& mesh, double density, double friction)
      : dispatcher_(&configuration_), world_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
    gDbvtMargin = near;
    gContactBreakingThreshold = near;
    dispatcher_.setDispatcherFlags(dispatcher_.getDispatcherFlags() &
                                   ~btCollisionDispatcher::CD_USE_RELATIVE_CONTACT_BREAKING_THRESHOLD);
    btContactSolverInfo& info = world_.getSolverInfo();
    info.m_numIterations = iterations;
    info.m_solverMode = SOLVER_USE_WARMSTARTING | SOLVER_USE_2_FRICTION_DIRECTIONS | SOLVER_ENABLE_FRICTION_DIRECTION_CACHING |
                        SOLVER_DISABLE_VELOCITY_DEPENDENT_FRICTION_DIRECTION |
                        SOLVER_INTERLEAVE_CONTACT_AND_FRICTION_CONSTRAINTS;
    info.m_warmstartingFactor = 1;
    info.m_splitImpulse = 1;
    info.m_splitImpulsePenetrationThreshold = 0;
    world_.setGravity({0, 0, -gravity});
    for (const BlockId block : mesh.blocks.ids()) add(mesh, block, density, friction);
  }

  ~PlainWorld() {
    for (Body& body : bodies_) world_.removeRigidBody(body.body.get());
  }
  PlainWorld(const PlainWorld&) = delete;
  PlainWorld& operator=(const PlainWorld&) = delete;

  // Moves the free blocks down by the clear height; how long they would have fallen [s].
  double skip_fall(double height) {
    const double time = std::floor(std::sqrt(2 * height / gravity) / plain_step) * plain_step;
    for (Body& body : bodies_) {
      if (body.body->getInvMass() == 0) continue;
      body.body->translate({0, 0, -gravity * time * time / 2});
      body.body->setLinearVelocity({0, 0, -gravity * time});
      // Or the boxes of the first step reach back to where the fall began, and millions of pairs overlap.
      body.body->setInterpolationWorldTransform(body.body->getWorldTransform());
      body.body->setInterpolationLinearVelocity(body.body->getLinearVelocity());
    }
    return time;
  }

  void advance() { world_.stepSimulation(plain_step, 0); }

  [[nodiscard]] double rms_speed() const {
    double squares = 0, count = 0;
    for (const Body& body : bodies_) {
      if (body.body->getInvMass() == 0) continue;
      squares += body.body->getLinearVelocity().length2();
      ++count;
    }
    return std::sqrt(squares / count);
  }

  [[nodiscard]] Table<BlockId, Pose> poses() const {
    Table<BlockId, Pose> all;
    for (const Body& body : bodies_) {
      const btTransform at = body.body->getWorldTransform();
      const btQuaternion q = at.getRotation();
      const Eigen::Quaterniond rotation(q.w(), q.x(), q.y(), q.z());
      const Eigen::Vector3d origin(at.getOrigin().x(), at.getOrigin().y(), at.getOrigin().z());
      all.push_back({origin - rotation * body.centre, rotation});
    }
    return all;
  }

 private:
  void add(const mesh::BlockMesh<3>& mesh, BlockId id, double density, double friction) {
    const mesh::Block& block = mesh.blocks[id];
    const bool fixed = mesh.bodies[block.body].fixed;
    const rigid::MassProperties properties = rigid::mass_properties(mesh, id, density);
    Body& made = bodies_.emplace_back();
    made.centre = properties.centre;
    made.shape = fixed ? box_of(mesh, block) : hull_of(mesh, block, properties.centre);
    btVector3 inertia(0, 0, 0);
    if (!fixed) made.shape->calculateLocalInertia(properties.mass, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(fixed ? 0 : properties.mass, nullptr, made.shape.get(), inertia);
    info.m_startWorldTransform.setOrigin(to_bullet(properties.centre));
    info.m_friction = std::sqrt(friction);  // Bullet multiplies the two
    made.body = std::make_unique<btRigidBody>(info);
    made.body->setActivationState(DISABLE_DEACTIVATION);
    world_.addRigidBody(made.body.get());
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  FrictionSolver solver_;
  btDiscreteDynamicsWorld world_;
  std::vector<Body> bodies_;  // one per block
};

// Between the lowest free and the highest fixed node [m].
double clear_height(const mesh::BlockMesh<3>& mesh) {
  double free = std::numeric_limits<double>::infinity(), fixed = -free;
  for (const mesh::Block& block : mesh.blocks) {
    for (const NodeId node : block.nodes) {
      const double z = mesh.nodes[node].z();
      mesh.bodies[block.body].fixed ? fixed = std::max(fixed, z) : free = std::min(free, z);
    }
  }
  return free - fixed;
}

}  // namespace

PlainFall plain_fall(const mesh::BlockMesh<3>& mesh, double density, double friction, double time) {
  PlainWorld world(mesh, density, friction);
  PlainFall fall;
  fall.time = world.skip_fall(std::max(0.0, clear_height(mesh) - 2e-3));
  for (; fall.time < time - plain_step / 2; fall.time += plain_step) world.advance();
  fall.rms_speed = world.rms_speed();
  fall.packing = packing::unmoved(mesh);
  fall.packing.poses = world.poses();
  return fall;
}

}  // namespace scree::bench
