#include "objects/lightfield/common/view_cell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <tuple>

namespace grove::objects::lightfield {
namespace {

using world::Vec3;
using Exact = glm::dvec3;

constexpr float kFocal = 621.5F;  // 720 pixels high, 1.05 radians

ViewGeometry ballOf(float extent, Vec3 target = {0.3F, 3.0F, -0.2F}) {
  ViewGeometry geometry;
  geometry.target = target;
  geometry.extent = extent;
  return geometry;
}

class Dice {
 public:
  float in(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine_); }
  Vec3 direction() {
    const float y = in(-1.0F, 1.0F);
    const float around = in(0.0F, 2.0F * std::numbers::pi_v<float>);
    const float across = std::sqrt(1.0F - y * y);
    return {across * std::sin(around), y, across * std::cos(around)};
  }

 private:
  std::mt19937 engine_{20240607};
};

/// An eye of the cell, more often than not near its border.
Vec3 eyeIn(const ViewCell& cell, const ViewGeometry& geometry, float focal, float error, Dice& dice) {
  const Vec3 from = cell.camera.eye;
  const Vec3 way = dice.direction() * glm::vec3(1.0F, 0.5F, 1.0F);
  float inside = 0.0F;
  float outside = 16.0F * cell.reach;
  for (int i = 0; i < 24; ++i) {
    const float middle = 0.5F * (inside + outside);
    const auto other = viewCell(geometry, from + middle * way, focal, error);
    (other && other->id == cell.id ? inside : outside) = middle;
  }
  // Cells are curved: what lies between may be outside.
  const Vec3 between = from + dice.in(0.0F, 1.0F) * inside * way;
  const auto other = viewCell(geometry, between, focal, error);
  return dice.in(0.0F, 1.0F) < 0.3F && other && other->id == cell.id ? between : from + inside * way;
}

double angleBetween(Exact a, Exact b) { return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)); }

TEST(ViewCell, ErrorHoldsForEveryEyeAndPair) {
  Dice dice;
  double worst = 0.0;
  int cells = 0;
  for (int i = 0; i < 4000; ++i) {
    const ViewGeometry geometry = ballOf(dice.in(0.4F, 6.0F));
    const float error = std::exp2(dice.in(-1.0F, 4.0F));
    const float focal = dice.in(200.0F, 1500.0F);
    const Vec3 eye = geometry.target + dice.direction() * geometry.extent * std::exp2(dice.in(0.05F, 4.0F));
    const auto cell = viewCell(geometry, eye, focal, error);
    if (!cell) continue;
    ++cells;
    const Exact own = cell->camera.eye;
    const Exact target = geometry.target;
    const double radius = geometry.extent;
    for (int j = 0; j < 12; ++j) {
      const Exact other = eyeIn(*cell, geometry, focal, error, dice);
      // A ray from the cell's eye that meets the ball, and two points of its chord, often the ends.
      const Exact through = target + Exact(dice.direction()) * radius * std::sqrt(double{dice.in(0.0F, 1.0F)});
      const Exact ray = glm::normalize(through - own);
      const double middle = glm::dot(target - own, ray);
      const Exact foot = own + middle * ray;
      const double half = std::sqrt(std::max(0.0, radius * radius - glm::dot(foot - target, foot - target)));
      const bool ends = j % 2 == 0;
      const double near = middle - half * (ends ? 1.0 : double{dice.in(0.0F, 1.0F)});
      const double far = middle + half * (ends ? 1.0 : double{dice.in(0.0F, 1.0F)});
      const double apart = focal * angleBetween(own + near * ray - other, own + far * ray - other);
      EXPECT_LE(apart, error * 1.0001) << "extent " << radius << " distance " << glm::length(eye - geometry.target);
      worst = std::max(worst, apart / error);
    }
  }
  EXPECT_GT(cells, 1500);
  EXPECT_GT(worst, 0.6) << "cells are smaller than they need be";
}

