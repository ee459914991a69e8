// Bullet's sequential-impulse solver, starting from the friction of the last step as well as from its normal impulses.
#pragma once

#include <vector>

#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>

#include "engine/rigid/contact_rows.h"

namespace scree::rigid {

// Bullet 3.24 starts every step with no friction, and a pile creeps and sinks for want of it (README.md).
class WarmSolver final : public btSequentialImpulseConstraintSolver {
 protected:
  btScalar solveGroupCacheFriendlySetup(btCollisionObject** bodies, int body_count, btPersistentManifold** manifolds,
                                        int manifold_count, btTypedConstraint** constraints, int constraint_count,
                                        const btContactSolverInfo& info, btIDebugDraw* draw) override;
  btScalar solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int body_count, btPersistentManifold** manifolds,
                                             int manifold_count, btTypedConstraint** constraints, int constraint_count,
                                             const btContactSolverInfo& info, btIDebugDraw* draw) override;

 private:
  std::vector<ContactRow> rows_;  // kept for their memory
};

}  // namespace scree::rigid
