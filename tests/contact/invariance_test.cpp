// A contact set is the geometry's, not the numbering's or the frame's.
#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "engine/base/threads.h"
#include "engine/base/wide.h"
#include "tests/contact/builders.h"

namespace scree::contact {
namespace {

using namespace testing;

// What a contact says without ids.
template <int dim>
struct Plain {
  Point<dim> from, to;
  double area, gap;
};

template <int dim>
std::vector<Plain<dim>> plain(const mesh::BlockMesh<dim>& mesh, const ContactOptions& options) {
  std::vector<Plain<dim>> all;
  for (const auto& contact : find_contacts<dim>(mesh, options).contacts) {
    all.push_back({point_of(mesh, contact), point_of(mesh, contact.on_target), contact.area, contact.gap});
  }
  return all;
}

template <int dim>
void expect_same(std::vector<Plain<dim>> a, std::vector<Plain<dim>> b) {
  ASSERT_EQ(a.size(), b.size());
  ASSERT_GT(a.size(), 50);
  // Every contact of `a` has its own in `b`: no two begin at one point.
  for (const auto& contact : a) {
    const auto twin = std::min_element(b.begin(), b.end(), [&](const auto& left, const auto& right) {
      return (left.from - contact.from).squaredNorm() < (right.from - contact.from).squaredNorm();
    });
    EXPECT_NEAR((twin->from - contact.from).norm(), 0, 1e-9);
    EXPECT_NEAR((twin->to - contact.to).norm(), 0, 1e-9);
    EXPECT_NEAR(twin->area, contact.area, 1e-9);
    EXPECT_NEAR(twin->gap, contact.gap, 1e-9);
  }
}

template <int dim>
BlockOf<dim> pile() {
  std::mt19937 random(23);
  return random_simplices<dim>(150, 1.5, 0.4, random);
}

template <int dim>
void renumber() {
  auto simplices = pile<dim>();
  const ContactOptions options{0.05, 0.1};
  const auto before = plain<dim>(each_its_own<dim>(simplices), options);
  std::mt19937 random(1);
  std::shuffle(simplices.begin(), simplices.end(), random);
  for (auto& simplex : simplices) std::shuffle(simplex.begin(), simplex.end(), random);
  expect_same<dim>(before, plain<dim>(each_its_own<dim>(simplices), options));
}

template <int dim>
void move() {
  auto simplices = pile<dim>();
  const ContactOptions options{0.05, 0.1};
  auto before = plain<dim>(each_its_own<dim>(simplices), options);
  Eigen::Matrix<double, dim, dim> rotation;
  if constexpr (dim == 2) {
    rotation = Eigen::Rotation2Dd(0.7).toRotationMatrix();
  } else {
    rotation = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.1).normalized().toRotationMatrix();
  }
  const Point<dim> shift = Point<dim>::Constant(-123.4);
  const auto moved = [&](const Point<dim>& point) -> Point<dim> { return rotation * point + shift; };
  for (auto& simplex : simplices) {
    for (auto& corner : simplex) corner = moved(corner);
  }
  for (auto& contact : before) contact = {moved(contact.from), moved(contact.to), contact.area, contact.gap};
  expect_same<dim>(before, plain<dim>(each_its_own<dim>(simplices), options));
}

template <int dim>
void expect_equal(const std::vector<ContactSet<dim>>& sets) {
  for (const auto& set : sets) {
    ASSERT_EQ(set.contacts.size(), sets[0].contacts.size());
    for (std::size_t i = 0; i < set.contacts.size(); ++i) {
      const auto &one = sets[0].contacts[i], &other = set.contacts[i];
      EXPECT_EQ(one.kind, other.kind);
      EXPECT_EQ(one.owner, other.owner);
      EXPECT_EQ(one.target, other.target);
      EXPECT_EQ(one.on_target.weights, other.on_target.weights);
      EXPECT_EQ(one.area, other.area);
      EXPECT_EQ(one.gap, other.gap);
    }
  }
}

template <int dim>
void change_instructions() {
  const Instructions best = instructions_in_use;
  std::mt19937 random(31);
  const auto mesh = each_its_own<dim>(random_simplices<dim>(1000, dim == 2 ? 4 : 2.8, 0.4, random));
  for (const Model model : {Model::semi_spring, Model::overlap}) {
    ContactOptions options{0.05, 0.1};
    options.model = model;
    std::vector<ContactSet<dim>> sets;
    for (int i = 0; i <= static_cast<int>(best); ++i) {
      instructions_in_use = static_cast<Instructions>(i);
      sets.push_back(find_contacts<dim>(mesh, options));
    }
    instructions_in_use = best;
    ASSERT_GT(sets[0].contacts.size(), model == Model::semi_spring ? 300 : 3);
    expect_equal(sets);
  }
}

TEST(ContactSet, DoesNotDependOnTheNumberingOfBlocksAndNodes) {
  renumber<2>();
  renumber<3>();
}

TEST(ContactSet, MovesWithTheWhole) {
  move<2>();
  move<3>();
}

TEST(FindContacts, DoNotDependOnTheNumberOfThreads) {
  std::mt19937 random(29);
  const auto mesh = each_its_own<3>(random_simplices<3>(3000, 4, 0.4, random));
  for (const Model model : {Model::semi_spring, Model::overlap}) {
    ContactOptions options{0.05, 0.1};
    options.model = model;
    std::vector<ContactSet<3>> sets;
    for (const int threads : {1, 2, 5}) {
      use_threads(threads);
      sets.push_back(find_contacts<3>(mesh, options));
    }
    use_threads(available_processors());
    ASSERT_GT(sets[0].contacts.size(), model == Model::semi_spring ? 1000 : 10);
    expect_equal(sets);
  }
}

TEST(FindContacts, DoNotDependOnTheInstructionsOfTheProcessor) {
  change_instructions<2>();
  change_instructions<3>();
}

}  // namespace
}  // namespace scree::contact
