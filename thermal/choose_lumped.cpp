#include "thermal/choose_lumped.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "thermal/contact_conduction.h"
#include "thermal/exchange.h"
#include "thermal/inner_resistance.h"
#include "thermal/least_value.h"
#include "thermal/problems.h"

namespace scree::thermal {

namespace {

constexpr const char* way_out = "Give it `meshed` in heat.blocks.bodies";

// A point where heat may enter a block. Patches of a block are its neighbours, then the model's exchanges, then its loads.
struct Entry {
  BlockId block;
  std::uint32_t patch;
  std::uint32_t item;  // contact, or position among the nodes of an exchange or a load
  bool owner;          // of the contact

  friend auto operator<=>(const Entry&, const Entry&) = default;
};

struct Held {
  std::size_t nodes = 0;
  int hold = -1;
  bool alike = true;  // by one boundary only
};

template <int dim>
class Chooser {
 public:
  Chooser(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
          const contact::ContactSet<dim>& contacts, const JointConduction& joints, const HeatOptions& options,
          const HeatModel& model)
      : mesh_(mesh),
        materials_(materials),
        contacts_(contacts.contacts),
        joints_(joints),
        options_(options),
        model_(model),
        start_(Drives(model).at(0)),
        wanted_(mesh.blocks.size()),
        held_(mesh.blocks.size()) {
    for (const BlockId b : mesh.blocks.ids()) wanted_[b] = options.blocks.of(mesh.blocks[b].body);
  }

  std::optional<LumpedBlocks> choose() {
    look_at_held();
    look_at_perfect();
    if (!problems_.empty()) throw InputError(problems_);
    find_conductivities();
    std::vector<LumpedBlock> chosen;
    const std::vector<Entry> entries = entries_of_candidates();
    auto first = entries.begin();
    for (const BlockId b : mesh_.blocks.ids()) {
      const auto last = std::find_if(first, entries.end(), [b](const Entry& entry) { return entry.block != b; });
      if (wanted_[b] != BlockModel::meshed) {
        LumpedBlock block = described(b, {first, last});
        if (wanted_[b] == BlockModel::lumped || block.biot < options_.blocks.largest_biot) chosen.push_back(std::move(block));
      }
      first = last;
    }
    if (chosen.empty()) return std::nullopt;
    return LumpedBlocks(std::move(chosen), mesh_.blocks.size(), std::move(conductivities_));
  }

 private:
  using Entries = std::span<const Entry>;

  [[nodiscard]] const std::string& body_name(BlockId block) const { return mesh_.bodies[mesh_.blocks[block].body].name; }
  [[nodiscard]] bool candidate(BlockId block) const { return wanted_[block] != BlockModel::meshed && held_[block].nodes == 0; }

  void refuse(const std::string& value, const std::string& rule, const std::string& suggestion, const SourceLocation& where) {
    if (!refused_.insert(value + rule).second) return;  // once for all blocks of a body
    problems_.push_back(problem("heat.blocks", value, rule, suggestion));
    problems_.back().where = where;
  }

  void look_at_held() {
    for (std::size_t i = 0; i < model_.fixed_nodes.size(); ++i) {
      Held& held = held_[model_.blocks[model_.fixed_nodes[i]]];
      held.alike = held.alike && (held.nodes == 0 || held.hold == model_.fixed_hold[i]);
      held.hold = model_.fixed_hold[i];
      ++held.nodes;
    }
    for (const BlockId b : mesh_.blocks.ids()) {
      const Held& held = held_[b];
      if (held.nodes == 0 || wanted_[b] == BlockModel::meshed) continue;
      if (wanted_[b] == BlockModel::automatic) {
        wanted_[b] = BlockModel::meshed;
        continue;
      }
      const Hold& by = model_.holds[held.hold];
      if (held.nodes == mesh_.blocks[b].nodes.size() && held.alike && !by.temperature.varies_in_place()) continue;
      refuse(fmt::format("a lumped block of {}, of which \"{}\" holds {} of {} nodes", body_name(b), by.name, held.nodes,
                         mesh_.blocks[b].nodes.size()),
             "must be held as a whole, at one temperature, or not at all",
             fmt::format("{}, or hold all of the body, or give it convection instead", way_out), where_of(by.name));
    }
  }

  [[nodiscard]] SourceLocation where_of(const std::string& boundary) const {
    for (const Boundary& candidate : options_.boundaries) {
      if (candidate.name == boundary) return candidate.where;
    }
    return options_.blocks.where;
  }

  void look_at_perfect() {
    for (const PerfectTerm& term : joints_.perfect.terms) {
      for (const BlockId b : {contacts_[term.contact].owner, contacts_[term.contact].target}) {
        if (wanted_[b] == BlockModel::automatic) wanted_[b] = BlockModel::meshed;
        if (wanted_[b] != BlockModel::lumped) continue;
        refuse(fmt::format("a lumped block of {} with a perfect joint", body_name(b)),
               "must have joints that resist: a lumped block stands for one whose inside does not, beside its joints",
               fmt::format("{}, or give its joints a conductance", way_out), options_.blocks.where);
      }
    }
  }

