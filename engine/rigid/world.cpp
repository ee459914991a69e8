#include "engine/rigid/world.h"

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <iterator>
#include <span>

#include "engine/base/check.h"
#include "engine/base/phases.h"
#include "engine/mesh/disjoint_sets.h"
#include "engine/rigid/bullet_pose.h"
#include "engine/rigid/collision_configuration.h"
#include "engine/rigid/contact_solver.h"
#include "engine/rigid/dispatcher.h"
#include "engine/rigid/free_rotation.h"
#include "engine/rigid/mass_properties.h"
#include "engine/rigid/pair_cache.h"
#include "engine/rigid/polyhedron_collision.h"
#include "engine/rigid/sleepers.h"

// Bullet's global lengths; the first has no declaration in its headers.
extern btScalar gDbvtMargin;

namespace scree::rigid {

namespace {

// Part of an overlap that is undone in a step.
constexpr double overlap_undone = 0.2;

mesh::ConvexPiece placed_by(const Pose& by, mesh::ConvexPiece piece) {
  for (auto& vertex : piece.vertices) vertex = by * vertex;
  for (auto& face : piece.faces) face.normal = by.rotation * face.normal;
  for (auto& edge : piece.edges) {
    for (auto& normal : edge.beside) normal = by.rotation * normal;
  }
  return piece;
}

// Of the body on its way through the step, and as far around it.
std::array<btVector3, 2> swept_box(const btCollisionObject& body, double around) {
  const btVector3 margin(around, around, around);
  std::array<btVector3, 2> box, end;
  body.getCollisionShape()->getAabb(body.getWorldTransform(), box[0], box[1]);
  box = {box[0] - margin, box[1] + margin};
  if (body.isStaticObject()) return box;
  body.getCollisionShape()->getAabb(body.getInterpolationWorldTransform(), end[0], end[1]);
  box[0].setMin(end[0] - margin);
  box[1].setMax(end[1] + margin);
  return box;
}

double density_of(const Material& material) {
  if (material.density && *material.density > 0) return *material.density;
  Problem problem;
  problem.key = "materials." + material.name + ".density";
  problem.value = material.density ? std::to_string(*material.density) : "missing";
  problem.rule = "positive, kg/m3";
  problem.suggestion = "A block that falls needs the density of its material.";
  throw InputError(problem);
}

}  // namespace

struct World::Bullet {
  Bullet(const ContactRanges& found_in, const mesh::BlockMesh<3>& mesh, const SettleOptions& options)
      : ranges(found_in),
        configuration(ranges, contacts, static_cast<int>(mesh.blocks.size())),
        flights(mesh, options.release_time > 0),
        homes(mesh.blocks.size(), ranges.home),
        sleepers(mesh.blocks.size()),
        placed(mesh.blocks.size()),
        motions(mesh.blocks.size()),
        dispatcher(configuration, flights, homes, sleepers, motions, placed),
        boxes(mesh.blocks.size()),
        world(&dispatcher, &broadphase, nullptr, &configuration) {
    gDbvtMargin = ranges.near;
    gContactBreakingThreshold = ranges.near;
  }

  ContactRanges ranges;
  HeldContacts contacts;
  CollisionConfiguration configuration;
  Flights flights;
  Homes homes;
  Sleepers sleepers;
  std::vector<packing::PlacedPiece> placed;  // of the blocks, by the dispatcher
  std::vector<BlockMotion> motions;          // of the blocks, as the step begins
  Dispatcher dispatcher;
  PairCache pairs;
  btDbvtBroadphase broadphase{&pairs};
  ContactSolver solver;
  std::vector<std::array<btVector3, 2>> boxes;  // of each block, on its way through the step [m]
  btDiscreteDynamicsWorld world;                // only of its bodies and their pairs; steps are made here

