#include "tests/scene/scene_text.h"

#include <fstream>

#include <fmt/format.h>

#include "tests/temp_folder.h"
#include "tools/scene/read_scene.h"

namespace scree::test {

namespace {

std::string text_of(const Eigen::Vector3d& v) {
  return fmt::format("({} {} {})", v.x(), v.y(), v.z());
}

std::string text_of(const Eigen::Quaterniond& q) {
  return fmt::format("({} {} {} {})", q.w(), q.x(), q.y(), q.z());
}

std::string text_of(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "none";
}

// A function and a curve are their values at some places, times and temperatures.
std::string text_of(const std::optional<Curve>& curve) {
  return curve ? fmt::format("curve {} {} {}", (*curve)(1), (*curve)(300), (*curve)(777)) : "none";
}
std::string text_of(const std::optional<Conductivity>& k) {
  if (!k) return "none";
  return fmt::format("{} {} {}", text_of(std::optional(k->value)), text_of(k->ratio), text_of(k->axes));
}

std::string text_of(const mesh::Box& box) {
  return fmt::format("box {}", text_of(box.size));
}
std::string text_of(const mesh::Sphere& sphere) {
  return fmt::format("sphere {}", sphere.diameter);
}
std::string text_of(const mesh::Cylinder& c) {
  return fmt::format("cylinder {} {}", c.diameter, c.height);
}
std::string text_of(const mesh::MeshFile& file) {
  return fmt::format("mesh {} {}", file.path.string(), file.scale);
}

std::string text_of(const mesh::AtPoses& at) {
  std::string text = "at";
  for (const Pose& pose : at.poses) text += text_of(pose.translation) + text_of(pose.rotation);
  return text;
}
std::string text_of(const mesh::OnLattice& lattice) {
  return fmt::format("lattice {} {} {} {} {} {}", lattice.count[0], lattice.count[1], lattice.count[2], text_of(lattice.centre),
                     text_of(lattice.spacing), text_of(lattice.rotation));
}
std::string text_of(const mesh::AtRandom& random) {
  return fmt::format("random {} {} {} {} {}", random.count, text_of(random.low), text_of(random.high), random.seed,
                     random.random_rotation);
}

std::string text_of(const thermal::Region& region) {
  const std::string body = fmt::format("body {} {}", region.body.value(), region.surface.value_or(""));
  if (!region.within) return body;
  return fmt::format("{} {} {}", body, text_of(region.within->min()), text_of(region.within->max()));
}
// A function that is no number is told by its value at one place and time.
std::string text_of(const Function& f) {
  return fmt::format("{} {} {}", f(Eigen::Vector3d(0.1, 0.2, 0.3), 7), f.varies_in_place(), f.varies_in_time());
}
std::string text_of(const thermal::FixedTemperature& c) {
  return fmt::format("temperature {}", text_of(c.temperature));
}
std::string text_of(const thermal::HeatFlux& c) {
  return fmt::format("flux {}", text_of(c.flux));
}
std::string text_of(const thermal::HeatFlow& c) {
  return fmt::format("flow {}", text_of(c.flow));
}
std::string text_of(const thermal::Convection& c) {
  return fmt::format("convection {} {}", text_of(c.coefficient), text_of(c.surroundings));
}
std::string text_of(const thermal::Radiation& c) {
  return fmt::format("radiation {} {}", text_of(c.emissivity), text_of(c.surroundings));
}

std::string text_of(const rigid::SettleOptions& o) {
  return fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {}", text_of(o.gravity), o.limit, o.step, o.local_damping,
                     o.viscous_damping, o.release_time, o.rest_displacement, o.clearance, o.iterations, o.rest_speed,
                     o.rest_unbalanced_force, o.rest_window, o.frame_interval);
}

std::string text_of(const thermal::JointLaw& law) {
  double value = 0;
  if (const auto* beta = std::get_if<thermal::StiffnessFactor>(&law)) value = beta->factor;
  if (const auto* h = std::get_if<thermal::JointConductance>(&law)) value = h->conductance;
  return fmt::format("{} {}", thermal::name_of(law), value);
}

std::string text_of(const std::optional<contact::Model>& model) {
  return model ? fmt::format("{}", static_cast<int>(*model)) : "none";
}

std::string text_of(const thermal::HeatOptions& heat) {
  std::string text = "initial";
  for (const Function& value : heat.initial_temperature) text += fmt::format(" {}", text_of(value));
  for (const auto& b : heat.boundaries) {
    text += fmt::format("\nboundary {} {} {}", b.name, text_of(b.region),
                        std::visit([](const auto& c) { return text_of(c); }, b.condition));
  }
  for (const auto& s : heat.sources) text += fmt::format("\nsource {} {} {}", s.name, text_of(s.region), text_of(s.power));
  text +=
      fmt::format("\njoint {} {} {}", text_of(heat.joint.law), text_of(heat.joint.model), static_cast<int>(heat.joint.form));
  for (const auto& rule : heat.joint.rules) {
    const bool bodies = rule.between.index() == 0;
    const auto pair =
        std::visit([](const auto& ids) { return fmt::format("{} {}", ids[0].value(), ids[1].value()); }, rule.between);
    text += fmt::format("\nrule {} {} {} {}", bodies, pair, text_of(rule.law), text_of(rule.model));
  }
  text += fmt::format("\nblocks {} {}", static_cast<int>(heat.blocks.model), heat.blocks.largest_biot);
  for (const auto& [body, model] : heat.blocks.of_body) text += fmt::format(" {} {}", body.value(), static_cast<int>(model));
  text += fmt::format("\nspace order {}", static_cast<int>(heat.space_order));
  const thermal::TimeOptions& time = heat.time;
  return text + fmt::format("\ntime {} {} {} {} {} {}", time.until, time.tolerance, time.output_every,
                            static_cast<int>(time.integrator), static_cast<int>(time.solver), text_of(time.step));
}

}  // namespace