TEST(ViewCell, ServesNoEyeAboveTheError) {
  Dice dice;
  int served = 0;
  double worst = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const ViewGeometry geometry = ballOf(dice.in(0.4F, 6.0F));
    const float error = std::exp2(dice.in(-1.0F, 6.0F));
    const float focal = dice.in(200.0F, 1500.0F);
    const Vec3 own = geometry.target + dice.direction() * geometry.extent * std::exp2(dice.in(0.05F, 4.0F));
    const float distance = glm::length(own - geometry.target);
    const Vec3 eye = own + dice.direction() * distance * std::exp2(dice.in(-8.0F, -1.0F));
    if (reprojectionError(geometry, own, eye, focal, error) > 1.0F) continue;
    ++served;
    EXPECT_GT(glm::distance(eye, geometry.target), 0.9F * distance) << "a picture from afar is not sharp";
    for (int j = 0; j < 8; ++j) {
      const Exact from = own;
      const Exact target = geometry.target;
      const double radius = geometry.extent;
      const Exact through = target + Exact(dice.direction()) * radius * std::sqrt(double{dice.in(0.0F, 1.0F)});
      const Exact ray = glm::normalize(through - from);
      const double middle = glm::dot(target - from, ray);
      const Exact foot = from + middle * ray;
      const double half = std::sqrt(std::max(0.0, radius * radius - glm::dot(foot - target, foot - target)));
      const double apart =
          focal * angleBetween(from + (middle - half) * ray - Exact(eye), from + (middle + half) * ray - Exact(eye));
      EXPECT_LE(apart, error * 1.0001);
      worst = std::max(worst, apart / error);
    }
  }
  EXPECT_GT(served, 3000);
  EXPECT_GT(worst, 0.6) << "serves fewer eyes than it could";
}

TEST(ViewCell, ServesAllOfACellAndMore) {
  Dice dice;
  int cells = 0;
  for (int i = 0; i < 1000; ++i) {
    const ViewGeometry geometry = ballOf(dice.in(0.4F, 6.0F));
    const float focal = dice.in(200.0F, 1200.0F);
    const Vec3 eye = geometry.target + dice.direction() * geometry.extent * std::exp2(dice.in(0.3F, 3.5F));
    const auto cell = viewCell(geometry, eye, focal, 8.0F);
    if (!cell) continue;
    ++cells;
    for (int j = 0; j < 4; ++j) {
      EXPECT_LE(reprojectionError(geometry, cell->camera.eye, eyeIn(*cell, geometry, focal, 8.0F, dice), focal, 8.0F),
                1.0F);
    }
    const Vec3 from = cell->camera.eye - geometry.target;
    const Vec3 aside = glm::normalize(Vec3(from.z, 0.0F, -from.x)) * 1.1F * cell->reach;
    EXPECT_LE(reprojectionError(geometry, cell->camera.eye, cell->camera.eye + aside, focal, 8.0F), 1.0F);
  }
  EXPECT_GT(cells, 300);
}

// Faults: a picture of another size of the frame counts as sharp, or never serves.
TEST(ViewCell, OtherSizesOfTheFrameCostSharpness) {
  const ViewGeometry geometry = ballOf(2.0F);
  const Vec3 own = geometry.target + Vec3(0.0F, 0.0F, 20.0F);
  const auto errorOf = [&](float nearer, std::int32_t sharper) {
    return reprojectionError(geometry, own, own - Vec3(0.0F, 0.0F, nearer), 500.0F, 64.0F, sharper);
  };
  EXPECT_LT(errorOf(0.0F, 0), 0.1F);
  EXPECT_FLOAT_EQ(errorOf(0.0F, 1), 1.0F) << "a quarter of an octave too sharp";
  EXPECT_FLOAT_EQ(errorOf(0.0F, 4), 4.0F);
  EXPECT_FLOAT_EQ(errorOf(0.0F, -1), 2.0F) << "a quarter of an octave too coarse";
  // Nearer by an eighth of an octave, it is half as much too sharp.
  EXPECT_LT(errorOf(1.6F, 1), 1.0F);
  EXPECT_GT(errorOf(-1.6F, 1), 1.0F);
}

