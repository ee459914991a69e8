#include "tools/run/packing_stage.h"

#include <algorithm>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "engine/mesh/cells.h"
#include "engine/mesh/made_from.h"
#include "engine/mesh/make_blocks.h"
#include "engine/output/read_vtu.h"
#include "engine/output/series.h"
#include "engine/rigid/rest_window.h"
#include "engine/rigid/settle.h"
#include "tools/run/begin_results.h"
#include "tools/run/frames.h"
#include "tools/run/keys.h"
#include "tools/run/preflight.h"
#include "tools/scene/read_scene.h"
#include "tools/scene/suspicions.h"

namespace scree::run {

namespace {

[[noreturn]] void refuse_packing(const Scene& scene, const std::string& rule) {
  Problem problem;
  problem.where = scene.packing_at;
  if (!scene.packing) problem.where.file = scene.file.string();
  problem.key = "packing";
  problem.value = scene.packing ? scene.packing->string() : "of another scene";
  problem.rule = rule;
  problem.suggestion = "Name the bodies of the scene that made the packing, in its order";
  throw InputError(problem);
}

// What the scene says of a body otherwise than the packing would go unheard: the packing's blocks are heated.
void compare_making(const mesh::Body& body, const mesh::BodySpec& spec, mesh::Places places, std::vector<Problem>& problems) {
  for (const auto& difference : mesh::differences(body.made_from, mesh::made_from(spec), places)) {
    problems.push_back({{},
                        fmt::format("bodies.{}.{}", spec.name, difference.key),
                        difference.second,
                        fmt::format("must be as in the packing: {}", difference.first),
                        "Say what the scene that made the packing says, or settle anew"});
  }
}

// Heat is looked for across gaps of contact.tolerance times the length of an element at a surface: blocks held further apart
// would not feel each other. Without heat a clearance must be small beside the blocks.
void check_clearance(const Scene& scene, const mesh::BlockMesh<3>& blocks) {
  constexpr double small = 0.1;  // of the length of an element
  const double clearance = scene.settle->options.clearance;
  if (clearance == 0) return;
  double shortest = std::numeric_limits<double>::infinity();
  const mesh::CharacteristicLength<3> lengths(blocks);
  for (const auto& face : mesh::boundary_faces(blocks)) shortest = std::min(shortest, lengths.of(face.element));
  const double most = (scene.contact ? 0.5 * scene.contact->tolerance : small) * shortest;
  if (clearance <= most) return;
  Problem problem;
  problem.where = scene.settle->clearance_at;
  problem.key = "settle.clearance";
  problem.value = fmt::format("{:g} m", clearance);
  problem.rule =
      scene.contact
          ? fmt::format("must be at most {:.3g} m, half of the gap across which contacts are found at the smallest elements",
                        most)
          : fmt::format("must be at most {:.3g} m, a tenth of the smallest elements at a surface", most);
  problem.suggestion = scene.contact ? "Lower it, or raise contact.tolerance" : "Lower it";
  throw InputError(problem);
}

// What settle.limit alone cannot be told: in weak gravity a window is longer than the one that is asked for.
void check_rest_window(const Scene& scene, const mesh::BlockMesh<3>& blocks) {
  const rigid::SettleOptions& options = scene.settle->options;
  const double window = rigid::rest_window(options, mesh::mean_edge(blocks));
  if (scene.settle->accept_moving || options.limit >= window) return;
  Problem problem;
  problem.key = "settle.limit";
  problem.value = fmt::format("{:g} s", options.limit);
  problem.rule = fmt::format(
      "must be at least {:.3g} s: so long must a pile be at rest where gravity moves a block by settle.rest_displacement so "
      "slowly",
      window);
  problem.suggestion = "Raise it, or lower settle.rest_displacement";
  throw InputError(problem);
}

// What is wrong with the file is said at the place where the scene names it.
template <int dim>
packing::Packing<dim> read_named(const Scene& scene) {
  try {
    return packing::read<dim>(*scene.packing);
  } catch (const InputError& error) {
    std::vector<Problem> problems = error.problems();
    for (Problem& problem : problems) {
      problem.where = scene.packing_at;
      problem.value = fmt::format("{}, {}", scene.packing->string(), problem.value);
    }
    throw InputError(std::move(problems));
  }
}

// Whoever names a packing accepts it as it is, which the run that made it may not have done; `settle.accept_moving` accepts one
// that moves.
template <int dim>
void note_unsettled(RunContext& context, const packing::Packing<dim>& packing) {
  if (!packing.settled) return;
  const packing::SettleReport& report = *packing.settled;
  if (!report.at_rest) context.remark("packing: its blocks were still moving when it was written");
  const double overlap = report.max_penetration / report.mean_edge;
  if (overlap > SettleStage{}.largest_overlap) {
    context.remark(fmt::format("packing: two of its blocks overlap by {:.3g} of the mean edge", overlap));
  }
}

template <int dim>
void note_overlaps(RunContext& context, const mesh::BlockMesh<dim>& blocks, packing::Pairs asked) {
  for (const std::string& sentence : overlapping_blocks(blocks, asked)) context.remark("suspicious: " + sentence);
}

packing::Packing<3> settle(RunContext& context, const mesh::BlockMesh<3>& blocks) {
  const SettleStage& stage = *context.scene.settle;
  output::Series series(context.files.directory, settle_series);
  std::error_code ignored;
  std::filesystem::remove(context.files.picture(settle_series), ignored);  // of an earlier fall
  const auto ids = blocks.blocks.ids();
  const auto identity = identity_arrays(blocks, Table<BlockId, BlockId>(std::vector(ids.begin(), ids.end())));
  const auto frame = [&](double time, const Table<BlockId, Pose>& poses) {
    series.write(grid_at(blocks, poses), {time, {}, identity});
  };
  const auto progress = [&](double time, double rms_speed) {
    check_interrupt();
    context.progress.update(time / stage.options.limit, fmt::format("{:.2f} s, rms speed {:.1e} m/s", time, rms_speed));
  };
  return rigid::settle(blocks, context.scene.materials, stage.options, frame, progress);
}

// Of the same blocks and the same fall; nothing if it is damaged.
std::optional<packing::Packing<3>> earlier_packing(RunContext& context) {
  const std::string file = context.files.packing().string();
  try {
    auto earlier = packing::read<3>(context.files.packing());
    context.progress.note(fmt::format("settle: nothing it depends on has changed; using {}", file));
    return earlier;
  } catch (const InputError&) {
    context.progress.note(fmt::format("settle: {} is damaged; the blocks fall again", file));
    return std::nullopt;
  }
}

PackingOutcome<3> settled(RunContext& context, const mesh::BlockMesh<3>& blocks, const std::string& key) {
  check_fall(context.scene, blocks);
  check_heat(context.scene, blocks);
  // Of blocks that are let go one after the other those that wait may lie where others were before.
  if (context.scene.settle->options.release_time == 0) note_overlaps(context, blocks, packing::Pairs::with_a_free_block);
  if (packing::stored_key(context.files.packing()) == key) {
    if (auto earlier = earlier_packing(context)) return {*std::move(earlier), true};
  }
  begin_results(context);
  std::error_code ignored;
  std::filesystem::remove(context.files.packing(), ignored);  // of another scene
  auto packing = context.stage("settle", fmt::format("{} of {} blocks fall", free_blocks(blocks), blocks.blocks.size()),
                               [&] { return settle(context, blocks); });
  return {std::move(packing), false};
}

}  // namespace

template <int dim>
std::size_t free_blocks(const mesh::BlockMesh<dim>& mesh) {
  return static_cast<std::size_t>(std::count_if(mesh.blocks.begin(), mesh.blocks.end(),
                                                [&](const mesh::Block& block) { return !mesh.bodies[block.body].fixed; }));
}

bool is_placed(const Scene& scene) {
  return !scene.settle && !scene.packing;
}

template <int dim>
Table<BodyId, mesh::Body> adopted_bodies(const Scene& scene, const packing::Packing<dim>& packing) {
  Table<BodyId, mesh::Body> bodies = packing.mesh.bodies;
  if (bodies.size() != scene.bodies.size()) {
    refuse_packing(scene, fmt::format("it holds {} bodies, the scene {}", bodies.size(), scene.bodies.size()));
  }
  std::vector<Problem> problems;
  for (const BodyId id : bodies.ids()) {
    const mesh::BodySpec& spec = scene.bodies[id.index()];
    if (bodies[id].name != spec.name) {
      refuse_packing(scene,
                     fmt::format("its body {} is called {}, the scene's {}", id.index() + 1, bodies[id].name, spec.name));
    }
    bodies[id].material = spec.material;
    const bool stays = bodies[id].fixed || !packing.settled;
    compare_making(bodies[id], spec, stays ? mesh::Places::compared : mesh::Places::left_out, problems);
  }
  if (!problems.empty()) throw located(scene, InputError(std::move(problems)));
  return bodies;
}

void check_fall(const Scene& scene, const mesh::BlockMesh<3>& blocks) {
  check_clearance(scene, blocks);
  check_rest_window(scene, blocks);
}

template <int dim>
packing::Packing<dim> stored_packing(const Scene& scene) {
  auto packing = read_named<dim>(scene);
  packing.mesh.bodies = adopted_bodies(scene, packing);
  return packing;
}

template <int dim>
PackingOutcome<dim> packing_stage(RunContext& context) {
  if (context.scene.packing) {
    auto packing = context.stage("packing", fmt::format("reading {}", context.scene.packing->string()),
                                 [&] { return stored_packing<dim>(context.scene); });
    note_unsettled(context, packing);
    return {std::move(packing), false};
  }
  auto blocks = context.stage("mesh", fmt::format("{} bodies", context.scene.bodies.size()),
                              [&] { return mesh::make_blocks<dim>(context.scene.bodies, output::mesh_readers()); });
  const std::string key = packing_key(context.scene, blocks);
  PackingOutcome<dim> outcome;
  if (context.scene.settle) {
    if constexpr (dim == 3) outcome = settled(context, blocks, key);
  } else {
    note_overlaps(context, blocks, packing::Pairs::of_different_bodies);
    outcome = {packing::unmoved<dim>(std::move(blocks)), false};
  }
  if (context.scene.settle && context.scene.settle->accept_moving) note_unsettled(context, outcome.packing);
  outcome.packing.key = key;
  if (context.scene.settle && !outcome.reused) packing::write(outcome.packing, context.files.packing());
  return outcome;
}

template <int dim>
void keep_placed(const RunContext& context, const packing::Packing<dim>& packing) {
  if (is_placed(context.scene)) packing::write(packing, context.files.packing());
}

template Table<BodyId, mesh::Body> adopted_bodies<2>(const Scene&, const packing::Packing<2>&);
template Table<BodyId, mesh::Body> adopted_bodies<3>(const Scene&, const packing::Packing<3>&);
template packing::Packing<2> stored_packing<2>(const Scene&);
template packing::Packing<3> stored_packing<3>(const Scene&);
template void keep_placed<2>(const RunContext&, const packing::Packing<2>&);
template void keep_placed<3>(const RunContext&, const packing::Packing<3>&);
template PackingOutcome<2> packing_stage<2>(RunContext&);
template PackingOutcome<3> packing_stage<3>(RunContext&);
template std::size_t free_blocks<2>(const mesh::BlockMesh<2>&);
template std::size_t free_blocks<3>(const mesh::BlockMesh<3>&);

}  // namespace scree::run
