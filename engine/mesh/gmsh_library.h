// The calls of Gmsh that are used here, over its interface in C. The library is loaded by the first session: with
// OpenCASCADE and all else behind it that takes longer than a small run, and runs that mesh nothing by Gmsh do without.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace scree::mesh {

// What Gmsh said when it failed.
struct GmshFailure {
  std::string reason;
};

// Every call throws GmshFailure. Tags number entities, nodes and elements from 1, as Gmsh does.
namespace gmsh {

void initialize();
void finalize();
void set_number(const char* option, double value);

void open(const std::string& path);
void add_model(const std::string& name);
void generate(int dimension);

// OpenCASCADE's kernel.
void add_rectangle(double x, double y, double width, double height);
void add_box(double x, double y, double z, double width, double depth, double height);
void add_disc(double radius);
void add_cylinder(double bottom, double height, double radius);
void synchronize_occ();

// Gmsh's own kernel. Each returns the tag of what it made.
int add_point(double x, double y, double z);
int add_circle_arc(int from, int centre, int to);
int add_curve_loop(std::vector<int> curves);
int add_surface_filling(int loop, int tag, int sphere_centre);
int add_surface_loop(std::vector<int> surfaces);
int add_volume(int surface_loop);
int add_discrete_surface();
void synchronize_geo();

// Nodes of a discrete surface, three coordinates each [m], and triangles of them, three tags each.
void add_nodes(int surface, std::vector<std::size_t> tags, std::vector<double> coordinates);
void add_triangles(int surface, std::vector<std::size_t> corners);

struct Nodes {
  std::vector<std::size_t> tags;
  std::vector<double> coordinates;  // three each [m]
};
Nodes nodes();

// The elements of one type.
struct Elements {
  int type = 0;
  std::vector<std::size_t> tags;
  std::vector<std::size_t> nodes;  // as many each
};
// Of one entity, or of all entities if its tag is -1; likewise for the dimension.
std::vector<Elements> elements(int dimension = -1, int entity = -1);

std::string element_name(int type);

struct PhysicalGroup {
  int dimension = 0;
  int tag = 0;
};
std::vector<PhysicalGroup> physical_groups();
std::string physical_name(const PhysicalGroup& group);
std::vector<int> entities_of(const PhysicalGroup& group);

}  // namespace gmsh

}  // namespace scree::mesh