TEST(ViewCell, PictureContainsTheBallSharply) {
  Dice dice;
  int cells = 0;
  for (int i = 0; i < 1000; ++i) {
    const ViewGeometry geometry = ballOf(dice.in(0.4F, 6.0F));
    const float focal = dice.in(200.0F, 1200.0F);
    const Vec3 eye = geometry.target + dice.direction() * geometry.extent * std::exp2(dice.in(0.3F, 3.5F));
    const auto cell = viewCell(geometry, eye, focal, 8.0F);
    if (!cell) continue;
    ++cells;
    ASSERT_LE(cell->size, kMaxCellSize);
    const auto size = static_cast<float>(cell->size);
    const glm::mat3 inverse = glm::inverse(glm::mat3(cell->camera.perColumn, cell->camera.perRow, cell->camera.corner));
    for (int j = 0; j < 16; ++j) {
      const Vec3 point = geometry.target + dice.direction() * geometry.extent;
      const Vec3 at = inverse * (point - cell->camera.eye);
      EXPECT_GT(at.z, 0.0F);
      EXPECT_GE(std::min(at.x, at.y) / at.z, -0.01F);
      EXPECT_LE(std::max(at.x, at.y) / at.z, size + 0.01F);
      // What a texel spans around the point, and what a visitor's pixel does.
      const float texel = at.z * glm::length(cell->camera.perColumn);
      const Vec3 other = eyeIn(*cell, geometry, focal, 8.0F, dice);
      EXPECT_LE(texel, glm::length(point - other) / focal * 1.0001F);
    }
    // Not much sharper than needed, either: memory is what the cache is short of.
    const float distance = glm::length(cell->camera.eye - geometry.target);
    const float needed =
        2.0F * focal * geometry.extent / std::sqrt(distance * distance - geometry.extent * geometry.extent);
    EXPECT_LE(size, needed * 1.6F + 2.0F);
  }
  EXPECT_GT(cells, 300);
}

TEST(ViewCell, IsTheSameForAllItsEyes) {
  Dice dice;
  for (int i = 0; i < 300; ++i) {
    const ViewGeometry geometry = ballOf(3.0F);
    const Vec3 eye = geometry.target + dice.direction() * dice.in(8.0F, 40.0F);
    const auto cell = viewCell(geometry, eye, kFocal, 4.0F);
    if (!cell) continue;
    const auto again = viewCell(geometry, eyeIn(*cell, geometry, kFocal, 4.0F, dice), kFocal, 4.0F);
    ASSERT_TRUE(again);
    EXPECT_EQ(again->id, cell->id);
    EXPECT_EQ(again->size, cell->size);
    EXPECT_LT(glm::length(again->camera.eye - cell->camera.eye), 1.0e-4F);
    const auto own = viewCell(geometry, cell->camera.eye, kFocal, 4.0F);
    ASSERT_TRUE(own);
    EXPECT_EQ(own->id, cell->id);
  }
}

TEST(ViewCell, LastsForItsReach) {
  const ViewGeometry geometry = ballOf(4.0F);
  constexpr float kDistance = 15.0F;
  constexpr int kSteps = 20000;
  const auto first = viewCell(geometry, geometry.target + Vec3(0, 0, kDistance), kFocal, 4.0F);
  ASSERT_TRUE(first);
  std::set<std::tuple<int, int, int, int>> seen;
  CellId last;
  last.shell = -1000;
  for (int i = 0; i < kSteps; ++i) {
    const float around = (static_cast<float>(i) + 0.5F) / kSteps * 2.0F * std::numbers::pi_v<float>;
    const auto cell =
        viewCell(geometry, geometry.target + kDistance * Vec3(std::sin(around), 0.05F, std::cos(around)), kFocal, 4.0F);
    ASSERT_TRUE(cell);
    if (cell->id == last) continue;
    last = cell->id;
    EXPECT_TRUE(seen.emplace(last.shell, last.layer, last.band, last.column).second) << i;
  }
  const float expected = std::numbers::pi_v<float> * kDistance / first->reach;
  EXPECT_NEAR(static_cast<float>(seen.size()), expected, 0.1F * expected);
}

TEST(ViewCell, IsReconstructedFromItsId) {
  Dice dice;
  int cells = 0;
  for (int i = 0; i < 3000; ++i) {
    const ViewGeometry geometry = ballOf(dice.in(0.4F, 6.0F));
    const Vec3 eye = geometry.target + dice.direction() * geometry.extent * std::exp2(dice.in(0.05F, 5.0F));
    const auto cell = viewCell(geometry, eye, dice.in(100.0F, 2000.0F), std::exp2(dice.in(-1.0F, 5.0F)));
    if (!cell) continue;
    ++cells;
    const auto again = viewCell(geometry, cell->id);
    ASSERT_TRUE(again);
    EXPECT_EQ(again->id, cell->id);
    EXPECT_EQ(again->size, cell->size);
    EXPECT_EQ(again->reach, cell->reach);
    EXPECT_EQ(again->camera.eye, cell->camera.eye);
    EXPECT_EQ(again->camera.corner, cell->camera.corner);
  }
  EXPECT_GT(cells, 1500);
}

