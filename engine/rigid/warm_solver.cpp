#include "engine/rigid/warm_solver.h"

#include <algorithm>
#include <vector>

#include "engine/rigid/contact_rows.h"
#include "engine/rigid/polyhedron_shape.h"

namespace scree::rigid {

namespace {

void apply(btSolverBody& body, const btVector3& normal, const btVector3& angular, btScalar impulse) {
  if (body.m_originalBody != nullptr) body.internalApplyImpulse(normal * body.internalGetInvMass(), angular, impulse);
}

Row row_of(const btSolverConstraint& constraint, double wanted, double applied) {
  Row row;
  // Of a fixed body Bullet keeps no direction.
  const bool first = constraint.m_contactNormal1.length2() > 0;
  row.direction = first ? from_bullet(constraint.m_contactNormal1) : Eigen::Vector3d(-from_bullet(constraint.m_contactNormal2));
  row.moment = {from_bullet(constraint.m_relpos1CrossNormal), from_bullet(constraint.m_relpos2CrossNormal)};
  row.turn = {from_bullet(constraint.m_angularComponentA), from_bullet(constraint.m_angularComponentB)};
  row.wanted = wanted;
  row.softness = constraint.m_cfm;
  row.scale = constraint.m_jacDiagABInv;
  row.applied = applied;
  return row;
}

Row row_of(const btSolverConstraint& constraint) {
  return row_of(constraint, constraint.m_rhs, constraint.m_appliedImpulse);
}

using SolverBodies = btAlignedObjectArray<btSolverBody>;

std::array<int, 2> bodies_of(const btSolverConstraint& constraint, const SolverBodies& bodies) {
  const auto id = [&](int body) { return bodies[body].m_originalBody == nullptr ? -1 : body; };
  return {id(constraint.m_solverBodyIdA), id(constraint.m_solverBodyIdB)};
}

// Takes the overlaps apart without giving the bodies velocity.
void undo_overlaps(const btConstraintArray& contacts, int iterations, SolverBodies& bodies) {
  std::vector<OverlapRow> rows;
  std::vector<BodyChange> changes(bodies.size());
  for (int i = 0; i < contacts.size(); ++i) {
    if (contacts[i].m_rhsPenetration == 0) continue;
    const double applied = contacts[i].m_appliedPushImpulse;
    rows.push_back({row_of(contacts[i], contacts[i].m_rhsPenetration, applied), bodies_of(contacts[i], bodies)});
  }
  if (rows.empty()) return;
  for (int i = 0; i < bodies.size(); ++i) changes[i].inverse_mass = bodies[i].m_invMass.x();
  for (int i = 0; i < iterations; ++i) solve_overlaps(rows, changes);
  for (int i = 0; i < bodies.size(); ++i) {
    bodies[i].internalGetPushVelocity() = to_bullet(changes[i].linear);
    bodies[i].internalGetTurnVelocity() = to_bullet(changes[i].angular);
  }
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

// The parameters are Bullet's. NOLINTNEXTLINE(readability-function-size)
btScalar WarmSolver::solveGroupCacheFriendlyIterations(btCollisionObject** /*bodies*/, int /*body_count*/,
                                                       btPersistentManifold** /*manifolds*/, int /*manifold_count*/,
                                                       btTypedConstraint** /*constraints*/, int /*constraint_count*/,
                                                       const btContactSolverInfo& info, btIDebugDraw* /*draw*/) {
  btConstraintArray& contacts = m_tmpSolverContactConstraintPool;
  btConstraintArray& frictions = m_tmpSolverContactFrictionConstraintPool;
  undo_overlaps(contacts, info.m_numIterations, m_tmpSolverBodyPool);
  rows_.resize(contacts.size());
  for (int i = 0; i < contacts.size(); ++i) {
    const btSolverConstraint& contact = contacts[i];
    rows_[i] = {row_of(contact),
                {row_of(frictions[contact.m_frictionIndex]), row_of(frictions[contact.m_frictionIndex + 1])},
                contact.m_friction,
                bodies_of(contact, m_tmpSolverBodyPool)};
  }
  std::vector<BodyChange> changes(m_tmpSolverBodyPool.size());
  for (std::size_t i = 0; i < changes.size(); ++i) {
    btSolverBody& body = m_tmpSolverBodyPool[static_cast<int>(i)];
    changes[i] = {from_bullet(body.internalGetDeltaLinearVelocity()), from_bullet(body.internalGetDeltaAngularVelocity()),
                  body.m_invMass.x()};
  }
  for (int i = 0; i < info.m_numIterations; ++i) solve_contacts(rows_, changes);
  for (std::size_t i = 0; i < changes.size(); ++i) {
    btSolverBody& body = m_tmpSolverBodyPool[static_cast<int>(i)];
    body.internalGetDeltaLinearVelocity() = to_bullet(changes[i].linear);
    body.internalGetDeltaAngularVelocity() = to_bullet(changes[i].angular);
  }
  for (int i = 0; i < contacts.size(); ++i) {
    contacts[i].m_appliedImpulse = rows_[i].normal.applied;
    for (int k = 0; k < 2; ++k) frictions[contacts[i].m_frictionIndex + k].m_appliedImpulse = rows_[i].friction[k].applied;
  }
  return 0;
}

}  // namespace scree::rigid
