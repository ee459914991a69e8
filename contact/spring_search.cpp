#include "contact/spring_search.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>
#include <utility>

#include "contact/choice.h"
#include "contact/point_queries.h"
#include "contact/semi_spring.h"
#include "contact/spring_list.h"
#include "contact/touch.h"
#include "engine/base/chunks.h"
#include "engine/base/grouped.h"

namespace scree::contact {

namespace {

// Of each shell those that its semi-springs may touch.
class NearShells {
 public:
  NearShells(std::size_t shells, const Parts<NearSprings>& near)
      : others_(grouped<NearShell, std::uint32_t>(near.count(), shells, [&](std::size_t part, const auto& visit) {
          for (const auto& [own, other] : near[part]) visit(own, other);
        })) {}

  // Calls visit(place) for those that are close, or for the others, and whose bound is not above the limit.
  template <class Visit>
  SCREE_INLINE void for_each(const auto& shells, std::size_t shell, bool close, float limit, const Visit& visit) const {
    const std::span<const NearShell> others = others_.of(shell);
    for (std::size_t n = 0; n < others.size(); ++n) {
      constexpr std::size_t ahead = 3;
      __builtin_prefetch(&shells[others[std::min(n + ahead, others.size() - 1)].place]);
      const NearShell& other = others[n];
      if ((other.close != 0) == close && other.bound <= limit) visit(other.place);
    }
  }

 private:
  Grouped<NearShell, std::uint32_t> others_;
};

// Of the semi-springs of a shell by their numbers (spring_list.h): where the vertex is among the corners of the face.
template <int dim>
constexpr std::array<std::int8_t, springs_of_shell> corners_of_springs = [] {
  std::array<std::int8_t, springs_of_shell> corners{};
  for (int f = 0; f <= dim; ++f) {
    for (int corner = 0; corner < dim; ++corner) {
      corners[lane_count * f + mesh::opposite_corners<dim>[f][corner]] = static_cast<std::int8_t>(corner);
    }
  }
  return corners;
}();

// The semi-springs of some shells after those of others.
template <int dim>
class SpringSearch {
 public:
  SpringSearch(const Surface<dim>& surface, const ContactOptions& options, const ShellTable<dim>& table, const NearShells& near,
               SpringTargets<dim>& targets)
      : surface_(surface),
        options_(options),
        table_(table),
        near_(near),
        targets_(targets),
        weights_(all_semi_spring_weights<dim>(options.indentation)),
        list_(options.indentation) {}

  // No more shells than the list holds.
  void find(std::size_t begin, std::size_t end) {
    list_.clear();
    for (std::size_t place = begin; place < end; ++place) list_.add(table_.shells[place]);
    touched_.clear();
    last_touched_.fill(none);
    for (const bool close : {true, false}) {
      list_possible(begin, close);
      fetch_corners();
      touch_possible();
    }
    take_targets();
  }

 private:
  using List = SpringList<dim>;
  static constexpr std::uint32_t none = ~0u;

  struct Touched : Candidate<FaceId> {
    PointTouch<dim> touch;
    std::uint32_t before;  // the last one of the same semi-spring
  };

  void list_possible(std::size_t begin, bool close) {
    widely([&](auto bytes) SCREE_INLINED {
      for (std::size_t i = 0; i < list_.shells(); ++i) {
        if (list_.springs_of(i) == 0) continue;
        near_.for_each(table_.shells, begin + i, close, list_.limit_of_shell(i), [&](std::size_t place) SCREE_INLINED {
          list_.template look_at<LanesIn<bytes>>(i, table_.shells[place], possible_,
                                                 [&](FaceId face) SCREE_INLINED { fetch(face); });
        });
      }
    });
  }

  // What is asked of a target lies here and there in memory. It is fetched ahead: first the faces, then what they refer to.
  SCREE_INLINE void fetch(FaceId face) const {
    __builtin_prefetch(&surface_.faces[face]);
    __builtin_prefetch(&surface_.normals[face]);
  }

  void fetch_corners() const {
    for (const PossibleTouch& possible : possible_) {
      __builtin_prefetch(&surface_.mesh.nodes[surface_.faces[possible.target].nodes[0]]);
    }
  }

  // Touches what the semi-springs may take as their targets, of each the nearest first. No semi-spring is nearer to a face than
  // its bound: once one is touched, those that cannot beat it need no look.
  void touch_possible() {
    while (!possible_.empty()) {
      find_nearest();
      for (std::size_t i = 0; i < possible_.size(); ++i) {
        if (!is_nearest(i)) continue;
        ask(i);
        if (queries_.count() == queries_.most) touch_asked();
      }
      touch_asked();
      drop_beaten();
    }
  }

  // Of each semi-spring its nearest possible target: the bits of its bound, which rise with it as it is not negative, above its
  // place, so that one comparison tells.
  void find_nearest() {
    nearest_.fill(~std::uint64_t{0});
    for (std::size_t i = 0; i < possible_.size(); ++i) {
      std::uint64_t& nearest = nearest_[possible_[i].spring];
      nearest = std::min(nearest, std::uint64_t{std::bit_cast<std::uint32_t>(possible_[i].bound)} << 32 | i);
    }
  }
  [[nodiscard]] bool is_nearest(std::size_t i) const { return static_cast<std::uint32_t>(nearest_[possible_[i].spring]) == i; }