TEST(ViewCell, RefusesImpossibleIds) {
  const ViewGeometry geometry = ballOf(4.0F);
  const auto cell = viewCell(geometry, geometry.target + Vec3(30.0F, 0.0F, 0.0F), kFocal, 16.0F);
  ASSERT_TRUE(cell);
  const auto isNone = [&](auto change) {
    CellId id = cell->id;
    change(id);
    return !viewCell(geometry, id);
  };
  constexpr std::int32_t kMuch = 2'000'000'000;
  EXPECT_FALSE(isNone([](CellId&) {}));
  for (const std::int32_t wrong : {-1, kMuch}) {
    EXPECT_TRUE(isNone([&](CellId& id) { id.focal = wrong; }));
    EXPECT_TRUE(isNone([&](CellId& id) { id.shell = wrong; }));
    EXPECT_TRUE(isNone([&](CellId& id) { id.layer = wrong; }));
    EXPECT_TRUE(isNone([&](CellId& id) { id.band = wrong; }));
    EXPECT_TRUE(isNone([&](CellId& id) { id.column = wrong; }));
    EXPECT_TRUE(isNone([&](CellId& id) { id.error = wrong; }));
  }
  EXPECT_TRUE(isNone([](CellId& id) { id.error = 0; }));
  EXPECT_TRUE(isNone([](CellId& id) { id.shell = 0; })) << "the ball itself";
}

TEST(ViewCell, IsSharedBySimilarFrameSizes) {
  const ViewGeometry geometry = ballOf(4.0F);
  const Vec3 eye = geometry.target + Vec3(11.0F, -1.0F, 9.0F);
  const auto one = viewCell(geometry, eye, 620.0F, 4.0F);
  const auto other = viewCell(geometry, eye, 700.0F, 4.0F);
  const auto finer = viewCell(geometry, eye, 1200.0F, 4.0F);
  ASSERT_TRUE(one && other && finer);
  EXPECT_EQ(one->id, other->id);
  EXPECT_EQ(one->size, other->size);
  EXPECT_NE(one->id, finer->id);
}

TEST(ViewCell, DiffersByError) {
  const ViewGeometry geometry = ballOf(4.0F);
  const Vec3 eye = geometry.target + Vec3(30.0F, 0.0F, 0.0F);
  const auto coarse = viewCell(geometry, eye, kFocal, 16.0F);
  auto fine = viewCell(geometry, eye, kFocal, 12.0F);
  ASSERT_TRUE(coarse && fine);
  EXPECT_NE(coarse->id, fine->id);
  fine->id.shell = coarse->id.shell;
  fine->id.layer = coarse->id.layer;
  fine->id.band = coarse->id.band;
  fine->id.column = coarse->id.column;
  EXPECT_NE(coarse->id, fine->id);
}

TEST(ViewCell, IsEmptyWithoutReuse) {
  const ViewGeometry geometry = ballOf(4.0F);
  const auto at = [&](float distance, float focal, float error) {
    return viewCell(geometry, geometry.target + Vec3(0.6F, 0.0F, 0.8F) * distance, focal, error).has_value();
  };
  EXPECT_FALSE(at(0.0F, kFocal, 4.0F));
  EXPECT_FALSE(at(3.9F, kFocal, 4.0F));
  EXPECT_FALSE(at(4.1F, kFocal, 100.0F));
  EXPECT_FALSE(at(6.0F, kFocal, 4.0F)) << "a step would leave the cell";
  EXPECT_FALSE(at(10.0F, 3000.0F, 64.0F)) << "too large a picture";
  EXPECT_TRUE(at(15.0F, kFocal, 4.0F));
  EXPECT_TRUE(at(500.0F, kFocal, 0.5F));
}

}  // namespace
}  // namespace grove::objects::lightfield
