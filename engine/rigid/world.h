// The blocks as Bullet's rigid bodies.
#pragma once

#include <memory>
#include <vector>

#include "engine/base/material.h"
#include "engine/mesh/convex_pieces.h"
#include "engine/rigid/settle.h"

class btRigidBody;

namespace scree::rigid {

class World {
 public:
  World(const mesh::BlockMesh<3>& mesh, const Table<MaterialId, Material>& materials, const SettleOptions& options);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  // One step of collision detection, contact solution and integration.
  void step(double time_step, int iterations);

  // Fits the contact impulses the next step starts from to a time step changed by `factor`.
  void scale_impulses(double factor);
  // Lets go the next of the blocks that still hang, until `count` were let go in all.
  void release(std::size_t count);
  [[nodiscard]] std::size_t hanging() const { return order_.size() - released_; }
  [[nodiscard]] std::size_t movable() const { return order_.size(); }  // whether let go or not
  [[nodiscard]] std::size_t block_count() const;
  [[nodiscard]] int flying() const;  // bodies whose blocks still fly as one (flights.h)

  // The groups into which those of the free blocks that are awake fall if blocks that touch belong together.
  [[nodiscard]] std::vector<std::vector<BlockId>> touching_groups() const;
  // Keeps blocks that touch each other and no other free block where they are, as if they were fixed, until another block
  // touches one of them.
  void put_to_sleep(const std::vector<BlockId>& group);
  [[nodiscard]] bool asleep(BlockId block) const;
  [[nodiscard]] std::size_t sleeping() const;  // blocks

  // The free blocks that were let go and are still in the scene, and their bodies in the same order.
  [[nodiscard]] const std::vector<BlockId>& free_blocks() const { return free_; }
  [[nodiscard]] const std::vector<btRigidBody*>& free_bodies() const { return free_bodies_; }
  [[nodiscard]] double radius(BlockId block) const;  // of the smallest sphere about its centre that holds it [m]
  [[nodiscard]] double mass(BlockId block) const;    // [kg]
  [[nodiscard]] Table<BlockId, Pose> poses() const;
  // Mean over the touching pairs of the magnitude of the contact force of the last step [N].
  [[nodiscard]] double mean_contact_force(double time_step) const;

  // Of all touching pairs in the last step, over the size of the smaller block: the cube root of its volume, or of a convex one
  // the least extent along the normal of a face, if that is less. 0 if none overlaps [-].
  [[nodiscard]] double deepest_overlap() const;

  // Moves all free blocks by the same way and gives them the same velocity.
  void translate_free(const Eigen::Vector3d& way, const Eigen::Vector3d& velocity);
  // Takes a block out of the scene and keeps it where it is.
  void remove(BlockId block);

 private:
  struct Bullet;
  struct Item;
  void sort_from_the_rim_up(const Eigen::Vector3d& gravity);
  void find_contacts(double time_step);
  void wake_what_is_touched();
  void add_block(const mesh::BlockMesh<3>& mesh, BlockId block, const Material& material);

  std::vector<Item> items_;         // one per block
  std::unique_ptr<Bullet> bullet_;  // goes first: it looks at the bodies once more
  std::vector<BlockId> order_;      // in which the free blocks are let go
  std::size_t released_ = 0;
  std::vector<BlockId> free_;
  std::vector<btRigidBody*> free_bodies_;
};

}  // namespace scree::rigid
