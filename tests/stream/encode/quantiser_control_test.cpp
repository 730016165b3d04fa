#include "stream/encode/quantiser_control.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace grove::stream {
namespace {

constexpr double kModelPixels = 1280.0 * 720.0;

/// Pictures whose bytes follow their quantiser as an encoder's do: by halves every five to seven steps.
class ModelEncoder {
 public:
  explicit ModelEncoder(double stepsPerHalving) : stepsPerHalving_(stepsPerHalving) {}

  /// `complexity`: bits of a pixel at quantiser 30.
  [[nodiscard]] double bytes(double complexity, Quantiser quantiser) {
    return complexity * spread_(random_) * kModelPixels / 8.0 * std::exp2((30.0 - quantiser) / stepsPerHalving_);
  }

 private:
  const double stepsPerHalving_;
  std::mt19937 random_{1};
  std::uniform_real_distribution<double> spread_{0.9, 1.1};
};

/// What so many pictures take that may take `wanted` each; complexity is a function of the picture's number.
struct Outcome {
  double bytes = 0.0;
  double largest = 0.0;
  Quantiser quantiser = 0.0;  ///< the last one's
};
Outcome run(QuantiserControl& control, ModelEncoder& encoder, int begin, int end, double wanted,
            const std::function<double(int)>& complexity) {
  Outcome result;
  for (int i = begin; i < end; ++i) {
    result.quantiser = std::ceil(std::clamp(control.choose(false, kModelPixels, wanted), 18.0, 45.0));
    const double bytes = encoder.bytes(complexity(i), result.quantiser);
    control.encoded(false, kModelPixels, result.quantiser, bytes, wanted);
    result.bytes += bytes;
    result.largest = std::max(result.largest, bytes);
  }
  return result;
}

// Faults: a model of bits that is off for an encoder whose steps halve them faster or more slowly; a debt that is
// never paid or never forgiven.
TEST(QuantiserControl, UsesItsBudget) {
  for (const double stepsPerHalving : {4.5, 6.0, 7.5}) {
    for (const double complexity : {0.03, 0.15, 0.5}) {
      for (const double wanted : {8'000.0, 16'000.0}) {
        QuantiserControl control;
        ModelEncoder encoder(stepsPerHalving);
        const auto same = [=](int) { return complexity; };
        (void)run(control, encoder, 0, 15, wanted, same);
        const Outcome settled = run(control, encoder, 15, 315, wanted, same);
        // Whole steps of the quantiser leave up to a sixth of an octave; beyond its range nothing can be done.
        if (settled.quantiser <= 18.0 || settled.quantiser >= 45.0) continue;
        EXPECT_NEAR(settled.bytes / 300.0, wanted, 0.2 * wanted)
            << stepsPerHalving << ", " << complexity << ", " << wanted;
      }
    }
  }
}

// Fault: an average of the last pictures, with which what begins to move takes five times its share for a while.
TEST(QuantiserControl, FollowsAJumpWithinOnePicture) {
  QuantiserControl control;
  ModelEncoder encoder(6.0);
  constexpr double kBytesWanted = 12'000.0;
  (void)run(control, encoder, 0, 60, kBytesWanted, [](int) { return 0.05; });
  const Outcome jump = run(control, encoder, 60, 61, kBytesWanted, [](int) { return 0.4; });
  ASSERT_GT(jump.bytes, 4.0 * kBytesWanted);
  const Outcome after = run(control, encoder, 61, 76, kBytesWanted, [](int) { return 0.4; });
  EXPECT_LT(after.largest, 1.2 * kBytesWanted);
  // What was spent too much is saved again.
  EXPECT_LT(jump.bytes + after.bytes, 1.3 * 16.0 * kBytesWanted);
}

// Fault: one picture that was cheap by chance, after which the next one takes several times its share.
TEST(QuantiserControl, IgnoresOneCheapPicture) {
  QuantiserControl control;
  ModelEncoder encoder(6.0);
  constexpr double kBytesWanted = 12'000.0;
  (void)run(control, encoder, 0, 60, kBytesWanted, [](int) { return 0.3; });
  (void)run(control, encoder, 60, 61, kBytesWanted, [](int) { return 0.03; });
  EXPECT_LT(run(control, encoder, 61, 63, kBytesWanted, [](int) { return 0.3; }).largest, 2.2 * kBytesWanted);
}

// Fault: independent pictures, which take several times the bits, that spoil what is known of the others.
TEST(QuantiserControl, TreatsIndependentPicturesSeparately) {
  QuantiserControl control;
  ModelEncoder encoder(6.0);
  constexpr double kBytesWanted = 12'000.0;
  const auto same = [](int) { return 0.1; };
  const Outcome before = run(control, encoder, 0, 60, kBytesWanted, same);
  const Quantiser independent = control.choose(true, kModelPixels, kBytesWanted);
  control.encoded(true, kModelPixels, independent, 6.0 * encoder.bytes(0.1, independent), kBytesWanted);
  const Outcome after = run(control, encoder, 60, 120, kBytesWanted, same);
  EXPECT_NEAR(before.bytes, after.bytes, 0.2 * before.bytes);
  // The next one is led by what the last took, to three times the share of others.
  const Quantiser next = control.choose(true, kModelPixels, kBytesWanted);
  EXPECT_NEAR(6.0 * encoder.bytes(0.1, next), 3.0 * kBytesWanted, 0.3 * 3.0 * kBytesWanted);
}

// Fault: pictures without a byte, or of none that are wanted, from which no number comes.
TEST(QuantiserControl, StaysFiniteAtExtremes) {
  QuantiserControl control;
  for (int i = 0; i < 50; ++i) control.encoded(false, kModelPixels, 20.0, 0.0, 0.0);
  EXPECT_TRUE(std::isfinite(control.choose(false, kModelPixels, 0.0)));
  EXPECT_TRUE(std::isfinite(control.choose(true, kModelPixels, 1e12)));
  EXPECT_TRUE(std::isfinite(control.complexity()));
}

}  // namespace
}  // namespace grove::stream
