#include "thermal/fastest_cell.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include <Eigen/Eigenvalues>

namespace scree::thermal {

namespace {

template <int dim>
using CellCorners = typename RepeatedCells<dim>::Corners;

// Of C_e^-1 M_e, `entries` being M_e and the capacity that of unit density and specific heat.
template <int dim>
double largest_eigenvalue(const CellCorners<dim>& corners, std::array<double, 8> CornerOfCell::*entries) {
  const auto count = std::count_if(corners.begin(), corners.end(), [](const CornerOfCell& c) { return c.volume > 0; });
  Eigen::MatrixXd scaled(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) {
      scaled(i, j) =
          (corners[i].*entries)[j] / std::sqrt(corner_mass<dim>(corners[i].volume, 1) * corner_mass<dim>(corners[j].volume, 1));
    }
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

}  // namespace

template <int dim>
std::optional<FastestCell> fastest_cell(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                                        const RepeatedCells<dim>& repeated, const HeatModel& model) {
  if (model.varying || model.lumped) return std::nullopt;
  FastestCell fastest;
  std::unordered_map<const CellCorners<dim>*, FastestCell> known;  // of unit density and specific heat
  for (const mesh::Block& block : mesh.blocks) {
    const Material& material = materials[mesh.bodies[block.body].material];
    const double heat_per_volume = *material.density * *material.specific_heat->constant();
    if (block.cells.size() == 0) return std::nullopt;
    const CellCorners<dim>* last = nullptr;
    for (const CellId cell : block.cells) {
      const CellCorners<dim>* shape = repeated.find(cell);
      if (shape == nullptr) return std::nullopt;
      if (std::exchange(last, shape) == shape) continue;
      const auto [entry, is_new] = known.try_emplace(shape);
      if (is_new) {
        entry->second = {largest_eigenvalue<dim>(*shape, &CornerOfCell::conductance),
                         1 + largest_eigenvalue<dim>(*shape, &CornerOfCell::shared)};
      }
      fastest.rate = std::max(fastest.rate, entry->second.rate / heat_per_volume);
      fastest.gain = std::max(fastest.gain, entry->second.gain);
    }
  }
  return fastest;
}

template std::optional<FastestCell> fastest_cell<2>(const mesh::BlockMesh<2>&, const Table<MaterialId, Material>&,
                                                    const RepeatedCells<2>&, const HeatModel&);
template std::optional<FastestCell> fastest_cell<3>(const mesh::BlockMesh<3>&, const Table<MaterialId, Material>&,
                                                    const RepeatedCells<3>&, const HeatModel&);

}  // namespace scree::thermal
