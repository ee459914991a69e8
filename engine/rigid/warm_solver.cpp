#include "engine/rigid/warm_solver.h"

#include <algorithm>

namespace scree::rigid {

namespace {

void apply(btSolverBody& body, const btVector3& normal, const btVector3& angular, btScalar impulse) {
  if (body.m_originalBody != nullptr) body.internalApplyImpulse(normal * body.internalGetInvMass(), angular, impulse);
}

}  // namespace

// The parameters are Bullet's. NOLINTNEXTLINE(readability-function-size)
btScalar WarmSolver::solveGroupCacheFriendlySetup(btCollisionObject** bodies, int body_count, btPersistentManifold** manifolds,
                                                  int manifold_count, btTypedConstraint** constraints, int constraint_count,
                                                  const btContactSolverInfo& info, btIDebugDraw* draw) {
  const btScalar result = btSequentialImpulseConstraintSolver::solveGroupCacheFriendlySetup(
      bodies, body_count, manifolds, manifold_count, constraints, constraint_count, info, draw);
  for (int i = 0; i < m_tmpSolverContactConstraintPool.size(); ++i) {
    const btSolverConstraint& contact = m_tmpSolverContactConstraintPool[i];
    const auto& point = *static_cast<const btManifoldPoint*>(contact.m_originalContactPoint);
    const btScalar limit = contact.m_friction * contact.m_appliedImpulse;
    const btScalar last[2] = {point.m_appliedImpulseLateral1, point.m_appliedImpulseLateral2};
    for (int direction = 0; direction < 2; ++direction) {
      btSolverConstraint& friction = m_tmpSolverContactFrictionConstraintPool[contact.m_frictionIndex + direction];
      friction.m_appliedImpulse = std::clamp(last[direction], -limit, limit);
      apply(m_tmpSolverBodyPool[friction.m_solverBodyIdA], friction.m_contactNormal1, friction.m_angularComponentA,
            friction.m_appliedImpulse);
      apply(m_tmpSolverBodyPool[friction.m_solverBodyIdB], friction.m_contactNormal2, friction.m_angularComponentB,
            friction.m_appliedImpulse);
    }
  }
  return result;
}

}  // namespace scree::rigid
