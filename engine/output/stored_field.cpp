#include "engine/output/stored_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkGenericCell.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStaticCellLocator.h>

#include "engine/output/open_vtu.h"
#include "engine/output/vtk_room.h"

namespace scree::output {

namespace {

constexpr double rounding = 1e-9;   // of the mesh's extent: nodes this near to each other are the same
constexpr double inwards = 1e-6;    // of a block's extent, see the header
constexpr double almost_in = 1e-6;  // of a cell: a point that far outside lies in it, for rounding

vtkSmartPointer<vtkUnstructuredGrid> open(const StoredField& stored) {
  const std::filesystem::path frame = stored_frame(stored);
  try {
    return open_vtu(frame);
  } catch (const std::runtime_error& error) {
    throw InputError(stored.problem(frame.string(), error.what(), "Run the earlier scene again"));
  }
}

template <int dim>
Eigen::Vector3d in_space(const Point<dim>& point) {
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  result.head<dim>() = point;
  return result;
}

// How far a point lies outside a cell, in the cell's own coordinates; 0 in it. Of a wedge VTK 9.1 looks at each coordinate by
// itself, and so takes in the other half of the box around it.
double outside(vtkGenericCell& cell, const std::array<double, 3>& parametric) {
  const double of_axes = cell.GetRepresentativeCell()->GetParametricDistance(parametric.data());
  return cell.GetCellType() == VTK_WEDGE ? std::max(of_axes, parametric[0] + parametric[1] - 1) : of_axes;
}

// Values of one grid, looked up node by node.
class Lookup {
 public:
  Lookup(vtkUnstructuredGrid& grid, vtkDataArray& values, double reach) : grid_(grid), values_(values), reach_(reach) {
    locator_->SetDataSet(&grid);
    locator_->BuildLocator();
  }

  struct Found {
    double value = 0;
    double distance = 0;  // outside the grid [m]; infinite if it is beyond the reach
  };

  Found at(const Eigen::Vector3d& point, double slack) {
    std::vector<double> weights(static_cast<std::size_t>(std::max(grid_.GetMaxCellSize(), 1)));
    std::array<double, 3> parametric{};
    int part = 0;
    vtkIdType id = cell_around(point, slack, weights);
    Found found;
    if (id < 0) {
      Eigen::Vector3d nearest = point;
      double squared = 0;
      const double radius = std::max(reach_, slack);
      if (locator_->FindClosestPointWithinRadius(const_cast<double*>(point.data()), radius, nearest.data(), cell_, id, part,
                                                 squared) == 0) {
        found.distance = std::numeric_limits<double>::infinity();
        return found;
      }
      found.distance = std::sqrt(squared);
      grid_.GetCell(id, cell_);
      if (!evaluate(nearest, parametric, weights)) found.distance = std::numeric_limits<double>::infinity();
    } else {
      grid_.GetCell(id, cell_);
    }
    for (int i = 0; i < cell_->GetNumberOfPoints(); ++i) {
      found.value += weights[static_cast<std::size_t>(i)] * values_.GetTuple1(cell_->GetPointId(i));
    }
    return found;
  }

 private:
  // The cell that holds the point, and its weights; -1: none. VTK's own search takes the first cell that holds it but for a
  // thousandth of the cell, which across a joint may be another block's.
  vtkIdType cell_around(const Eigen::Vector3d& point, double slack, std::vector<double>& weights) {
    std::array<double, 6> bounds{};
    for (int axis = 0; axis < 3; ++axis) {
      bounds[2 * axis] = point[axis] - slack;
      bounds[2 * axis + 1] = point[axis] + slack;
    }
    locator_->FindCellsWithinBounds(bounds.data(), near_);
    vtkIdType best = -1;
    double least = almost_in;
    std::vector<double> of_cell(weights.size());
    for (vtkIdType i = 0; i < near_->GetNumberOfIds(); ++i) {
      std::array<double, 3> parametric{};
      grid_.GetCell(near_->GetId(i), cell_);
      if (!evaluate(point, parametric, of_cell)) continue;
      const double out = outside(*cell_, parametric);
      if (out > least || (best >= 0 && out == least)) continue;
      least = out;
      best = near_->GetId(i);
      weights = of_cell;
    }
    return best;
  }

  // Where in the cell that is looked at a point is; false if that is not found, as of points far from a quadrilateral or a
  // hexahedron that is no parallelepiped: what VTK gives then is where its iteration stopped.
  bool evaluate(const Eigen::Vector3d& point, std::array<double, 3>& parametric, std::vector<double>& weights) {
    std::array<double, 3> closest{};
    double squared = 0;
    int part = 0;
    return cell_->EvaluatePosition(const_cast<double*>(point.data()), closest.data(), part, parametric.data(), squared,
                                   weights.data()) >= 0;
  }