  void observe(const btRigidBody& body) {
    const auto block = static_cast<std::size_t>(body.getUserIndex());
    motions[block] = motion_of(body, placed[block]);
  }
};

struct World::Item {
  std::vector<std::unique_ptr<PolyhedronShape>> pieces;
  std::unique_ptr<CompoundShape> compound;  // of several pieces
  std::unique_ptr<btRigidBody> body;
  Pose frame;  // from the body's axes (centre of mass, principal) to the mesh's
  double mass = 0;
  double radius = 0;
  double size = 0;  // that overlaps are measured by (World::deepest_overlap)
};

World::World(const mesh::BlockMesh<3>& mesh, const Table<MaterialId, Material>& materials, const SettleOptions& options)
    : bullet_(std::make_unique<Bullet>(ranges_for(mesh, options), mesh, options)) {
  bullet_->world.setGravity(to_bullet(options.gravity));
  for (const BlockId block : mesh.blocks.ids())
    add_block(mesh, block, materials[mesh.bodies[mesh.blocks[block].body].material]);
  if (options.release_time > 0) {
    sort_from_the_rim_up(options.gravity);
  } else {
    release(order_.size());
  }
}

void World::add_block(const mesh::BlockMesh<3>& mesh, BlockId block, const Material& material) {
  const mesh::Body& owner = mesh.bodies[mesh.blocks[block].body];
  Item& item = items_.emplace_back();
  btVector3 inertia(0, 0, 0);
  if (!owner.fixed) {
    const MassProperties properties = mass_properties(mesh, block, density_of(material));
    item.frame = {properties.centre, properties.principal};
    item.mass = properties.mass;
    inertia = to_bullet(properties.inertia);
  }
  for (mesh::ConvexPiece& piece : mesh::convex_pieces(mesh, block)) {
    item.pieces.push_back(std::make_unique<PolyhedronShape>(placed_by(inverse(item.frame), std::move(piece))));
  }
  btCollisionShape* shape = item.pieces.front().get();
  if (item.pieces.size() > 1) {
    auto edges = mesh::surface_edges(mesh, block);
    for (auto& of_node : edges) {
      for (auto& edge : of_node) edge = inverse(item.frame).rotation * edge;
    }
    item.compound = std::make_unique<CompoundShape>(item.pieces, std::move(edges));
    shape = item.compound.get();
  }
  item.radius = radius_of(*shape);
  btRigidBody::btRigidBodyConstructionInfo info(item.mass, nullptr, shape, inertia);
  info.m_startWorldTransform = transform_of(item.frame);
  info.m_friction = material.friction;
  info.m_restitution = material.restitution;
  item.size = size_of(mesh, mesh.blocks[block]);
  if (!item.compound) item.size = std::min(item.size, item.pieces.front()->thickness());
  item.body = std::make_unique<btRigidBody>(info);
  item.body->setUserIndex(static_cast<int>(block.index()));
  // Bullet's own sleeping, which asks for speeds only, is not used.
  item.body->setActivationState(DISABLE_DEACTIVATION);
  if (owner.fixed) {
    bullet_->sleepers.fix(item.body->getUserIndex());
    bullet_->observe(*item.body);
    bullet_->world.addRigidBody(item.body.get());
  } else {
    item.body->setLinearVelocity(to_bullet(owner.velocity));
    order_.push_back(block);
  }
}

void World::sort_from_the_rim_up(const Eigen::Vector3d& gravity) {
  const btVector3 up = to_bullet(-gravity.normalized());
  btVector3 centre(0, 0, 0);
  double mass = 0;
  for (const BlockId block : order_) {
    const Item& item = items_[block.index()];
    centre += item.mass * item.body->getCenterOfMassPosition();
    mass += item.mass;
  }
  std::vector<double> rank(items_.size());
  for (const BlockId block : order_) {
    const btVector3 arm = items_[block.index()].body->getCenterOfMassPosition() - centre / mass;
    const double height = arm.dot(up);
    rank[block.index()] = height - (arm - height * up).length();
  }
  std::stable_sort(order_.begin(), order_.end(), [&](BlockId a, BlockId b) { return rank[a.index()] < rank[b.index()]; });
}

void World::release(std::size_t count) {
  for (; released_ < std::min(count, order_.size()); ++released_) {
    const BlockId block = order_[released_];
    free_.push_back(block);
    free_bodies_.push_back(items_[block.index()].body.get());
    bullet_->world.addRigidBody(free_bodies_.back());
  }
}

World::~World() {
  // Bullet would search all pairs for those of each body that it removes.
  btOverlappingPairCache& cache = *bullet_->broadphase.getOverlappingPairCache();
  for (auto& pairs = cache.getOverlappingPairArray(); pairs.size() > 0;) {
    const btBroadphasePair& last = pairs[pairs.size() - 1];
    cache.removeOverlappingPair(last.m_pProxy0, last.m_pProxy1, &bullet_->dispatcher);
  }
  for (Item& item : items_) bullet_->world.removeRigidBody(item.body.get());
}

void World::step(double time_step, int iterations) {
  // Boxes hold the way of the step.
  for_short_chunks(free_bodies_.size(), [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      btRigidBody& body = *free_bodies_[i];
      if (asleep(free_[i])) continue;
      bullet_->observe(body);
      bullet_->homes.look(body, items_[body.getUserIndex()].radius, time_step);
      body.setInterpolationWorldTransform(
          moved(body.getWorldTransform(), body.getLinearVelocity(), body.getAngularVelocity(), time_step));
    }
  });
  find_contacts(time_step);
  if (bullet_->sleepers.count() > 0) wake_what_is_touched();
  bullet_->solver.solve(free_bodies_, bullet_->sleepers, bullet_->motions, bullet_->contacts.all(),
                        {time_step, overlap_undone, bullet_->ranges.bounce_speed, bullet_->ranges.clearance}, iterations);
  for_short_chunks(free_bodies_.size(), [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      if (asleep(free_[i])) continue;
      btRigidBody& body = *free_bodies_[i];
      // The momentum is what stays where the body's axes turn.
      const btVector3 momentum = to_bullet(bullet_->solver.momentum(i));
      if (is_needle(body)) {
        body.setAngularVelocity(body.getInvInertiaTensorWorld() * momentum);
        body.setAngularVelocity(to_bullet(free_rotation(body, time_step).mean));
      }
      body.proceedToTransform(moved(body.getWorldTransform(), body.getLinearVelocity(), body.getAngularVelocity(), time_step));
      body.setAngularVelocity(body.getInvInertiaTensorWorld() * momentum);
    }
  });
}