  void add_shares(const NodeShares& on, std::size_t patch, std::vector<Entry>& entries) const {
    for (std::size_t i = 0; i < on.nodes.size(); ++i) {
      const BlockId block = model_.blocks[on.nodes[i]];
      if (candidate(block)) entries.push_back({block, static_cast<std::uint32_t>(patch), static_cast<std::uint32_t>(i), false});
    }
  }

  // Sorted by block and patch.
  [[nodiscard]] std::vector<Entry> entries_of_candidates() const {
    std::vector<Entry> entries;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      const auto [owner, target] = std::pair(contacts_[c].owner, contacts_[c].target);
      const auto item = static_cast<std::uint32_t>(c);
      if (joints_.conductances[c] == 0) continue;
      if (candidate(owner)) entries.push_back({owner, static_cast<std::uint32_t>(target.index()), item, true});
      if (candidate(target)) entries.push_back({target, static_cast<std::uint32_t>(owner.index()), item, false});
    }
    std::size_t patch = mesh_.blocks.size();
    for (const Exchange& exchange : model_.exchanges) add_shares(exchange.on, patch++, entries);
    for (const Load& load : model_.loads) add_shares(load.on, patch++, entries);
    std::sort(entries.begin(), entries.end());
    return entries;
  }

  // A block's patch as its points are counted.
  struct Patch {
    PatchMoments<dim> moments;
    double conductance = 0;  // [W/K]
    double area = 0;         // in which heat passes mostly; 0 if not through a surface [m2]
    double volume = 0;       // in which it is set free mostly; 0 if not in a volume [m3]
    bool load = false;       // heat that comes whatever the temperature
  };

  // In how much of the sizes of some parts heat is mostly set free: of each its heat h and size s, (sum h)^2 / sum h^2/s.
  struct Extent {
    double heat = 0, by_size = 0;

    void add(double with_heat, double size) {
      if (size == 0) return;
      heat += with_heat;
      by_size += with_heat * with_heat / size;
    }
    [[nodiscard]] double size() const { return by_size > 0 ? heat * heat / by_size : 0; }
  };

  [[nodiscard]] LumpedBlock described(BlockId b, const Entries& entries) const {
    LumpedBlock block;
    block.block = b;
    block.material = mesh_.bodies[mesh_.blocks[b].body].material;
    if (entries.empty()) return block;
    const mesh::Block& of = mesh_.blocks[b];
    const Conductivity& conductivity = *materials_[block.material].conductivity;
    const InnerResistance<dim> inside(mesh_, b,
                                      conductivities_[block.material].least * conductivity_ratios<dim>(conductivity, of));
    double constricted = 0;
    for (auto first = entries.begin(); first != entries.end();) {
      const auto last = std::find_if(first, entries.end(), [&](const Entry& e) { return e.patch != first->patch; });
      PatchResistance largest;
      for (const Patch& patch : patches_of({first, last}, inside)) {
        const double constriction = constriction_of(patch, inside);
        const double bulk = inside.bulk(patch.moments);
        largest = largest_of(largest, {bulk, constriction});
        block.biot += patch.conductance * bulk;
        constricted = std::max(constricted, patch.conductance * constriction);
      }
      block.patches.push_back({first->patch, largest});
      first = last;
    }
    block.biot += constricted;
    return block;
  }

  // A load's heat is as dense in the middle of its patch as at the rim, where a joint's crowds: the middle of a disc is 4/pi
  // times as warm as one disc at one temperature would be (Carslaw and Jaeger, Conduction of Heat in Solids, 1959,
  // section 8.2). And it may lie in the corner of a face, where a quarter of the half space is left for the flow lines: twice
  // as warm, by its images beyond the two sides.
  [[nodiscard]] static double constriction_of(const Patch& patch, const InnerResistance<dim>& inside) {
    constexpr double of_load = 2 * 4 / std::numbers::pi;
    if (patch.volume > 0) return inside.constriction_within(patch.volume);
    return patch.area > 0 ? (patch.load ? of_load : 1) * inside.constriction(patch.area) : 0;
  }

  // Of what is cold and hot at the start, within and outside: a block's temperature may go anywhere between. Where it goes
  // beyond that LumpingEstimate knows.
  void find_conductivities() {
    TemperatureRange range;
    range.include(model_.initial);
    range.include(start_);
    for (const MaterialId material : materials_.ids()) {
      const auto& conductivity = materials_[material].conductivity;
      const Curve value = conductivity ? conductivity->value : Curve(std::numeric_limits<double>::infinity());
      conductivities_.push_back({value, least_value(value, range)});
    }
  }

  // One, or of a load that heats one part and cools another those two.
  [[nodiscard]] std::vector<Patch> patches_of(const Entries& entries, const InnerResistance<dim>& inside) const {
    const std::size_t patch = entries.begin()->patch;
    if (patch < mesh_.blocks.size()) return {contact_patch(entries, inside)};
    const std::size_t exchange = patch - mesh_.blocks.size();
    if (exchange < model_.exchanges.size()) return {exchange_patch(exchange, entries, inside)};
    return load_patches(exchange - model_.exchanges.size(), entries, inside);
  }