const char* const whole_scene = R"(# A block on a plate.
title: whole
materials:
  ore: {density: 2500, conductivity: 3.1, specific_heat: 880}
  ice: {density: 917}
bodies:
  plate:
    box: {size: [2, 2, 0.05], centre: [0, 0, -0.025]}
    material: ore
    mesh_size: 5 cm
    fixed: true
  block:
    sphere: {diameter: 0.4, centre: [0, 0, 0.5]}
    material: ore
    mesh_size: 0.04
settle: {}
heat:
  initial: 25 degC
  boundaries:
    - {body: plate, temperature: 100 degC}
    - {body: block, flux: 5 kW/m2, within: {low: [0, 0, 0], high: [1, 1, 1]}}
    - {body: block, flow: 3 W}
  sources:
    - {body: block, power: 2 kW/m3}
  until: 12 h
output:
  every: 10 min
  probes:
    low: [0, 0, 0.06]
    high: {point: [0, 0, 0.44]}
)";

Scene scene_of(const std::string& yaml, const std::vector<std::string>& overrides) {
  const auto file = temp_folder() / "s.yaml";
  std::ofstream(file) << yaml;
  return read_scene(file, overrides);
}

std::string wrong_with(const std::string& yaml, const std::vector<std::string>& overrides) {
  try {
    scene_of(yaml, overrides);
  } catch (const InputError& error) {
    std::string text = error.what();
    const std::string folder = temp_folder().string() + "/";
    for (auto at = text.find(folder); at != std::string::npos; at = text.find(folder)) text.erase(at, folder.size());
    return text;
  }
  return "accepted";
}

std::string values_of(const Scene& scene) {
  std::string text = fmt::format("{} {}", scene.title, scene.dimension);
  for (const Material& m : scene.materials) {
    text += fmt::format("\nmaterial {} {} {} {} {} {}", m.name, text_of(m.density), text_of(m.conductivity),
                        text_of(m.specific_heat), m.friction, m.restitution);
  }
  const auto as_text = [](const auto& value) { return text_of(value); };
  for (const mesh::BodySpec& b : scene.bodies) {
    text += fmt::format("\nbody {} {} {} {} {} {} {} {} {}", b.name, std::visit(as_text, b.shape),
                        std::visit(as_text, b.arrangement), b.mesh_size, b.cells ? mesh::kind_name(*b.cells) : "simplex",
                        static_cast<int>(b.blocks), b.material.value(), b.fixed, text_of(b.velocity));
  }
  if (scene.settle) {
    text += fmt::format("\nsettle {} {} {}", text_of(scene.settle->options), scene.settle->largest_overlap,
                        scene.settle->accept_moving);
  }
  if (scene.packing) text += "\npacking " + scene.packing->string();
  if (scene.contact) text += fmt::format("\ncontact {} {}", scene.contact->indentation, scene.contact->tolerance);
  if (scene.heat) text += fmt::format("\nheat {}", text_of(*scene.heat));
  if (const auto& start = scene.initial_field) {
    text += fmt::format("\nstart {} {} {}", start->from.string(), text_of(start->time), start->reach);
  }
  if (const auto& box = scene.effective_window) {
    text += fmt::format("\neffective {} {}", text_of(Eigen::Vector3d(box->min())), text_of(Eigen::Vector3d(box->max())));
  }
  text += fmt::format("\nframes {}", scene.frames_every);
  for (const auto& p : scene.probes) {
    text += fmt::format("\nprobe {} {} {} {}", p.name, text_of(p.point), p.reach, p.exact ? text_of(*p.exact) : "");
  }
  return text;
}

}  // namespace scree::test
