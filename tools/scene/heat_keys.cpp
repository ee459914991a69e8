#include "tools/scene/heat_keys.h"

#include "engine/output/stored_field.h"
#include "thermal/heat_options.h"
#include "tools/scene/key_lists.h"

namespace scree {

namespace {

using enum KeyType;
namespace q = quantity;

constexpr auto vector = Count::per_dimension;

// Where a region below `parent` ends.
Keys within(const std::string& parent, const std::string& meaning) {
  return {
      row(parent + ".within", section, meaning).otherwise("the whole body"),
      row(parent + ".within.low", quantity, "Its corner with the least coordinates.", q::length).count(vector).required(),
      row(parent + ".within.high", quantity, "Its corner with the largest coordinates.", q::length).count(vector).required(),
  };
}

Key surroundings(const std::string& parent) {
  return row(parent + ".surroundings", quantity, "T_s.", q::temperature, not_negative)
      .depends(Depends::on_place_and_time)
      .required();
}

Keys boundary_keys() {
  Keys keys{
      row("heat.boundaries", KeyType::list, "What happens at the surface of bodies; elsewhere it is insulated.").fallback("[]"),
      row("heat.boundaries[]", section, "One boundary."),
      row("heat.boundaries[].body", name, "The body it is on.").required(),
      row("heat.boundaries[].surface", name,
          "Only on this surface: x_low to z_high, side, bottom, top, surface of a sphere, a physical group of an .msh.")
          .otherwise("the whole body"),
      row("heat.boundaries[].temperature", quantity, "Held at every node of the part, inner ones too.", q::temperature,
          not_negative)
          .depends(Depends::on_place_and_time)
          .required()
          .choice("condition"),
      row("heat.boundaries[].flux", quantity, "Into the body, through every face in the part.", q::heat_flux)
          .depends(Depends::on_place_and_time)
          .required()
          .choice("condition"),
      row("heat.boundaries[].flow", quantity, "Into the body in all, spread over the faces in the part.", q::heat_flow)
          .depends(Depends::on_place_and_time)
          .required()
          .choice("condition"),
      row("heat.boundaries[].convection", section,
          "Exchange h (T_s - T) with the surroundings, through every face in the part, covered by other blocks or not.")
          .required()
          .choice("condition"),
      row("heat.boundaries[].convection.coefficient", quantity, "h.", q::heat_transfer, not_negative)
          .depends(Depends::on_place_and_time)
          .required(),
      surroundings("heat.boundaries[].convection"),
      row("heat.boundaries[].radiation", section,
          "Exchange sigma epsilon (T_s^4 - T^4), through every face in the part, covered by other blocks or not.")
          .required()
          .choice("condition"),
      row("heat.boundaries[].radiation.emissivity", quantity, "epsilon.", q::number, Range{.low = 0, .high = 1})
          .depends(Depends::on_place_and_time)
          .required(),
      surroundings("heat.boundaries[].radiation"),
      row("heat.boundaries[].name", name, "How the ledger of heat calls it.").otherwise("kind and body"),
  };
  append(
      keys,
      within(
          "heat.boundaries[]",
          "An axis-aligned box: what it cuts out of the surface; without a surface whole faces; of temperatures the nodes."));
  append(
      keys,
      {
          row("heat.sources", KeyType::list, "Heat set free inside bodies.").fallback("[]"),
          row("heat.sources[]", section, "One source."),
          row("heat.sources[].body", name, "The body it is in.").required(),
          row("heat.sources[].power", quantity, "Per volume.", q::power_density).depends(Depends::on_place_and_time).required(),
          row("heat.sources[].name", name, "How the ledger of heat calls it.").otherwise("kind and body"),
      });
  append(keys, within("heat.sources[]", "An axis-aligned box of space: what it cuts out of the elements."));
  return keys;
}

Keys initial_keys() {
  return {
      row("heat.initial", quantity, "Temperature at the start, of all bodies or of each by its name, or an earlier run's.",
          q::temperature, not_negative)
          .depends(Depends::on_place_and_time)
          .required(),
      row("heat.initial.*", quantity, "Of this body.", q::temperature, not_negative).depends(Depends::on_place_and_time),
      row("heat.initial.from", path, "Output directory of an earlier run, or a .vtu or .pvd file with temperatures.")
          .required()
          .choice("form"),
      row("heat.initial.time", quantity, "Which of its times.", q::time, not_negative)
          .otherwise("the last")
          .only({Condition{"heat.initial.from"}}),
      row("heat.initial.reach", quantity, "How far a node may lie outside its mesh.", q::length, not_negative)
          .fallback(with_unit(output::StoredField{}.reach, "m"))
          .only({Condition{"heat.initial.from"}}),
  };
}

Keys block_keys() {
  const auto word_row = [](const char* path, const char* meaning) {
    return row(path, word, meaning).words({"meshed", "lumped", "auto"});
  };
  return {
      row("heat.blocks", section, "Whether a block has a temperature per node or only one.").otherwise("all are meshed"),
      word_row("heat.blocks.model", "A temperature per node, one, or one where the Biot number is small.").fallback("meshed"),
      row("heat.blocks.largest_biot", quantity, "The Biot number below which auto takes one temperature.", q::number,
          not_negative)
          .fallback(fmt::format("{}", thermal::BlockOptions{}.largest_biot)),
      row("heat.blocks.bodies", names, "Bodies whose blocks differ.").fallback("{}"),
      word_row("heat.blocks.bodies.*", "As heat.blocks.model, for the blocks of this body."),
  };
}

Keys time_keys() {
  const thermal::TimeOptions by_default;
  const Condition in_time{.key = "heat.steady", .word = "true", .absent = true};
  const auto without = [](const char* integrator) {
    return Condition{.key = "heat.integrator", .word = integrator, .absent = true};
  };
  return {
      row("heat.steady", flag, "Find the steady state directly, without steps in time.").fallback("false"),
      row("heat.until", quantity, "End of the simulated time.", q::time, positive).required().only({in_time}),
      row("heat.tolerance", quantity, "Largest accepted error of a temperature from the steps in time.",
          q::temperature_difference, positive)
          .fallback(with_unit(by_default.tolerance, "K"))
          .only({in_time}),
      row("heat.integrator", word, "Steps in time.")
          .words({integrator_words.begin(), integrator_words.end()})
          .fallback(integrator_words.front())
          .only({in_time}),
      row("heat.space_order", word,
          "How the error goes down with the mesh size: by its square, or in grids of hexahedra by its fourth power.")
          .words({"2", "4"})
          .fallback("2")
          .only({in_time}),
      row("heat.solver", word, "What solves implicit steps and the steady state: a factorisation or algebraic multigrid.")
          .words({"auto", "cholesky", "multigrid"})
          .fallback("auto")
          .only({without("explicit_euler"), without("stabilised_explicit"),
                 Condition{.key = "heat.space_order", .word = "4", .absent = true}}),
      row("heat.step", quantity, "Time step; equal parts of output.every that are no longer.", q::time, positive)
          .otherwise("largest stable one")
          .only({in_time, Condition{"heat.integrator", "explicit_euler"}}),
  };
}

Keys effective_keys() {
  return {
      row("heat.effective_conductivity", section,
          "Find the effective conductivity tensor of a box of space and its bounds, before anything is heated.")
          .otherwise("not asked for"),
      row("heat.effective_conductivity.low", quantity, "Corner of the box with the least coordinates.", q::length)
          .count(vector)
          .required(),
      row("heat.effective_conductivity.high", quantity, "Its corner with the largest coordinates.", q::length)
          .count(vector)
          .required(),
  };
}

}  // namespace

Keys heat_keys() {
  Keys keys{row("heat", section, "Heat is conducted in the blocks and between them, once they lie.")};
  append(keys, initial_keys());
  append(keys, boundary_keys());
  append(keys, block_keys());
  append(keys, effective_keys());
  append(keys, time_keys());
  return keys;
}

}  // namespace scree