// As btCollisionWorld::performDiscreteCollisionDetection does it, with the boxes worked out on all threads.
void World::find_contacts(double time_step) {
  btCollisionObjectArray& objects = bullet_->world.getCollisionObjectArray();
  for_short_chunks(static_cast<std::size_t>(objects.size()), [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      const btCollisionObject& object = *objects[static_cast<int>(i)];
      const int block = object.getUserIndex();
      if (!bullet_->sleepers.asleep(block)) bullet_->boxes[block] = swept_box(object, bullet_->ranges.near);
    }
  });
  // Those of sleeping blocks, too, or Bullet would move them to another tree of boxes, and back when they wake.
  for (int i = 0; i < objects.size(); ++i) {
    const auto& [least, largest] = bullet_->boxes[objects[i]->getUserIndex()];
    bullet_->broadphase.setAabb(objects[i]->getBroadphaseHandle(), least, largest, &bullet_->dispatcher);
  }
  bullet_->broadphase.calculateOverlappingPairs(&bullet_->dispatcher);
  bullet_->world.getDispatchInfo().m_timeStep = time_step;
  bullet_->dispatcher.dispatchAllCollisionPairs(&bullet_->pairs, bullet_->world.getDispatchInfo(), &bullet_->dispatcher);
}

void World::wake_what_is_touched() {
  Sleepers& sleepers = bullet_->sleepers;
  for (const HeldContact* contact : bullet_->contacts.all()) {
    const auto [first, second] = contact->blocks;
    if (sleepers.asleep(first) && !sleepers.still(second)) sleepers.wake(first);
    if (sleepers.asleep(second) && !sleepers.still(first)) sleepers.wake(second);
  }
}