  // Two faces that lie on each other are found from both sides; where only edges meet, theirs is the area.
  [[nodiscard]] Patch contact_patch(const Entries& entries, const InnerResistance<dim>& inside) const {
    Patch patch;
    double edges = 0;
    for (const Entry& entry : entries) {
      const contact::Contact<dim>& contact = contacts_[entry.item];
      const contact::Stencil<dim>& stencil = entry.owner ? contact.on_owner : contact.on_target;
      inside.add(stencil, joints_.conductances[entry.item], patch.moments);
      patch.conductance += joints_.conductances[entry.item];
      if (contact.kind == contact::Kind::overlap) patch.area += contact.area;
      if (contact.kind == contact::Kind::point_face) patch.area += 0.5 * contact.area;
      if (contact.kind == contact::Kind::edge_edge) edges += 0.5 * contact.area;
    }
    if (patch.area == 0) patch.area = edges;
    return patch;
  }

  // Radiation is as good as convection of its slope at the hotter of the two.
  [[nodiscard]] Patch exchange_patch(std::size_t e, const Entries& entries, const InnerResistance<dim>& inside) const {
    const Exchange& exchange = model_.exchanges[e];
    const ExchangeRates& rates = start_.exchanges[e];
    Patch patch;
    PatchMoments<dim> by_area;  // what does not conduct yet may do so later
    double area = 0;
    Extent extent;
    for (const Entry& entry : entries) {
      const NodeId node = exchange.on.nodes[entry.item];
      const double hotter = std::max(model_.initial[node.value()], rates.surroundings[entry.item]);
      const double conductance = exchange_slope(exchange.law, rates, entry.item, hotter);
      inside.add(node, conductance, patch.moments);
      inside.add(node, exchange.on.shares[entry.item], by_area);
      patch.conductance += conductance;
      area += exchange.on.shares[entry.item];
      extent.add(conductance, exchange.on.shares[entry.item]);
    }
    patch.area = patch.conductance == 0 ? area : extent.size();
    if (patch.conductance == 0) patch.moments = by_area;
    return patch;
  }

  // Of no conductance: they enter the error, not the Biot number. Where a load is strong is seen at the start; one that is zero
  // then counts as alike everywhere.
  [[nodiscard]] std::vector<Patch> load_patches(std::size_t l, const Entries& entries,
                                                const InnerResistance<dim>& inside) const {
    const Load& load = model_.loads[l];
    std::vector<double> densities;
    for (const Entry& entry : entries) densities.push_back(load.density(load.on.places.col(entry.item), 0));
    const auto [lowest, highest] = std::minmax_element(densities.begin(), densities.end());
    if (*lowest == 0 && *highest == 0) std::fill(densities.begin(), densities.end(), 1);
    std::vector<Patch> patches;
    if (*highest > 0) patches.push_back(load_patch(load, entries, inside, densities, 1));
    if (*lowest < 0) patches.push_back(load_patch(load, entries, inside, densities, -1));
    return patches;
  }

  // Of the part that it heats, or of the one that it cools.
  [[nodiscard]] Patch load_patch(const Load& load, const Entries& entries, const InnerResistance<dim>& inside,
                                 const std::vector<double>& densities, double sign) const {
    Patch patch;
    patch.load = true;
    Extent extent;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const auto item = entries[i].item;
      const double share = load.on.shares[item], heat = share * std::max(0.0, sign * densities[i]);
      inside.add(load.on.nodes[item], heat, patch.moments);
      extent.add(heat, share * load.of_share);
    }
    (load.in_volume ? patch.volume : patch.area) = extent.size();
    return patch;
  }

  const mesh::BlockMesh<dim>& mesh_;
  const Table<MaterialId, Material>& materials_;
  const contact::Contacts<dim>& contacts_;
  const JointConduction& joints_;
  const HeatOptions& options_;
  const HeatModel& model_;
  const Drive start_;  // what acts from outside then
  Table<MaterialId, LumpedConductivity> conductivities_;
  Table<BlockId, BlockModel> wanted_;
  Table<BlockId, Held> held_;
  std::set<std::string> refused_;
  std::vector<Problem> problems_;
};

}  // namespace

template <int dim>
std::optional<LumpedBlocks> choose_lumped(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                                          const contact::ContactSet<dim>& contacts, const JointConduction& joints,
                                          const HeatOptions& options, const HeatModel& model) {
  if (options.blocks.all_meshed()) return std::nullopt;
  return Chooser<dim>(mesh, materials, contacts, joints, options, model).choose();
}

template std::optional<LumpedBlocks> choose_lumped<2>(const mesh::BlockMesh<2>&, const Table<MaterialId, Material>&,
                                                      const contact::ContactSet<2>&, const JointConduction&, const HeatOptions&,
                                                      const HeatModel&);
template std::optional<LumpedBlocks> choose_lumped<3>(const mesh::BlockMesh<3>&, const Table<MaterialId, Material>&,
                                                      const contact::ContactSet<3>&, const JointConduction&, const HeatOptions&,
                                                      const HeatModel&);

}  // namespace scree::thermal
