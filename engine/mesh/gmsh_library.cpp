#include "engine/mesh/gmsh_library.h"

#include <cmath>
#include <type_traits>

#include <dlfcn.h>
#include <fmt/format.h>
#include <gmshc.h>

#include "engine/base/check.h"

namespace scree::mesh::gmsh {

namespace {

// Loaded once; what was loaded stays.
void* library() {
  static void* const handle = dlopen(SCREE_GMSH_LIBRARY, RTLD_LAZY | RTLD_LOCAL);
  if (handle == nullptr) throw RunError(fmt::format("Gmsh could not be loaded: {}", dlerror()));
  return handle;
}

template <class Function>
Function* find(const char* name) {
  void* const found = dlsym(library(), name);
  if (found == nullptr) throw GmshFailure{dlerror()};
  return reinterpret_cast<Function*>(found);
}

// Memory that Gmsh allocated.
template <class T>
class Owned {
 public:
  Owned() = default;
  ~Owned() {
    if (data_ != nullptr) free_(data_);
  }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  T** data() { return &data_; }
  std::size_t* size() { return &size_; }
  [[nodiscard]] std::vector<T> list() const { return {data_, data_ + size_}; }
  [[nodiscard]] std::string text() const { return data_ == nullptr ? std::string() : std::string(data_); }

 private:
  decltype(gmshFree)* free_ = find<decltype(gmshFree)>("gmshFree");
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

// Without a word where its memory ran out, which is not the mesh's fault.
GmshFailure last_failure() {
  Owned<char> error;
  int failed = 0;
  find<decltype(gmshLoggerGetLastError)>("gmshLoggerGetLastError")(error.data(), &failed);
  const std::string text = error.text();
  if (failed != 0 || text.empty()) throw RunError("Gmsh failed without a reason, as where there is too little memory");
  return {text};
}

template <class Function, class... Arguments>
auto called(Function* function, Arguments... arguments) {
  int failed = 0;
  if constexpr (std::is_void_v<decltype(function(arguments..., &failed))>) {
    function(arguments..., &failed);
    if (failed != 0) throw last_failure();
  } else {
    const auto result = function(arguments..., &failed);
    if (failed != 0) throw last_failure();
    return result;
  }
}

// Arrays of arrays that Gmsh allocated.
class OwnedLists {
 public:
  OwnedLists() = default;
  ~OwnedLists() {
    for (std::size_t i = 0; i < count_; ++i) free_(data_[i]);
    if (data_ != nullptr) free_(data_);
    if (sizes_ != nullptr) free_(sizes_);
  }
  OwnedLists(const OwnedLists&) = delete;
  OwnedLists& operator=(const OwnedLists&) = delete;
  std::size_t*** data() { return &data_; }
  std::size_t** sizes() { return &sizes_; }
  std::size_t* count() { return &count_; }
  [[nodiscard]] std::vector<std::size_t> list(std::size_t i) const { return {data_[i], data_[i] + sizes_[i]}; }