  vtkUnstructuredGrid& grid_;
  vtkDataArray& values_;
  double reach_;
  vtkNew<vtkIdList> near_;
  vtkNew<vtkStaticCellLocator> locator_;
  vtkNew<vtkGenericCell> cell_;
};

template <int dim>
double extent_of(const mesh::BlockMesh<dim>& mesh) {
  Aabb<dim> box;
  for (const Point<dim>& node : mesh.nodes) box.extend(node);
  return mesh.nodes.empty() ? 0 : box.diagonal().norm();
}

template <int dim>
bool same_nodes(vtkUnstructuredGrid& grid, const mesh::BlockMesh<dim>& mesh, double slack) {
  if (static_cast<std::size_t>(grid.GetNumberOfPoints()) != mesh.nodes.size()) return false;
  return std::all_of(mesh.nodes.ids().begin(), mesh.nodes.ids().end(), [&](NodeId node) {
    Eigen::Vector3d point;
    grid.GetPoint(static_cast<vtkIdType>(node.index()), point.data());
    return (point - in_space<dim>(mesh.nodes[node])).norm() <= slack;
  });
}

// Of each node of a block a middle of an element there: towards the middle of the whole a ring's nodes would leave it.
template <int dim>
std::vector<Point<dim>> points_inside(const mesh::BlockMesh<dim>& mesh, const mesh::Block& block) {
  std::vector<Point<dim>> inside(block.nodes.size());
  for (const ElementId element : block.elements) {
    Point<dim> middle = Point<dim>::Zero();
    for (const NodeId node : mesh.elements[element]) middle += mesh.nodes[node] / (dim + 1);
    for (const NodeId node : mesh.elements[element]) inside[node.index() - block.nodes.first()] = middle;
  }
  return inside;
}

template <int dim>
void interpolate(const StoredField& stored, Lookup& lookup, const mesh::BlockMesh<dim>& mesh, NodalField& field) {
  const double slack = rounding * extent_of(mesh);
  std::size_t outside = 0;
  NodeId first;
  for (const mesh::Block& block : mesh.blocks) {
    const std::vector<Point<dim>> inside = points_inside(mesh, block);
    Aabb<dim> box;
    for (const NodeId node : block.nodes) box.extend(mesh.nodes[node]);
    for (const NodeId node : block.nodes) {
      const Point<dim> way = inside[node.index() - block.nodes.first()] - mesh.nodes[node];
      const double part = std::min(0.5, 0.5 * inwards * box.diagonal().norm() / way.norm());
      const Lookup::Found found = lookup.at(in_space<dim>(mesh.nodes[node] + part * way), slack);
      field.values[static_cast<Eigen::Index>(node.index())] = found.value;
      if (found.distance > slack) ++field.moved;
      if (!std::isfinite(found.distance) && outside++ == 0) first = node;
    }
  }
  if (outside == 0) return;
  const Eigen::Vector3d point = in_space<dim>(mesh.nodes[first]);
  throw InputError(
      stored.problem(stored.from.string(),
                     fmt::format("{} nodes lie outside its mesh and a reach of {:g} m, the first at ({:g}, {:g}, {:g}) m",
                                 outside, stored.reach, point.x(), point.y(), point.z()),
                     "Raise heat.initial.reach if that is meant"));
}

}  // namespace

namespace vtk {

template <int dim>
NodalField read_stored(const StoredField& stored, const mesh::BlockMesh<dim>& mesh) {
  const vtkSmartPointer<vtkUnstructuredGrid> grid = open(stored);
  vtkDataArray* values = grid->GetPointData()->GetArray("temperature");
  if (values == nullptr || values->GetNumberOfComponents() != 1) {
    throw InputError(
        stored.problem(stored.from.string(), "must have a point array temperature, in K", "Name a frame of a run with heat"));
  }
  if (grid->GetNumberOfCells() == 0) throw InputError(stored.problem(stored.from.string(), "must have cells", ""));
  const auto size = static_cast<Eigen::Index>(mesh.nodes.size());
  NodalField field;
  field.values = Eigen::VectorXd::Zero(size);
  field.same_mesh = same_nodes(*grid, mesh, rounding * extent_of(mesh));
  if (field.same_mesh) {
    for (Eigen::Index i = 0; i < size; ++i) field.values[i] = values->GetTuple1(i);
  } else {
    Lookup lookup(*grid, *values, stored.reach);
    interpolate(stored, lookup, mesh, field);
  }
  if (!field.values.allFinite() || field.values.minCoeff() < 0) {
    throw InputError(stored.problem(stored.from.string(), "has temperatures that are no number or below 0 K", ""));
  }
  return field;
}

template NodalField read_stored<2>(const StoredField&, const mesh::BlockMesh<2>&);
template NodalField read_stored<3>(const StoredField&, const mesh::BlockMesh<3>&);

}  // namespace vtk

}  // namespace scree::output
