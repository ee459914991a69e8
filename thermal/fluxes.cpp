#include "thermal/fluxes.h"

#include <array>
#include <optional>

#include "engine/mesh/cells.h"
#include "thermal/block_conduction.h"

namespace scree::thermal {

namespace {

// Of some elements what their gradients need, axis by axis, so that several are worked out at once.
template <int dim>
class Gradients {
 public:
  static constexpr std::size_t most = 64;

  [[nodiscard]] std::size_t count() const { return count_; }
  void clear() { count_ = 0; }

  void add(const mesh::BlockMesh<dim>& mesh, const mesh::Simplex<dim>& nodes, const CornerValues<dim>& values) {
    for (int a = 0; a <= dim; ++a) {
      const Point<dim>& point = mesh.nodes[nodes[a]];
      for (int i = 0; i < dim; ++i) points_[a][i][count_] = point[i];
      values_[a][count_] = values[a];
    }
    ++count_;
  }

  // What is behind the last of them is worked out, too, and is of no matter.
  void work_out() {
    widely([&](auto) SCREE_INLINED {
      for (std::size_t n = 0; n < most; ++n) {
        const auto along = gradient<dim>([&](int a, int i) SCREE_INLINED { return points_[a][i][n]; },
                                         [&](int a) SCREE_INLINED { return values_[a][n]; });
        for (int i = 0; i < dim; ++i) along_[i][n] = along[i];
      }
    });
  }

  [[nodiscard]] Point<dim> of(std::size_t n) const {
    Point<dim> along;
    for (int i = 0; i < dim; ++i) along[i] = along_[i][n];
    return along;
  }

 private:
  using Numbers = std::array<double, most>;

  std::size_t count_ = 0;
  std::array<std::array<Numbers, dim>, dim + 1> points_{};
  std::array<Numbers, dim + 1> values_{};
  std::array<Numbers, dim> along_{};
};

// How a material conducts.
template <int dim>
struct Conducting {
  explicit Conducting(const Material& material)
      : curve(&material.conductivity->value),
        constant(curve->constant().has_value()),
        isotropic(material.conductivity->isotropic()),
        size(curve->constant().value_or(1)) {}

  const Curve* curve;
  bool constant;
  bool isotropic;
  double size;  // of the conductivity, or of what Kirchhoff's Phi (heat_balance.h) leaves of it
};

// Adds up fluxes of simplices, some of them at a time.
template <int dim>
class FluxSums {
 public:
  FluxSums(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials, const Eigen::VectorXd& temperature)
      : mesh_(mesh), materials_(materials), temperature_(temperature) {
    for (const Material& material : materials) {  // one that no body is made of may lack its conductivity
      conducting_.push_back(material.conductivity ? std::optional<Conducting<dim>>(material) : std::nullopt);
    }
  }

  // All that is added until the next one is in this block.
  void enter(BlockId block) {
    if (of_block_ != nullptr && !of_block_->isotropic) finish();
    const MaterialId material = mesh_.bodies[mesh_.blocks[block].body].material;
    of_block_ = &*conducting_[material];
    if (of_block_->isotropic) return;
    tensor_ = of_block_->size * conductivity_ratios<dim>(*materials_[material].conductivity, mesh_.blocks[block]);
  }

  // Adds a share of the flux in a simplex of the block to `sum`, sooner or later.
  void add(const mesh::Simplex<dim>& nodes, double share, Point<dim>& sum) {
    const auto at = [&](int corner) { return temperature_[nodes[corner].value()]; };
    CornerValues<dim> values;
    if (of_block_->constant) {  // by itself, so that no call in between keeps the values in memory
      for (int i = 0; i <= dim; ++i) values[i] = at(i);
    } else {
      for (int i = 0; i <= dim; ++i) values[i] = of_block_->curve->integral(at(i));
    }
    asked_[gradients_.count()] = {&sum, share, of_block_};
    gradients_.add(mesh_, nodes, values);
    if (gradients_.count() == gradients_.most) finish();
  }

  void finish() {
    gradients_.work_out();
    for (std::size_t n = 0; n < gradients_.count(); ++n) {
      const auto& [sum, share, how] = asked_[n];
      if (how->isotropic) {
        *sum += share * flux<dim>(how->size, gradients_.of(n));
      } else {
        *sum += share * flux<dim>(tensor_, gradients_.of(n));
      }
    }
    gradients_.clear();
  }

 private:
  struct Asked {
    Point<dim>* sum;
    double share;
    const Conducting<dim>* how;
  };

  const mesh::BlockMesh<dim>& mesh_;
  const Table<MaterialId, Material>& materials_;
  const Eigen::VectorXd& temperature_;
  Table<MaterialId, std::optional<Conducting<dim>>> conducting_;
  const Conducting<dim>* of_block_ = nullptr;
  Tensor<dim> tensor_;  // of the block, if it is not isotropic
  Gradients<dim> gradients_;
  std::array<Asked, Gradients<dim>::most> asked_;
};

// Over both splits, by volume.
template <int dim>
void add_cell(const mesh::BlockMesh<dim>& mesh, CellId cell, FluxSums<dim>& sums, Point<dim>& flux) {
  const auto splits = mesh::both_splits(mesh, cell);
  double volume = 0;
  for (const mesh::Simplex<dim>& nodes : splits) volume += mesh::simplex_volume<dim>(mesh, nodes);
  for (const mesh::Simplex<dim>& nodes : splits) sums.add(nodes, mesh::simplex_volume<dim>(mesh, nodes) / volume, flux);
}

}  // namespace

template <int dim>
std::vector<Point<dim>> cell_fluxes(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                                    const Eigen::VectorXd& temperature) {
  if (mesh.cells.empty()) return element_fluxes(mesh, materials, temperature);
  const auto shown = [](const mesh::Block& block) {
    return block.cells.size() > 0 ? block.cells.size() : block.elements.size();
  };
  std::size_t count = 0;
  for (const mesh::Block& block : mesh.blocks) count += shown(block);
  std::vector<Point<dim>> fluxes(count, Point<dim>::Zero());
  auto flux = fluxes.begin();
  FluxSums<dim> sums(mesh, materials, temperature);
  for (const BlockId b : mesh.blocks.ids()) {
    const mesh::Block& block = mesh.blocks[b];
    sums.enter(b);
    for (const CellId cell : block.cells) add_cell(mesh, cell, sums, *flux++);
    if (block.cells.size() > 0) continue;
    for (const ElementId e : block.elements) sums.add(mesh.elements[e], 1, *flux++);
  }
  sums.finish();
  return fluxes;
}

template <int dim>
std::vector<Point<dim>> element_fluxes(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                                       const Eigen::VectorXd& temperature) {
  std::vector<Point<dim>> fluxes(mesh.elements.size(), Point<dim>::Zero());
  FluxSums<dim> sums(mesh, materials, temperature);
  for (const BlockId b : mesh.blocks.ids()) {
    sums.enter(b);
    for (const ElementId e : mesh.blocks[b].elements) sums.add(mesh.elements[e], 1, fluxes[e.index()]);
  }
  sums.finish();
  return fluxes;
}

#define SCREE_INSTANTIATE(dim)                                                                                          \
  template std::vector<Point<dim>> cell_fluxes<dim>(const mesh::BlockMesh<dim>&, const Table<MaterialId, Material>&,    \
                                                    const Eigen::VectorXd&);                                            \
  template std::vector<Point<dim>> element_fluxes<dim>(const mesh::BlockMesh<dim>&, const Table<MaterialId, Material>&, \
                                                       const Eigen::VectorXd&);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE

}  // namespace scree::thermal
