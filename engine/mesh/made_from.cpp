#include "engine/mesh/made_from.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

#include <fmt/format.h>

#include "engine/base/hash.h"

namespace scree::mesh {

namespace {

std::string words(double number) {
  return fmt::format("{:.12g}", number + 0.0);  // 0 for -0
}

std::string words(const Eigen::Vector3d& v) {
  return fmt::format("({}, {}, {}) m", words(v.x()), words(v.y()), words(v.z()));
}

std::string turned(const Eigen::Quaterniond& q) {
  if (q.coeffs() == Eigen::Quaterniond::Identity().coeffs()) return {};
  return fmt::format(", turned by ({}; {}, {}, {})", words(q.w()), words(q.x()), words(q.y()), words(q.z()));
}

std::string line_of(const Box& box) {
  return "box: " + words(box.size);
}

std::string line_of(const Sphere& sphere) {
  return fmt::format("sphere: {} m across", words(sphere.diameter));
}

std::string line_of(const Cylinder& cylinder) {
  return fmt::format("cylinder: {} m across, {} m high", words(cylinder.diameter), words(cylinder.height));
}

std::string line_of(const MeshFile& mesh) {
  std::ifstream stream(mesh.path, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(stream), {});
  return fmt::format("mesh: a file with the contents {}, scale {}", Hasher{}.add(bytes).hex(), words(mesh.scale));
}

std::string places_of(const AtPoses& at) {
  std::vector<std::string> texts;
  for (const Pose& pose : at.poses) texts.push_back(words(pose.translation) + turned(pose.rotation));
  if (texts.size() == 1) return "at " + texts.front();
  Hasher hash;
  for (const std::string& text : texts) hash.add(text);
  return "at the places " + hash.hex();
}

std::string places_of(const OnLattice& lattice) {
  return fmt::format("{} x {} x {} around {}, apart by {}{}", lattice.count[0], lattice.count[1], lattice.count[2],
                     words(lattice.centre), words(lattice.spacing), turned(lattice.rotation));
}

std::string places_of(const AtRandom& random) {
  return fmt::format("from {} to {}, seed {}, {}", words(random.low), words(random.high), random.seed,
                     random.random_rotation ? "turned" : "not turned");
}

std::size_t copies_of(const AtPoses& at) {
  return at.poses.size();
}

std::size_t copies_of(const OnLattice& lattice) {
  return static_cast<std::size_t>(lattice.count[0]) * static_cast<std::size_t>(lattice.count[1]) *
         static_cast<std::size_t>(lattice.count[2]);
}

std::size_t copies_of(const AtRandom& random) {
  return static_cast<std::size_t>(random.count);
}

// A single copy is placed by its shape.
std::string key_of_places(const BodySpec& body, const std::string& shape) {
  if (std::holds_alternative<OnLattice>(body.arrangement)) return "lattice";
  if (std::holds_alternative<AtRandom>(body.arrangement)) return "random";
  return std::get<AtPoses>(body.arrangement).poses.size() == 1 ? shape : "at";
}

struct Line {
  std::string key, value;
};

std::vector<Line> lines_of(const std::string& text) {
  std::vector<Line> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(": ");
    lines.push_back({line.substr(0, colon), line.substr(std::min(line.size(), colon + 2))});
  }
  return lines;
}

}  // namespace

std::string made_from(const BodySpec& body) {
  const std::string shape = std::visit([](const auto& any) { return line_of(any); }, body.shape);
  const std::string key = key_of_places(body, shape.substr(0, shape.find(':')));
  const std::size_t copies = std::visit([](const auto& any) { return copies_of(any); }, body.arrangement);
  return fmt::format("{}\nmesh_size: {} m\nelements: {}\nblocks: {}\n{}: {} {}\n{}: {}\n", shape, words(body.mesh_size),
                     body.cells ? kind_name(*body.cells) : "simplex",
                     body.blocks == BlockRule::per_element ? "per_element" : "whole", key, copies,
                     copies == 1 ? "copy" : "copies", key,
                     std::visit([](const auto& any) { return places_of(any); }, body.arrangement));
}

std::vector<MakingDifference> differences(const std::string& first, const std::string& second, Places places) {
  const std::vector<Line> a = lines_of(first), b = lines_of(second);
  std::vector<MakingDifference> found;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (a[i].value == b[i].value && (i > 0 || a[i].key == b[i].key)) continue;
    if (i + 1 == b.size() && places == Places::left_out) continue;
    found.push_back({b[i].key, a[i].key == b[i].key ? a[i].value : a[i].key + ": " + a[i].value, b[i].value});
  }
  return found;
}

}  // namespace scree::mesh