  void ask(std::size_t i) {
    const PossibleTouch& possible = possible_[i];
    const int number = possible.spring % springs_of_shell;
    Asked& asked = asked_[queries_.count()];
    asked.possible = i;
    asked.pair.owner = list_.shell_of(possible.spring).face(number / lane_count);
    asked.pair.corner = corners_of_springs<dim>[number];
    asked.pair.target = possible.target;
    queries_.add(query_of<dim>(surface_, weights_[asked.pair.corner], asked.pair));
  }

  void touch_asked() {
    queries_.measure(options_.tolerance, surface_.rounding);
    for (std::size_t k = 0; k < queries_.count(); ++k) {
      const PossibleTouch& possible = possible_[asked_[k].possible];
      const KnownTarget known{possible.plane, possible.whole, possible.inside};
      const auto touch = touch_of<dim>(surface_, asked_[k].pair, known, queries_.point(k), queries_.answer(k));
      if (touch) keep(possible, asked_[k].pair.owner, *touch);
    }
    queries_.clear();
  }

  void keep(const PossibleTouch& possible, FaceId owner, const PointTouch<dim>& touch) {
    const double distance = std::abs(touch.gap);
    std::uint32_t& last = last_touched_[possible.spring];
    touched_.push_back({{possible.target, distance, -touch.facing}, touch, last});
    last = static_cast<std::uint32_t>(touched_.size() - 1);
    constexpr double rounding = 1 + 1e-6;
    list_.lower_limit(possible.spring, rounding * (distance + 2 * equal_distance * surface_.lengths[owner]));
  }

  // And those that have been touched.
  void drop_beaten() {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < possible_.size(); ++i) {
      const PossibleTouch possible = possible_[i];
      const bool asked = is_nearest(i);
      possible_[kept] = possible;
      kept += static_cast<unsigned>(possible.bound <= list_.limit_of(possible.spring)) & static_cast<unsigned>(!asked);
    }
    possible_.resize(kept);
  }

  void take_targets() {
    for (std::size_t i = 0; i < list_.shells(); ++i) {
      for (unsigned left = list_.springs_of(i); left != 0; left &= left - 1) {
        const auto number = static_cast<std::size_t>(std::countr_zero(left));
        const std::uint32_t last = last_touched_[i * springs_of_shell + number];
        if (last == none) continue;
        const FaceId face = list_.shell_of(i * springs_of_shell).face(static_cast<int>(number) / lane_count);
        const auto corner = static_cast<std::size_t>(corners_of_springs<dim>[number]);
        take(face.index() * dim + corner, best_touched(last, surface_.lengths[face]));
      }
    }
  }

  const Touched& best_touched(std::uint32_t last, double length) {
    if (touched_[last].before == none) return touched_[last];
    candidates_.clear();
    for (; last != none; last = touched_[last].before) candidates_.push_back(touched_[last]);
    return *best_of(candidates_, equal_distance * length);
  }

  void take(std::size_t spring, const Touched& best) {
    targets_.take(spring, best.target, surface_.faces[best.target].block, {best.touch.gap, best.touch.on_target});
  }

  struct Asked {
    std::size_t possible;
    PointAndFace pair;
  };

  const Surface<dim>& surface_;
  const ContactOptions& options_;
  const ShellTable<dim>& table_;
  const NearShells& near_;
  SpringTargets<dim>& targets_;
  std::array<std::array<double, dim>, dim> weights_;  // of a face's corners at the semi-spring of each
  List list_;
  VectorWrittenLater<PossibleTouch> possible_;
  std::array<std::uint64_t, List::most_springs> nearest_;
  PointQueries<dim> queries_;
  std::array<Asked, PointQueries<dim>::most> asked_;  // of these
  std::vector<Touched> touched_;
  std::array<std::uint32_t, List::most_springs> last_touched_;  // of each semi-spring
  std::vector<Touched> candidates_;
};

}  // namespace

template <int dim>
void find_spring_targets(const Surface<dim>& surface, const ContactOptions& options, const ShellTable<dim>& table,
                         Parts<NearSprings>& near, SpringTargets<dim>& targets) {
  const NearShells near_shells(table.shells.size(), near);
  near.clear();
  for_chunks(table.shells.size(), [&](Chunk chunk) {
    SpringSearch<dim> search(surface, options, table, near_shells, targets);
    constexpr std::size_t together = SpringList<dim>::most_shells;
    for (std::size_t i = chunk.begin; i < chunk.end; i += together) search.find(i, std::min(i + together, chunk.end));
  });
}

#define SCREE_INSTANTIATE(dim)                                                                               \
  template void find_spring_targets<dim>(const Surface<dim>&, const ContactOptions&, const ShellTable<dim>&, \
                                         Parts<NearSprings>&, SpringTargets<dim>&);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE

}  // namespace scree::contact
