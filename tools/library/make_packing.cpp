#include "tools/library/make_packing.h"

#include "engine/mesh/make_blocks.h"
#include "engine/output/read_vtu.h"
#include "engine/rigid/settle.h"
#include "tools/run/keys.h"
#include "tools/run/packing_stage.h"
#include "tools/run/summary.h"

namespace scree {

template <int dim>
packing::Packing<dim> make_packing(const Scene& scene, const std::function<void(double)>& progress) {
  if (scene.packing) return run::stored_packing<dim>(scene);
  auto blocks = mesh::make_blocks<dim>(scene.bodies, output::mesh_readers());
  std::string key = run::packing_key(scene, blocks);
  packing::Packing<dim> packing;
  if (scene.settle) {
    if constexpr (dim == 3) {
      run::check_fall(scene, blocks);
      const auto tell = [&](double time, double) {
        if (progress) progress(time);
      };
      packing = rigid::settle(blocks, scene.materials, scene.settle->options, {}, tell);
    }
  } else {
    packing = packing::unmoved<dim>(std::move(blocks));
  }
  packing.key = std::move(key);
  return packing;
}

template <int dim>
std::vector<std::string> faults_of(const Scene& scene, const packing::Packing<dim>& packing) {
  return run::unsound(scene, packing);
}

template std::vector<std::string> faults_of<2>(const Scene&, const packing::Packing<2>&);
template std::vector<std::string> faults_of<3>(const Scene&, const packing::Packing<3>&);
template packing::Packing<2> make_packing<2>(const Scene&, const std::function<void(double)>&);
template packing::Packing<3> make_packing<3>(const Scene&, const std::function<void(double)>&);

}  // namespace scree