 private:
  decltype(gmshFree)* free_ = find<decltype(gmshFree)>("gmshFree");
  std::size_t** data_ = nullptr;
  std::size_t* sizes_ = nullptr;
  std::size_t count_ = 0;
};

#define SCREE_CALL(function, ...) called(find<decltype(function)>(#function), __VA_ARGS__)

}  // namespace

void initialize() {
  SCREE_CALL(gmshInitialize, 0, nullptr, 0);
}
void finalize() {
  called(find<decltype(gmshFinalize)>("gmshFinalize"));
}
void set_number(const char* option, double value) {
  SCREE_CALL(gmshOptionSetNumber, option, value);
}

void open(const std::string& path) {
  SCREE_CALL(gmshOpen, path.c_str());
}
void add_model(const std::string& name) {
  SCREE_CALL(gmshModelAdd, name.c_str());
}
void generate(int dimension) {
  SCREE_CALL(gmshModelMeshGenerate, dimension);
}

void add_rectangle(double x, double y, double width, double height) {
  SCREE_CALL(gmshModelOccAddRectangle, x, y, 0.0, width, height, -1, 0.0);
}
void add_box(double x, double y, double z, double width, double depth, double height) {
  SCREE_CALL(gmshModelOccAddBox, x, y, z, width, depth, height, -1);
}
void add_disc(double radius) {
  SCREE_CALL(gmshModelOccAddDisk, 0.0, 0.0, 0.0, radius, radius, -1);
}
void add_cylinder(double bottom, double height, double radius) {
  SCREE_CALL(gmshModelOccAddCylinder, 0.0, 0.0, bottom, 0.0, 0.0, height, radius, -1, 2 * M_PI);
}
void synchronize_occ() {
  called(find<decltype(gmshModelOccSynchronize)>("gmshModelOccSynchronize"));
}

int add_point(double x, double y, double z) {
  return SCREE_CALL(gmshModelGeoAddPoint, x, y, z, 0.0, -1);
}
int add_circle_arc(int from, int centre, int to) {
  return SCREE_CALL(gmshModelGeoAddCircleArc, from, centre, to, -1, 0.0, 0.0, 0.0);
}
int add_curve_loop(std::vector<int> curves) {
  return SCREE_CALL(gmshModelGeoAddCurveLoop, curves.data(), curves.size(), -1, 0);
}
int add_surface_filling(int loop, int tag, int sphere_centre) {
  return SCREE_CALL(gmshModelGeoAddSurfaceFilling, &loop, std::size_t{1}, tag, sphere_centre);
}
int add_surface_loop(std::vector<int> surfaces) {
  return SCREE_CALL(gmshModelGeoAddSurfaceLoop, surfaces.data(), surfaces.size(), -1);
}
int add_volume(int surface_loop) {
  return SCREE_CALL(gmshModelGeoAddVolume, &surface_loop, std::size_t{1}, -1);
}
int add_discrete_surface() {
  return SCREE_CALL(gmshModelAddDiscreteEntity, 2, -1, nullptr, std::size_t{0});
}
void synchronize_geo() {
  called(find<decltype(gmshModelGeoSynchronize)>("gmshModelGeoSynchronize"));
}

void add_nodes(int surface, std::vector<std::size_t> tags, std::vector<double> coordinates) {
  SCREE_CALL(gmshModelMeshAddNodes, 2, surface, tags.data(), tags.size(), coordinates.data(), coordinates.size(), nullptr,
             std::size_t{0});
}
void add_triangles(int surface, std::vector<std::size_t> corners) {
  constexpr int triangle = 2;
  SCREE_CALL(gmshModelMeshAddElementsByType, surface, triangle, nullptr, std::size_t{0}, corners.data(), corners.size());
}

Nodes nodes() {
  Owned<std::size_t> tags;
  Owned<double> coordinates, parametric;
  SCREE_CALL(gmshModelMeshGetNodes, tags.data(), tags.size(), coordinates.data(), coordinates.size(), parametric.data(),
             parametric.size(), -1, -1, 0, 0);
  return {tags.list(), coordinates.list()};
}

std::vector<Elements> elements(int dimension, int entity) {
  Owned<int> types;
  OwnedLists tags, corners;
  SCREE_CALL(gmshModelMeshGetElements, types.data(), types.size(), tags.data(), tags.sizes(), tags.count(), corners.data(),
             corners.sizes(), corners.count(), dimension, entity);
  std::vector<Elements> all;
  const std::vector<int> list = types.list();
  for (std::size_t t = 0; t < list.size(); ++t) all.push_back({list[t], tags.list(t), corners.list(t)});
  return all;
}

std::string element_name(int type) {
  Owned<char> name;
  Owned<double> local;
  int dimension = 0, order = 0, count = 0, primary = 0;
  SCREE_CALL(gmshModelMeshGetElementProperties, type, name.data(), &dimension, &order, &count, local.data(), local.size(),
             &primary);
  return name.text();
}

std::vector<PhysicalGroup> physical_groups() {
  Owned<int> pairs;
  SCREE_CALL(gmshModelGetPhysicalGroups, pairs.data(), pairs.size(), -1);
  std::vector<PhysicalGroup> groups;
  const std::vector<int> list = pairs.list();
  for (std::size_t i = 0; i + 1 < list.size(); i += 2) groups.push_back({list[i], list[i + 1]});
  return groups;
}
std::string physical_name(const PhysicalGroup& group) {
  Owned<char> name;
  SCREE_CALL(gmshModelGetPhysicalName, group.dimension, group.tag, name.data());
  return name.text();
}
std::vector<int> entities_of(const PhysicalGroup& group) {
  Owned<int> tags;
  SCREE_CALL(gmshModelGetEntitiesForPhysicalGroup, group.dimension, group.tag, tags.data(), tags.size());
  return tags.list();
}

}  // namespace scree::mesh::gmsh
