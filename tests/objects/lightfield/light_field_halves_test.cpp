#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <iterator>
#include <map>
#include <thread>
#include <utility>
#include <vector>

#include "objects/lightfield/backend/simd/thicket.h"
#include "objects/lightfield/file/small_field.h"
#include "objects/lightfield/wood.h"

namespace grove::objects::lightfield {
namespace {

class LightFieldHalves : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { field_ = new LightField(Thicket().bake(4, 64, 2)); }
  static void TearDownTestSuite() { delete field_; }
  static LightField* field_;
};

LightField* LightFieldHalves::field_ = nullptr;

struct Fades {
  int going = 0;
  float min = 1.0F;  ///< share of the finer ones
  float max = 0.0F;
};

Fades fadesOf(const std::vector<Shown>& shown) {
  Fades fades;
  for (const Shown& each : shown) {
    if (!each.fade.from) continue;
    ++fades.going;
    fades.min = std::min(fades.min, each.fade.share);
    fades.max = std::max(fades.max, each.fade.share);
  }
  return fades;
}

/// Objects of which nothing better is under way.
std::ptrdiff_t finalOnes(const std::vector<Shown>& shown) { return std::ranges::count_if(shown, &Shown::isFinal); }

bool showsAll(const std::vector<Shown>& shown) {
  return std::ranges::none_of(shown,
                              [](const Shown& each) { return std::holds_alternative<node::Failure>(each.payload); });
}

TEST_F(LightFieldHalves, LoneVisitorIsNeverThrottled) {
  Wood wood(*field_, 1);
  for (node::FrameNumber frame = 1; frame <= 120; ++frame) (void)wood.look(0, frame, frame / 30.0);
  EXPECT_EQ(wood.counted("coarse views"), 0);
  EXPECT_LE(wood.counted("views shown stale"), wood.counted("view cache hits") / 10);
  EXPECT_GT(wood.counted("view cache misses"), 20);
}

// Fault: who joins others has everything drawn anew, coarsely, and delays everybody's frames.
TEST_F(LightFieldHalves, NewcomersBeginWithOthersPictures) {
  constexpr std::size_t kNewcomer = 8;  // looks almost where the first one looks, from some steps ahead
  Wood wood(*field_, kNewcomer + 1);
  node::FrameNumber frame = 0;
  for (; frame < 60; ++frame) (void)wood.look(0, frame + 1, frame / 30.0, false);
  const std::int64_t made = wood.counted("view cache misses");
  wood.steer(kNewcomer, frame, frame / 30.0, true);
  frame += 60;
  const auto shown = wood.look(kNewcomer, frame + 1, frame / 30.0, false);
  EXPECT_GT(shown.size(), 5U);
  ASSERT_TRUE(showsAll(shown));
  // Those at the frame's edges, which nobody has seen yet.
  EXPECT_LE(3 * wood.counted("coarse views"), std::ssize(shown));
  EXPECT_LE(wood.counted("view cache misses"), made + PictureBudget::kMaxNewPictures);
}

// Faults: a Governor that makes pictures smaller, to save work, has all shared pictures made anew at once; pictures of
// far more texels than pixels, which flicker, for ever.
TEST_F(LightFieldHalves, SmallerFramesBeginWithTheirLastPictures) {
  Wood wood(*field_, 1);
  node::FrameNumber frame = 0;
  for (; frame < 60; ++frame) (void)wood.look(0, frame + 1, frame / 30.0, false);
  const std::int64_t made = wood.counted("view cache misses");
  (void)wood.look(0, frame + 1, frame / 30.0, false, 153);
  EXPECT_LE(wood.counted("view cache misses"), made + PictureBudget::kMaxNewPictures);
  EXPECT_EQ(wood.counted("coarse views"), 0);
  for (; frame < 90; ++frame) (void)wood.look(0, frame + 1, frame / 30.0, false, 90);
  EXPECT_GT(wood.counted("view cache misses"), made + made / 2);
}

bool isPicture(const Shown& shown) {
  return std::holds_alternative<std::shared_ptr<const raster::Image>>(shown.payload);
}

/// The field with the faces of another, which outlives the result.
LightField withFacesOf(const LightField& other, LightField field) {
  field.near = other.near;
  field.near.colours.resize(field.colour.size(), field.near.colours.front());
  return field;
}

/// The visitor begins amid a thicket. Fails if its faces do not show there, or show elsewhere, too.
TEST_F(LightFieldHalves, EyesAmidAnObjectSeeItsFaces) {
  const LightField small = makeSmallField();
  Wood wood(withFacesOf(small, *field_), 1);
  const auto shown = wood.look(0, 1, 0.0, false);
  ASSERT_TRUE(showsAll(shown));
  EXPECT_EQ(std::ranges::count_if(shown, isPicture), 1);
  EXPECT_GT(shown.size(), 1U);
}

/// Fails if blurred pictures stay before an eye at rest, if walking eyes or heads that turn cause sharp ones, which are
/// expensive, or if a backdrop with blurred ones is not drawn again.
TEST_F(LightFieldHalves, EyesAtRestSeeSharpPictures) {
  const LightField small = makeSmallField();
  Wood wood(withFacesOf(small, *field_), 1);
  node::FrameNumber frame = 0;
  const auto look = [&](int frames, bool walks) {
    std::vector<Shown> shown;
    for (int i = 0; i < frames; ++i, ++frame) shown = wood.look(0, frame + 1, frame / 30.0, walks);
    return shown;
  };
  (void)look(60, true);
  const auto arriving = look(6, false);
  EXPECT_EQ(wood.counted("sharp views"), 0) << "it may walk on";
  EXPECT_LT(finalOnes(arriving), std::ssize(arriving));
  const auto resting = look(90, false);
  const std::int64_t sharp = wood.counted("sharp views");
  EXPECT_GT(sharp, 3);
  EXPECT_EQ(finalOnes(resting), std::ssize(resting));
  (void)look(30, false);
  EXPECT_EQ(wood.counted("sharp views"), sharp) << "once";
  (void)look(60, true);
  EXPECT_EQ(wood.counted("sharp views"), sharp);
}

/// Fails if a field without faces asks for them, again and again.
TEST_F(LightFieldHalves, WithoutFacesNothingIsUnfinished) {
  Wood wood(*field_, 1);
  std::vector<Shown> shown;
  for (node::FrameNumber frame = 0; frame < 90; ++frame) shown = wood.look(0, frame + 1, frame / 30.0, false);
  EXPECT_EQ(wood.counted("sharp views"), 0);
  EXPECT_EQ(finalOnes(shown), std::ssize(shown));
}

TEST_F(LightFieldHalves, RefinementDoesNotJump) {
  Wood wood(*field_, 1);
  node::FrameNumber frame = 1;
  double now = 0.0;
  const auto look = [&] { return wood.look(0, frame++, now += 1.0 / 30.0, false); };
  while (frame < 90) (void)look();
  EXPECT_EQ(fadesOf(look()).going, 0);
  wood.show(Thicket().bake(4, 128, 2));
  // Everything that shows goes over to it, as the budget has it, and begins with the picture that was there.
  std::map<int, int> seen;
  int objects = 0;
  float last = 0.0F;
  bool isFirst = true;
  for (int i = 0; i < 120; ++i) {
    const auto payloads = look();
    ASSERT_TRUE(showsAll(payloads));
    objects = static_cast<int>(payloads.size());
    const Fades fades = fadesOf(payloads);
    if (fades.going == 0) continue;
    EXPECT_LE(finalOnes(payloads), objects - fades.going);
    if (std::exchange(isFirst, false)) {
      EXPECT_LT(fades.min, 0.01F);
    }
    EXPECT_LT(fades.max - last, 0.1F) << "no more than a frame's share at once";
    last = std::max(last, fades.max);
    ++seen[fades.going];
  }
  ASSERT_GT(objects, 5);
  EXPECT_FALSE(isFirst);
  EXPECT_GT(last, 0.9F);
  EXPECT_GT(seen.rbegin()->first, objects / 2) << "most objects faded";
  EXPECT_EQ(fadesOf(look()).going, 0) << "and it comes to an end";
  EXPECT_EQ(finalOnes(look()), objects);
}

/// For the thread sanitizer, too: requests in progress hold on to what they began with.
TEST_F(LightFieldHalves, LightFieldsMayChangeDuringFrames) {
  Wood wood(*field_, 2);
  const LightField finer = Thicket().bake(2, 64, 2);
  std::atomic<bool> done{false};
  std::jthread shower([&] {
    for (int i = 0; i < 5; ++i) {
      wood.show(i % 2 == 0 ? finer : *field_);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    done = true;
  });
  for (node::FrameNumber frame = 1; !done; ++frame) {
    for (const std::size_t visitor : {0U, 1U}) {
      const auto payloads = wood.look(visitor, frame, frame / 30.0);
      ASSERT_TRUE(showsAll(payloads));
      ASSERT_FALSE(payloads.empty());
    }
  }
}

TEST_F(LightFieldHalves, OverloadedCrowdStaysWithinTheBudget) {
  // Pictures of this light field are small; so many share the budget that those who look get few.
  constexpr int kVisitors = 800;
  constexpr std::size_t kLooking = 8;
  constexpr double kSeconds = 10.0;
  Wood wood(*field_, kVisitors);
  const double share = LightFieldBackend::texelsPerSecond(1) * kLooking / kVisitors;
  const auto late = [&] {
    return wood.counted("coarse views") + wood.counted("views shown stale") + wood.counted("near views shown stale");
  };
  node::FrameNumber frame = 0;
  for (; frame < 4 * kSeconds; ++frame) {
    for (std::size_t visitor = 0; visitor < kLooking; ++visitor) {
      const std::int64_t before = late();
      const auto shown = wood.look(visitor, frame + 1, 0.25 * frame);
      ASSERT_TRUE(showsAll(shown));
      const auto final = static_cast<std::int64_t>(finalOnes(shown));
      ASSERT_EQ(final<static_cast<std::int64_t>(shown.size()), late()> before);
    }
  }
  EXPECT_LE(static_cast<double>(wood.counted("texels of new views")), share * (kSeconds + 1.0) + kLooking * 64 * 64);
  EXPECT_GT(wood.counted("coarse views"), 10);
  EXPECT_GT(wood.counted("views shown stale") + wood.counted("near views shown stale"), 100);

  // Who stands still has proper pictures of everything in the end.
  for (; frame < 4 * 6 * kSeconds; ++frame) (void)wood.look(0, frame + 1, 0.25 * frame, false);
  const std::int64_t before = late();
  (void)wood.look(0, frame + 1, 0.25 * frame, false);
  EXPECT_EQ(late(), before);
}

}  // namespace
}  // namespace grove::objects::lightfield
