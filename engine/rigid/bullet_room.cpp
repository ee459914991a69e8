#include "engine/rigid/bullet_room.h"

#include "engine/base/late_library.h"

namespace scree::rigid {

packing::Packing<3> settle(const mesh::BlockMesh<3>& blocks, const Table<MaterialId, Material>& materials,
                           const SettleOptions& options, const FrameSink& frame, const SettleProgress& progress) {
  static const auto found = late_function<decltype(scree_bullet_settle)>("libscree_bullet.so", "scree_bullet_settle")();
  return found(blocks, materials, options, frame, progress);
}

}  // namespace scree::rigid
