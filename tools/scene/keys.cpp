// The one table. A default is the default of the struct that a key fills, so that a scene and a test say the same.
#include "tools/scene/keys.h"

#include <fmt/format.h>

#include "contact/find_contacts.h"
#include "engine/base/material.h"
#include "engine/mesh/body_spec.h"
#include "engine/output/probes.h"
#include "engine/rigid/settle.h"
#include "thermal/heat_options.h"
#include "tools/scene/heat_keys.h"
#include "tools/scene/key_lists.h"
#include "tools/scene/scene.h"

namespace scree {

namespace {

using enum KeyType;
namespace q = quantity;

constexpr auto vector = Count::per_dimension;

// A default vector. Scenes in 2-D leave z away, and no key with such a default is for them.
std::string as_list(const Eigen::Vector3d& value) {
  return fmt::format("[{}, {}, {}]", value.x(), value.y(), value.z());
}

const Condition in_3d{"dimension", "3"};
const std::vector<Condition> one_copy{{.key = "bodies.*.lattice", .absent = true},
                                      {.key = "bodies.*.random", .absent = true},
                                      {.key = "bodies.*.at", .absent = true}};

// A rotation below `parent`.
Keys rotation(const std::string& parent, const std::vector<Condition>& only = {},
              const std::string& what = "Turns the shape about its own origin") {
  const std::string path = parent + ".rotation";
  return {
      row(path, quantity, what + ": {axis, angle}, or a quaternion [w, x, y, z].", q::number)
          .count(Count::four)
          .otherwise("not turned")
          .only(only),
      row(path + ".axis", quantity, "Axis of the rotation; in 2-D it is z.", q::number).count(vector).required().only({in_3d}),
      row(path + ".angle", quantity, "Angle of the rotation, right-handed about the axis.", q::angle).required(),
  };
}

Keys root_keys() {
  return {
      row("title", text, "What the scene shows.").fallback("\"\""),
      row("dimension", word, "Space: 2 for triangles of unit thickness, 3 for tetrahedra.").words({"2", "3"}).fallback("3"),
      row("packing", path,
          "Packing file to start from, instead of settling: blocks, their places and which are fixed are the file's.")
          .choice("start"),
  };
}

Keys material_keys() {
  const Material by_default;
  Keys keys{
      row("materials", names, "What bodies are made of.").range(at_least_one).required(),
      row("materials.*", section, "One material."),
      row("materials.*.density", quantity, "Mass per volume.", q::density, positive)
          .otherwise("needed to settle and for heat in time"),
      row("materials.*.conductivity", quantity, "Thermal conductivity: one number, one for each axis, or a map.",
          q::conductivity, positive)
          .count(Count::one_or_per_dimension)
          .depends(Depends::on_temperature)
          .otherwise("needed for heat"),
      row("materials.*.conductivity.value", quantity, "Along the first principal axis.", q::conductivity, positive)
          .required()
          .choice("form"),
      row("materials.*.conductivity.ratio", quantity, "Conductivity along each principal axis over the value.", q::number,
          positive)
          .count(vector)
          .otherwise("the same along all"),
  };
  append(keys, rotation("materials.*.conductivity", {}, "Turns the principal axes out of the body's"));
  append(keys,
         {
             row("materials.*.specific_heat", quantity, "Heat capacity per mass.", q::specific_heat, positive)
                 .depends(Depends::on_temperature)
                 .otherwise("needed for heat in time"),
             row("materials.*.friction", quantity, "Coulomb coefficient between two bodies of this material.", q::number,
                 not_negative)
                 .fallback(fmt::format("{}", by_default.friction)),
             row("materials.*.restitution", quantity, "Rebound speed over impact speed between two bodies of this material.",
                 q::number, Range{.low = 0, .high = 1})
                 .fallback(fmt::format("{}", by_default.restitution)),
         });
  return keys;
}

Keys shape_keys() {
  const std::string centre = "Where its centre is.";
  Keys keys{
      row("bodies.*.box", section, "A box, or a rectangle in 2-D.").required().choice("shape"),
      row("bodies.*.box.size", quantity, "Its edge lengths.", q::length, positive).count(vector).required(),
      row("bodies.*.box.centre", quantity, centre, q::length).count(vector).required().only(one_copy),
  };
  append(keys, rotation("bodies.*.box", one_copy));
  append(keys, {
                   row("bodies.*.sphere", section, "A sphere, or a disc in 2-D.").required().choice("shape"),
                   row("bodies.*.sphere.diameter", quantity, "Its diameter.", q::length, positive).required(),
                   row("bodies.*.sphere.centre", quantity, centre, q::length).count(vector).required().only(one_copy),
                   row("bodies.*.cylinder", section, "A cylinder along z.").required().choice("shape").only({in_3d}),
                   row("bodies.*.cylinder.diameter", quantity, "Its diameter.", q::length, positive).required(),
                   row("bodies.*.cylinder.height", quantity, "Its length along its axis.", q::length, positive).required(),
                   row("bodies.*.cylinder.centre", quantity, centre, q::length).count(vector).required().only(one_copy),
               });
  append(keys, rotation("bodies.*.cylinder", one_copy));
  append(keys,
         {
             row("bodies.*.mesh", section, "A closed surface or a volume mesh from a file.").required().choice("shape"),
             row("bodies.*.mesh.file", path, "An .stl surface, or a Gmsh .msh 4 or .vtu mesh.").required(),
             row("bodies.*.mesh.scale", quantity, "Length of the file's unit.", q::length, Range{.low = 1e-30}).fallback("1 m"),
             row("bodies.*.mesh.position", quantity, "Where the file's origin goes.", q::length)
                 .count(vector)
                 .required()
                 .only(one_copy),
         });
  append(keys, rotation("bodies.*.mesh", one_copy));
  return keys;
}

Keys copy_keys() {
  Keys keys{
      row("bodies.*.lattice", section, "Copies of the shape on a regular lattice.").choice("arrangement"),
      row("bodies.*.lattice.count", integer, "Copies along each axis.")
          .range(Range{.low = 1, .high = 1000000})
          .count(vector)
          .required(),
      row("bodies.*.lattice.spacing", quantity, "Distance from centre to centre along each axis.", q::length, positive)
          .count(vector)
          .required(),
      row("bodies.*.lattice.centre", quantity, "Centre of the lattice.", q::length).count(vector).required(),
  };
  append(keys, rotation("bodies.*.lattice"));
  append(keys, {
                   row("bodies.*.random", section, "Copies at random places whose bounding spheres do not overlap.")
                       .choice("arrangement"),
                   row("bodies.*.random.count", integer, "How many.").range(Range{.low = 1, .high = 10000000}).required(),
                   row("bodies.*.random.low", quantity, "Corner of the box that holds the copies whole.", q::length)
                       .count(vector)
                       .required(),
                   row("bodies.*.random.high", quantity, "Its opposite corner.", q::length).count(vector).required(),
                   row("bodies.*.random.seed", integer, "Another seed gives another arrangement.")
                       .range(not_negative)
                       .fallback(fmt::format("{}", mesh::AtRandom{}.seed)),
                   row("bodies.*.random.rotate", flag, "Turn each copy at random, too.")
                       .fallback(fmt::format("{}", mesh::AtRandom{}.random_rotation)),
                   row("bodies.*.at", KeyType::list, "Copies at given places.").range(at_least_one).choice("arrangement"),
                   row("bodies.*.at[]", section, "One copy."),
                   row("bodies.*.at[].position", quantity,
                       "Where the shape's origin goes: its centre, or the origin of a mesh file.", q::length)
                       .count(vector)
                       .required(),
               });
  append(keys, rotation("bodies.*.at[]"));
  return keys;
}

Keys body_keys() {
  Keys keys{
      row("bodies", names, "What there is, in this order.").range(at_least_one).required(),
      row("bodies.*", section, "One body: a shape, at one place or in many copies."),
      row("bodies.*.material", name, "What it is made of.").required(),
      row("bodies.*.mesh_size", quantity, "Edge length of its elements aimed at.", q::length, positive).required(),
      row("bodies.*.elements", word, "Kind of element in 2-D: simplex, quadrilateral; in 3-D: simplex, wedge, hexahedron.")
          .words({"simplex", "quadrilateral", "wedge", "hexahedron"})
          .fallback("simplex")
          .only({Condition{.key = "bodies.*.mesh", .absent = true}}),
      row("bodies.*.blocks", word, "One block per copy of the shape, or one per element.")
          .words({"whole", "per_element"})
          .fallback("whole"),
      row("bodies.*.fixed", flag, "It never moves.").fallback("false"),
      row("bodies.*.velocity", quantity, "At the start.", q::speed, Range{.low = -1e6, .high = 1e6})
          .count(vector)
          .otherwise("at rest")
          .only({in_3d, Condition{.key = "bodies.*.fixed", .word = "true", .absent = true}}),
  };
  append(keys, shape_keys());
  append(keys, copy_keys());
  return keys;
}

Keys settle_keys() {
  const rigid::SettleOptions by_default;
  return {
      row("settle", section, "The free bodies fall and come to rest; without it they stay where they are.")
          .choice("start")
          .only({in_3d}),
      row("settle.gravity", quantity, "Acceleration of free fall.", q::acceleration, Range{.low = -1e8, .high = 1e8})
          .count(vector)
          .fallback(as_list(by_default.gravity)),
      row("settle.limit", quantity, "Longest simulated time.", q::time, positive).fallback(with_unit(by_default.limit, "s")),
      row("settle.step", quantity, "Time step.", q::time, positive).fallback(with_unit(by_default.step, "s")),
      row("settle.local_damping", quantity, "Cundall's local damping factor.", q::number,
          Range{.low = 0, .high = 1, .high_open = true})
          .fallback(fmt::format("{}", by_default.local_damping)),
      row("settle.viscous_damping", quantity, "Drag per mass while the blocks fall; they come to rest without it.", q::rate,
          not_negative)
          .fallback(with_unit(by_default.viscous_damping, "s-1")),
      row("settle.release_time", quantity,
          "Blocks are let go one by one over this time, from the lower rim to the middle of the top; 0: all at once.", q::time,
          not_negative)
          .fallback(with_unit(by_default.release_time, "s")),
      row("settle.rest_speed", quantity, "Root mean square speed below which the pile may be at rest.", q::speed, positive)
          .fallback(with_unit(by_default.rest_speed, "m/s")),
      row("settle.rest_unbalanced_force", quantity,
          "Largest mean net force on a block over the mean force of a touching pair at rest.", q::number, positive)
          .fallback(fmt::format("{}", by_default.rest_unbalanced_force)),
      row("settle.rest_displacement", quantity,
          "Largest way of a block in a window, over the mean edge or its own width, at rest.", q::number, positive)
          .fallback(fmt::format("{}", by_default.rest_displacement)),
      row("settle.rest_window", quantity, "All three must hold for this long.", q::time, positive)
          .fallback(with_unit(by_default.rest_window, "s")),
      row("settle.clearance", quantity, "Blocks come to rest this far apart, so that no two overlap; 0: they touch.", q::length,
          not_negative)
          .fallback(with_unit(by_default.clearance, "m")),
      row("settle.iterations", integer, "Iterations of the contact solver in each step.")
          .range(Range{.low = 1, .high = 10000})
          .fallback(fmt::format("{}", by_default.iterations)),
      row("settle.frame_interval", quantity, "Between the frames of the series settle.pvd; a step at least.", q::time, positive)
          .fallback(with_unit(by_default.frame_interval, "s")),
      row("settle.seed", integer,
          "Another seed starts every free body aside by up to a thousandth of its mesh_size, for another packing; 0: as "
          "placed.")
          .range(Range{.low = 0, .high = 1e9})
          .fallback(fmt::format("{}", SettleStage{}.seed)),
      row("settle.largest_overlap", quantity,
          "Largest overlap of two blocks at the end, over the mean edge, that is no failure.", q::number, positive)
          .fallback("0.02"),
      row("settle.accept_moving", flag, "A pile that still moves at the limit is no failure.").fallback("false"),
  };
}

Keys contact_keys() {
  const contact::ContactOptions by_default;
  const Condition heat{"heat"};
  constexpr Range two{.low = 2, .high = 2};
  return {
      row("contact", section, "How heat passes between blocks.").fallback("{}").only({heat}),
      row("contact.model", word, "Semi-springs of Li and Feng (2016), or the exact overlap of two faces.")
          .words({"semi_spring", "overlap"})
          .otherwise("semi_spring with a stiffness factor, overlap with a conductance"),
      row("contact.indentation", quantity, "Way of a semi-spring from its vertex to the centre of its face.", q::number,
          Range{.low = 0, .high = 1, .low_open = true, .high_open = true})
          .fallback(fmt::format("{}", by_default.indentation)),
      row("contact.tolerance", quantity, "Largest gap or depth that counts as touching, in edge lengths of the element.",
          q::number, Range{.low = 0, .high = 100, .low_open = true})
          .fallback(fmt::format("{}", by_default.tolerance)),
      row("contact.stiffness_factor", quantity, "Factor beta of a contact's conductance, beta k/dL per area.", q::number,
          not_negative)
          .fallback(fmt::format("{}", thermal::StiffnessFactor{}.factor))
          .only({Condition{.key = "contact.conductance", .absent = true}, Condition{.key = "contact.perfect", .absent = true},
                 Condition{.key = "contact.insulating", .absent = true}}),
      row("contact.conductance", quantity, "Of every joint, whatever the mesh.", q::heat_transfer, not_negative).choice("law"),
      row("contact.perfect", word, "Blocks are tied where they lie on each other: no joint resists.")
          .words({"true"})
          .choice("law"),
      row("contact.insulating", word, "No heat passes between blocks.").words({"true"}).choice("law"),
      row("contact.joints", KeyType::list, "Joints that differ; the last that speaks of two bodies holds.").fallback("[]"),
      row("contact.joints[]", section, "The joints between two bodies, or between all bodies of two materials."),
      row("contact.joints[].bodies", KeyType::list, "Two bodies; one twice for the joints within it.")
          .range(two)
          .required()
          .choice("pair"),
      row("contact.joints[].bodies[]", name, "One of them.").required(),
      row("contact.joints[].materials", KeyType::list, "Two materials; one twice for the joints within it.")
          .range(two)
          .required()
          .choice("pair"),
      row("contact.joints[].materials[]", name, "One of them.").required(),
      row("contact.joints[].model", word, "As contact.model, for these joints.")
          .words({"semi_spring", "overlap"})
          .otherwise("as contact.model"),
      row("contact.joints[].stiffness_factor", quantity, "Factor beta.", q::number, not_negative).required().choice("law"),
      row("contact.joints[].conductance", quantity, "Whatever the mesh.", q::heat_transfer, not_negative)
          .required()
          .choice("law"),
      row("contact.joints[].perfect", word, "Tied where they lie on each other.").words({"true"}).required().choice("law"),
      row("contact.joints[].insulating", word, "No heat passes.").words({"true"}).required().choice("law"),
      row("contact.form", word, "Temperatures at the contact point on both sides, or as printed: at the owner's vertex.")
          .words({"consistent", "literal"})
          .fallback("consistent"),
  };
}

Keys output_keys() {
  return {
      row("output", section, "What a run writes of the temperatures.").fallback("{}").only({Condition{"heat"}}),
      row("output.every", quantity, "Time between the rows of probes.csv. Steps may be longer.", q::time, positive)
          .otherwise("output.frames_every, or else a sixtieth of heat.until")
          .only({Condition{.key = "heat.steady", .word = "true", .absent = true}}),
      row("output.frames_every", quantity, "Time between the frames of heat.pvd, a multiple of output.every.", q::time,
          positive)
          .otherwise("output.every, or if that is not given either a twelfth of heat.until")
          .only({Condition{.key = "heat.steady", .word = "true", .absent = true}}),
      row("output.probes", names, "Points whose temperature is followed.").fallback("{}"),
      row("output.probes.*", quantity, "One point, as a list or with its reach.", q::length).count(vector),
      row("output.probes.*.point", quantity, "Where it is.", q::length).count(vector).required(),
      row("output.probes.*.reach", quantity, "How far it may be moved to lie in a block.", q::length, not_negative)
          .fallback(with_unit(output::ProbeSpec{}.reach, "m")),
      row("output.probes.*.exact", quantity, "The temperature there as known from elsewhere, to compare with.", q::temperature,
          not_negative)
          .depends(Depends::on_place_and_time)
          .otherwise("not known"),
  };
}

KeyTable make_table() {
  Keys keys = root_keys();
  for (auto& part : {material_keys(), body_keys(), settle_keys(), contact_keys(), heat_keys(), output_keys()})
    append(keys, part);
  return KeyTable(std::move(keys));
}

}  // namespace

const KeyTable& scene_keys() {
  static const KeyTable table = make_table();
  return table;
}

}  // namespace scree
