#include "thermal/fourth_order.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "engine/base/chunks.h"
#include "thermal/problems.h"

namespace scree::thermal {

namespace {

constexpr const char* key = "heat.space_order";

// Local coordinates of the corners, in the order of cell_kind.h.
constexpr std::array<std::array<double, 3>, 8> corner_signs{
    {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};

// Of both means.
constexpr double half = 0.5;

// Corners that are this far from where a parallelepiped has them, over its size, make another cell.
constexpr double parallel_tolerance = 1e-9;

// The multilinear shape functions at one of Gauss's points.
template <int dim>
struct ShapeAt {
  static constexpr int corners = 1 << dim;
  std::array<double, corners> value;
  Eigen::Matrix<double, dim, corners> gradient;  // [1/m]
  double volume;                                 // that the point stands for [m3]

  ShapeAt(const CellPoints<dim>& points, const std::array<double, 3>& local) {
    Eigen::Matrix<double, dim, corners> slope;
    Tensor<dim> jacobian = Tensor<dim>::Zero();
    for (int a = 0; a < corners; ++a) {
      value[a] = 1;
      for (int i = 0; i < dim; ++i) value[a] *= factor(a, i, local);
      for (int i = 0; i < dim; ++i) {
        slope(i, a) = 0.5 * corner_signs[a][i];
        for (int j = 0; j < dim; ++j) slope(i, a) *= j == i ? 1 : factor(a, j, local);
      }
      jacobian += points[a] * slope.col(a).transpose();
    }
    gradient = jacobian.transpose().inverse() * slope;
    volume = jacobian.determinant();
  }

 private:
  static double factor(int corner, int axis, const std::array<double, 3>& local) {
    return 0.5 * (1 + corner_signs[corner][axis] * local[axis]);
  }
};

struct Entry {
  double conductance;  // [W/K]
  double overlap;      // integral of both shape functions [m3]
};

// Of the multilinear element between two corners: the same to the bit whichever comes first.
template <int dim>
Entry multilinear_entry(const std::vector<ShapeAt<dim>>& shapes, const Tensor<dim>& conductivity, int a, int b) {
  const auto [first, second] = std::minmax(a, b);
  Entry entry{0, 0};
  for (const ShapeAt<dim>& at : shapes) {
    entry.conductance += at.volume * at.gradient.col(first).dot(conductivity * at.gradient.col(second));
    entry.overlap += at.volume * at.value[first] * at.value[second];
  }
  return entry;
}

// At the points of quadrature that lie `where` of the way from the middle of the cell to its corners.
template <int dim>
std::vector<ShapeAt<dim>> shapes_at(const CellPoints<dim>& points, double where) {
  std::vector<ShapeAt<dim>> shapes;
  for (int point = 0; point < ShapeAt<dim>::corners; ++point) {
    std::array<double, 3> local = corner_signs[point];
    for (double& coordinate : local) coordinate *= where;
    shapes.emplace_back(points, local);
  }
  return shapes;
}

// Where Gauss's points lie on the way.
const double gauss = 1 / std::sqrt(3.0);

bool is_parallelepiped(const CellPoints<3>& points) {
  const Point<3> u = points[1] - points[0], v = points[3] - points[0], w = points[4] - points[0];
  double worst = 0;
  for (std::size_t a = 0; a < points.size(); ++a) {
    const auto& sign = corner_signs[a];
    const Point<3> expected = points[0] + 0.5 * ((1 + sign[0]) * u + (1 + sign[1]) * v + (1 + sign[2]) * w);
    worst = std::max(worst, (points[a] - expected).norm());
  }
  return worst <= parallel_tolerance * (u + v + w).norm();
}

// The multilinear map of a cell turns over at none of Gauss's points.
template <int dim>
bool unfolds(const CellPoints<dim>& points) {
  if constexpr (dim == 3) {
    if (is_parallelepiped(points)) return true;  // the mesh has positive cells only
  }
  const auto shapes = shapes_at<dim>(points, gauss);
  return std::all_of(shapes.begin(), shapes.end(), [](const ShapeAt<dim>& at) { return at.volume > 0; });
}

template <int dim>
bool any_folds(const mesh::BlockMesh<dim>& mesh) {
  std::vector<char> folds(chunk_count(mesh.cells.size()), 0);
  for_chunks(mesh.cells.size(), [&](Chunk chunk) {
    for (std::size_t c = chunk.begin; c < chunk.end; ++c) {
      if (!unfolds<dim>(cell_points(mesh, mesh.cells[CellId{c}]))) folds[chunk.number] = 1;
    }
  });
  return std::find(folds.begin(), folds.end(), 1) != folds.end();
}

// C^-1 B x of the free nodes, for x that is zero at fixed ones or is a jump of their temperature.
Eigen::VectorXd shared(const HeatModel& model, const FlowNetwork& sharing, const Eigen::VectorXd& x) {
  Eigen::VectorXd result = sharing.leaving(x).cwiseQuotient(model.capacity);
  for (const NodeId node : model.fixed_nodes) result[node.value()] = 0;
  return result;
}

}  // namespace

template <int dim>
void make_fourth_order(mesh::CellKind kind, const CellPoints<dim>& points, const Tensor<dim>& conductivity, int corner,
                       CornerOfCell& mixed) {
  const std::vector<ShapeAt<dim>> by_gauss = shapes_at<dim>(points, gauss);
  std::vector<ShapeAt<dim>> at_corners;
  if constexpr (dim == 3) {
    if (is_parallelepiped(points)) at_corners = shapes_at<dim>(points, 1);
  }
  double row = 0, shared_row = 0;
  for (int other = 0; other < static_cast<int>(mesh::corner_count(kind)); ++other) {
    if (other == corner) continue;
    const auto [conductance, overlap] = multilinear_entry<dim>(by_gauss, conductivity, corner, other);
    double& mean = mixed.conductance[static_cast<std::size_t>(other)];
    if (!at_corners.empty()) mean = multilinear_entry<dim>(at_corners, conductivity, corner, other).conductance;
    mean = half * (mean + conductance);
    double& shared = mixed.shared[static_cast<std::size_t>(other)];
    shared = -half * overlap;
    row += mean;
    shared_row += shared;
  }
  mixed.conductance[static_cast<std::size_t>(corner)] = -row;
  mixed.shared[static_cast<std::size_t>(corner)] = -shared_row;
}

template <int dim>
void check_fourth_order(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                        const HeatOptions& options) {
  const auto refuse = [](const std::string& rule, const std::string& suggestion) {
    throw InputError(problem(key, "4", rule, suggestion));
  };
  for (const mesh::Block& block : mesh.blocks) {
    const mesh::Body& body = mesh.bodies[block.body];
    const mesh::CellKind wanted = dim == 2 ? mesh::CellKind::quadrilateral : mesh::CellKind::hexahedron;
    const bool fits = block.cells.size() > 0 && std::all_of(block.cells.begin(), block.cells.end(),
                                                            [&](CellId cell) { return mesh.cells[cell].kind == wanted; });
    if (!fits) {
      refuse(std::string("must have blocks of ") + (dim == 2 ? "quadrilaterals" : "hexahedra") + ", but those of " + body.name +
                 " are not",
             "Set the body's elements, or space_order: 2");
    }
    const Material& material = materials[body.material];
    if (material.conductivity->varies() || !material.specific_heat->constant()) {
      refuse("must have constant properties, but those of " + material.name + " vary with temperature", "Set space_order: 2");
    }
  }
  if (any_folds(mesh)) refuse("must not be asked of cells whose sides fold over", "Mesh the body with better cells");
  if (!options.blocks.all_meshed()) refuse("must have meshed blocks", "Take heat.blocks out, or set space_order: 2");
}

double largest_gain(const HeatModel& model) {
  if (!model.shared_capacity) return 1;
  if (model.fastest_cell) return model.fastest_cell->gain;
  return 1 + (2 * model.shared_capacity->diagonal().cwiseQuotient(model.capacity)).maxCoeff();
}

Eigen::VectorXd after_jump(const HeatModel& model, const Eigen::VectorXd& held) {
  if (!model.shared_capacity) return held;
  const FlowNetwork sharing(&*model.shared_capacity, Sums::plain);
  const Eigen::VectorXd first = shared(model, sharing, held - model.initial);
  return held + first + shared(model, sharing, first);
}

HeldShares::HeldShares(const HeatModel& model) : fixed_(static_cast<Eigen::Index>(model.fixed_nodes.size())) {
  const auto is_fixed = [&](NodeId node) {
    return std::binary_search(model.fixed_nodes.begin(), model.fixed_nodes.end(), node);
  };
  const auto for_each_share = [&](const auto& use) {
    for (Eigen::Index fixed = 0; fixed < fixed_; ++fixed) {
      const int column = model.fixed_nodes[static_cast<std::size_t>(fixed)].value();
      for (SparseMatrix::InnerIterator entry(*model.shared_capacity, column); entry; ++entry) {
        const NodeId node(static_cast<std::size_t>(entry.row()));
        if (!is_fixed(node)) use(fixed, node, entry.value() / model.capacity[node.value()]);
      }
    }
  };
  for_each_share([&](Eigen::Index, NodeId node, double) { givers_.push_back(node); });
  std::sort(givers_.begin(), givers_.end());
  givers_.erase(std::unique(givers_.begin(), givers_.end()), givers_.end());
  for_each_share([&](Eigen::Index fixed, NodeId node, double share) {
    shares_.push_back({fixed, std::lower_bound(givers_.begin(), givers_.end(), node) - givers_.begin(), share});
  });
}

Eigen::VectorXd HeldShares::shares(const HeatBalance& balance, const Eigen::VectorXd& temperature, const Drive& drive) const {
  const Eigen::VectorXd heating = balance.heating_at(givers_, temperature, drive);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(fixed_);
  for (const Share& share : shares_) result[share.fixed] += share.share * heating[share.giver];
  return result;
}

#define SCREE_INSTANTIATE(dim)                                                                                          \
  template void make_fourth_order<dim>(mesh::CellKind, const CellPoints<dim>&, const Tensor<dim>&, int, CornerOfCell&); \
  template void check_fourth_order<dim>(const mesh::BlockMesh<dim>&, const Table<MaterialId, Material>&, const HeatOptions&);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE

}  // namespace scree::thermal
