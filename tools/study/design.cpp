#include "tools/study/design.h"

#include <numeric>
#include <set>
#include <utility>

#include "engine/mesh/random_numbers.h"

namespace scree::study {

namespace {

using Combination = std::vector<Level>;

std::vector<Combination> grid(const std::vector<Factor>& factors) {
  std::vector<Combination> combinations{{}};
  for (const Factor& factor : factors) {
    std::vector<Combination> longer;
    for (const Combination& combination : combinations) {
      for (const Level& level : factor.levels) {
        longer.push_back(combination);
        longer.back().push_back(level);
      }
    }
    combinations = std::move(longer);
  }
  return combinations;
}

// 0 to count - 1 in an order by chance (Fisher and Yates).
std::vector<int> shuffled(int count, mesh::RandomNumbers& random) {
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = order.size(); i > 1; --i) {
    std::swap(order[i - 1], order[static_cast<std::size_t>(random.unit() * static_cast<double>(i))]);
  }
  return order;
}

Level level_at(const Factor& factor, double fraction) {
  if (factor.interval) return factor.interval->drawn(fraction, factor.where);
  return factor.levels[static_cast<std::size_t>(fraction * static_cast<double>(factor.levels.size()))];
}

// McKay, Beckman and Conover (1979): along every key each of the layers holds one point, somewhere inside.
std::vector<Combination> hypercube(const std::vector<Factor>& factors, const LatinHypercube& options) {
  mesh::RandomNumbers random(options.seed);
  std::vector<Combination> combinations(static_cast<std::size_t>(options.points));
  for (const Factor& factor : factors) {
    const std::vector<int> layers = shuffled(options.points, random);
    for (std::size_t i = 0; i < combinations.size(); ++i) {
      combinations[i].push_back(level_at(factor, (layers[i] + random.unit()) / options.points));
    }
  }
  return combinations;
}

// Integers and short lists bring points that are equal in everything; a run that is made twice would count double.
std::vector<Combination> without_repeats(std::vector<Combination> combinations) {
  std::set<std::vector<std::string>> seen;
  std::erase_if(combinations, [&](const Combination& combination) {
    std::vector<std::string> texts;
    for (const Level& level : combination) texts.push_back(level.text);
    return !seen.insert(std::move(texts)).second;
  });
  return combinations;
}

}  // namespace

double run_count(const Study& study) {
  double count = study.ensemble ? static_cast<double>(study.ensemble->levels.size()) : 1;
  if (study.hypercube) return count * study.hypercube->points;
  for (const Factor& factor : study.factors) count *= static_cast<double>(factor.levels.size());
  return count;
}

std::vector<Point> points_of(const Study& study) {
  const auto combinations = study.hypercube ? without_repeats(hypercube(study.factors, *study.hypercube)) : grid(study.factors);
  std::vector<Point> points;
  for (std::size_t i = 0; i < combinations.size(); ++i) {
    const std::size_t members = study.ensemble ? study.ensemble->levels.size() : 1;
    for (std::size_t member = 0; member < members; ++member) {
      points.push_back({i, combinations[i]});
      if (study.ensemble) points.back().levels.push_back(study.ensemble->levels[member]);
    }
  }
  return points;
}

}  // namespace scree::study
