#include "objects/lightfield/backend/picture_budget.h"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <random>

namespace grove::objects::lightfield {
namespace {

constexpr double kRate = 1.0e6;  // texels a second
constexpr std::int64_t kPicture = 10000;
constexpr float kNothing = std::numeric_limits<float>::infinity();

node::View viewOf(node::SessionId session, node::FrameNumber frame, double time, std::size_t visitors = 1) {
  node::View view;
  view.session = session;
  view.frame = frame;
  view.time = time;
  view.visitors = visitors;
  return view;
}

float unshed() { return 1.0F; }
std::optional<double> unknown() { return std::nullopt; }

/// How many pictures the frame may make.
int takes(PictureBudget& budget, const node::View& view, float error) {
  int made = 0;
  while (made < 10000 && budget.take(view, kPicture, error)) ++made;
  return made;
}

TEST(PictureBudget, RefinesTwoPerFrameAndAllThatAreWrong) {
  PictureBudget budget(kRate, unshed, unknown);
  for (node::FrameNumber frame = 1; frame < 5; ++frame) {
    const node::View view = viewOf(1, frame, frame);
    EXPECT_EQ(takes(budget, view, 1.5F), PictureBudget::kMaxNewPictures);
    EXPECT_TRUE(budget.take(view, kPicture, 1.01F * PictureBudget::kUrgentError));
  }
}

TEST(PictureBudget, EachFrameInFlightRefinesTwo) {
  PictureBudget budget(kRate, unshed, unknown);
  int made = 0;
  for (int turn = 0; turn < 4; ++turn) {
    for (node::FrameNumber frame = 5; frame < 8; ++frame) made += budget.take(viewOf(1, frame, 5.0), 100, 1.5F) ? 1 : 0;
  }
  EXPECT_EQ(made, 3 * PictureBudget::kMaxNewPictures);
}

TEST(PictureBudget, BucketHoldsAQuarterSecondOfWorldTime) {
  PictureBudget budget(kRate, unshed, unknown);
  EXPECT_EQ(takes(budget, viewOf(1, 1, 10.0), kNothing), 25);
  EXPECT_EQ(takes(budget, viewOf(1, 2, 10.0), kNothing), 0) << "another frame alone gives nothing";
  EXPECT_EQ(takes(budget, viewOf(1, 3, 10.125), kNothing), 13) << "the last one on credit";
  EXPECT_EQ(takes(budget, viewOf(1, 4, 10.0625), kNothing), 0) << "a frame that was overtaken gives nothing twice";
  EXPECT_EQ(takes(budget, viewOf(1, 5, 100.0), kNothing), 49) << "the bucket and the pot, however long it took";
}

TEST(PictureBudget, BusyMachineFillsMoreSlowly) {
  float factor = 1.0F;
  PictureBudget budget(
      kRate, [&] { return factor; }, unknown);
  EXPECT_EQ(takes(budget, viewOf(1, 1, 10.0), kNothing), 25);
  factor = 4.0F;
  EXPECT_EQ(takes(budget, viewOf(1, 2, 10.25), kNothing), 7) << "a quarter of 25, the last one on credit";
}

TEST(PictureBudget, LargerErrorsMaySpendMore) {
  const auto taken = [](float error) {
    PictureBudget budget(kRate, unshed, unknown);
    return takes(budget, viewOf(1, 1, 0.0), error);
  };
  EXPECT_NEAR(taken(4.0F), 25 * (1.0 - 0.5 / 4.0), 1.0);
  EXPECT_NEAR(taken(10.0F), 25 * (1.0 - 0.5 / 10.0), 1.0);
  EXPECT_EQ(taken(kNothing), 25);
}

TEST(PictureBudget, VisitorsShareEquallyAndUseLeftovers) {
  PictureBudget busy(kRate, unshed, unknown);
  for (node::SessionId visitor = 1; visitor <= 5; ++visitor) (void)busy.take(viewOf(visitor, 1, 0.0, 5), 0, kNothing);
  for (node::SessionId visitor = 1; visitor <= 5; ++visitor) {
    EXPECT_EQ(takes(busy, viewOf(visitor, 2, 0.25, 5), kNothing), visitor == 1 ? 9 : 5)
        << "the first came with a full one";
  }
  EXPECT_EQ(takes(busy, viewOf(1, 3, 0.45, 5), kNothing), 4);
  PictureBudget calm(kRate, unshed, unknown);
  for (node::SessionId visitor = 1; visitor <= 5; ++visitor) (void)calm.take(viewOf(visitor, 1, 0.0, 5), 0, kNothing);
  for (node::SessionId visitor = 2; visitor <= 5; ++visitor) {
    (void)calm.take(viewOf(visitor, 2, 0.25, 5), 0, kNothing);
    (void)calm.take(viewOf(visitor, 3, 0.35, 5), 0, kNothing);
  }
  EXPECT_NEAR(takes(calm, viewOf(1, 2, 0.35, 5), kNothing), 5 + 2 + 4 * 2 + 5, 1);
}

/// Or eight who come at once wait for one another's pictures.
TEST(PictureBudget, NewcomersStartEmpty) {
  PictureBudget budget(kRate, unshed, unknown);
  EXPECT_EQ(takes(budget, viewOf(1, 1, 0.0), kNothing), 25) << "nobody is held up";
  EXPECT_EQ(takes(budget, viewOf(2, 1, 0.0, 2), kNothing), 0);
  EXPECT_EQ(takes(budget, viewOf(2, 2, 0.25, 2), kNothing), 13) << "the last one on credit";
}

TEST(PictureBudget, DebtsArePaidFirst) {
  PictureBudget budget(kRate, unshed, unknown);
  EXPECT_EQ(takes(budget, viewOf(1, 1, 0.0), kNothing), 25);
  for (int i = 0; i < 10; ++i) budget.borrow(viewOf(1, 1, 0.0), kPicture);
  EXPECT_FALSE(budget.take(viewOf(1, 2, 0.0625), kPicture, kNothing));
  EXPECT_TRUE(budget.take(viewOf(1, 3, 0.125), kPicture, kNothing));
}

/// Would catch a peer who takes everybody's pictures by saying that it is late.
TEST(PictureBudget, SkippedTimeGivesNothing) {
  double now = 10.0;
  PictureBudget budget(kRate, unshed, [&] { return now; });
  EXPECT_EQ(takes(budget, viewOf(1, 1, now, 2), kNothing), 13);
  for (node::SessionId liar = 100; liar < 120; ++liar) {
    for (const double time : {-1.0e300, 1.0e300}) {
      EXPECT_EQ(takes(budget, viewOf(liar, 1, time, 2), kNothing), 0) << liar << " at " << time;
    }
  }
  now += 0.125;
  EXPECT_EQ(takes(budget, viewOf(1, 2, now, 2), kNothing), 6) << "as if nobody had lied";
}

TEST(PictureBudget, BudgetHoldsForEightSlowVisitors) {
  PictureBudget budget(kRate, unshed, unknown);
  std::mt19937 dice(7);
  std::uniform_real_distribution<float> errors(0.5F, 12.0F);
  std::uniform_int_distribution<std::int64_t> sizes(1000, 120000);
  constexpr std::size_t kVisitors = 8;
  constexpr double kSeconds = 60.0;
  std::int64_t taken = 0;
  for (node::FrameNumber frame = 0; frame < 4 * kSeconds; ++frame) {
    for (node::SessionId visitor = 1; visitor <= kVisitors; ++visitor) {
      // The first does not walk.
      if (visitor == 1 && frame % 8 != 0) continue;
      const node::View view = viewOf(visitor, frame, 0.25 * frame, kVisitors);
      for (int object = 0; object < 12; ++object) {
        const float error = object == 0 ? kNothing : errors(dice);
        const std::int64_t texels = sizes(dice);
        if (budget.take(view, texels, error)) {
          taken += texels;
        } else if (object == 0) {
          budget.borrow(view, texels / 16);
          taken += texels / 16;
        }
      }
    }
  }
  const double max = kRate * (kSeconds + 2.0 * PictureBudget::kBurst) + kVisitors * 120000.0;
  EXPECT_LE(static_cast<double>(taken), max);
  EXPECT_GT(static_cast<double>(taken), 0.8 * kRate * kSeconds) << "what there is, is used";
}

}  // namespace
}  // namespace grove::objects::lightfield