std::vector<std::vector<BlockId>> World::touching_groups() const {
  mesh::DisjointSets sets(items_.size());
  for (const HeldContact* contact : bullet_->contacts.all()) {
    const auto [first, second] = contact->blocks;
    if (items_[first].mass == 0 || items_[second].mass == 0) continue;
    sets.join(static_cast<std::size_t>(first), static_cast<std::size_t>(second));
  }
  std::vector<BlockId> awake;
  std::copy_if(free_.begin(), free_.end(), std::back_inserter(awake), [this](BlockId block) { return !asleep(block); });
  std::vector<std::vector<BlockId>> groups;
  for (const auto& members : sets.groups(awake, [&](std::size_t i) { return awake[i].index(); })) {
    std::vector<BlockId>& group = groups.emplace_back();
    for (const std::size_t i : members) group.push_back(awake[i]);
  }
  return groups;
}

void World::put_to_sleep(const std::vector<BlockId>& group) {
  std::vector<int> blocks;
  const btVector3 zero(0, 0, 0);
  for (const BlockId block : group) {
    btRigidBody& body = *items_[block.index()].body;
    body.setLinearVelocity(zero);
    body.setAngularVelocity(zero);
    body.setInterpolationWorldTransform(body.getWorldTransform());
    bullet_->observe(body);
    blocks.push_back(body.getUserIndex());
  }
  bullet_->sleepers.put_to_sleep(blocks);
}

std::size_t World::sleeping() const {
  return bullet_->sleepers.count();
}

bool World::asleep(BlockId block) const {
  return bullet_->sleepers.asleep(block.value());
}

std::size_t World::block_count() const {
  return items_.size();
}

int World::flying() const {
  return bullet_->flights.count();
}

double World::radius(BlockId block) const {
  return items_[block.index()].radius;
}

double World::mass(BlockId block) const {
  return items_[block.index()].mass;
}

Table<BlockId, Pose> World::poses() const {
  Table<BlockId, Pose> result(items_.size());
  for (const BlockId block : result.ids()) {
    const Item& item = items_[block.index()];
    if (item.mass > 0) result[block] = pose_of(item.body->getWorldTransform()) * inverse(item.frame);
  }
  return result;
}

void World::scale_impulses(double factor) {
  for (HeldContact* contact : bullet_->contacts.all()) {
    for (HeldPoint& point : contact->points) {
      for (double& impulse : point.impulses) impulse *= factor;
    }
  }
}

double World::mean_contact_force(double time_step) const {
  double sum = 0;
  double pairs = 0;
  for (const ContactSolver::Touch& touch : bullet_->solver.touches()) {
    if (touch.impulse <= 0) continue;
    sum += touch.impulse / time_step;
    ++pairs;
  }
  return pairs > 0 ? sum / pairs : 0.0;
}

double World::deepest_overlap() const {
  double deepest = 0;
  for (const ContactSolver::Touch& touch : bullet_->solver.touches()) {
    if (touch.depth <= 0) continue;
    deepest = std::max(deepest, touch.depth / std::min(items_[touch.blocks[0]].size, items_[touch.blocks[1]].size));
  }
  return deepest;
}

void World::translate_free(const Eigen::Vector3d& way, const Eigen::Vector3d& velocity) {
  for (btRigidBody* body : free_bodies_) {
    body->translate(to_bullet(way));
    body->setInterpolationWorldTransform(body->getWorldTransform());
    body->setLinearVelocity(to_bullet(velocity));
    body->setInterpolationLinearVelocity(to_bullet(velocity));
  }
}

void World::remove(BlockId block) {
  for (std::size_t i = 0; i < free_.size(); ++i) {
    if (free_[i] != block) continue;
    bullet_->world.removeRigidBody(free_bodies_[i]);
    free_.erase(free_.begin() + static_cast<std::ptrdiff_t>(i));
    free_bodies_.erase(free_bodies_.begin() + static_cast<std::ptrdiff_t>(i));
    return;
  }
}

}  // namespace scree::rigid
