#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "each_target.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "base/simd/lanes_kernels_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/simd/lanes_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::simd::HWY_NAMESPACE {

constexpr std::size_t kCount = kLanes;
constexpr std::array<float, 16> kA = {0, -1, 2.5F, -2.5F, 3.75F, 7, -0.25F, 100, 1, -8, 0.5F, 6, -3, 9.125F, 2, -7};
constexpr std::array<float, 16> kB = {1, -1, 2, -3, 4, 8, 0.25F, -100, 3, 5, 0.5F, 7, -2, 16, -2, 1};
constexpr std::array<std::int32_t, 16> kI = {0, -1, 7, 255, -256, 65536, 3, 1, 9, -9, 40, 2, -3, 11, 12, 13};

/// Fails where a lane holds something else than `plain` says of its operands.
template <typename Plain>
void expectFloats(const char* what, Floats lanes, Plain plain) {
  std::array<float, kCount> values{};
  store(lanes, values.data());
  for (std::size_t i = 0; i < kCount; ++i) EXPECT_FLOAT_EQ(values[i], plain(kA[i], kB[i])) << what << ", lane " << i;
}
template <typename Plain>
void expectInts(const char* what, Ints lanes, Plain plain) {
  std::array<std::int32_t, kCount> values{};
  store(lanes, values.data());
  for (std::size_t i = 0; i < kCount; ++i) EXPECT_EQ(values[i], plain(i)) << what << ", lane " << i;
}

void testFloats() {
  const Floats a = load(kA.data());
  const Floats b = load(kB.data());
  expectFloats("+", a + b, [](float x, float y) { return x + y; });
  expectFloats("-", a - b, [](float x, float y) { return x - y; });
  expectFloats("*", a * b, [](float x, float y) { return x * y; });
  expectFloats("/", a / b, [](float x, float y) { return x / y; });
  expectFloats("negative", -a, [](float x, float) { return -x; });
  expectFloats("min", min(a, b), [](float x, float y) { return std::min(x, y); });
  expectFloats("max", max(a, b), [](float x, float y) { return std::max(x, y); });
  expectFloats("clamp", clamp(a, -1.0F, 2.0F), [](float x, float) { return std::clamp(x, -1.0F, 2.0F); });
  expectFloats("abs", abs(a), [](float x, float) { return std::abs(x); });
  expectFloats("sqrt", sqrt(abs(a)), [](float x, float) { return std::sqrt(std::abs(x)); });
  expectFloats("floor", floor(a), [](float x, float) { return std::floor(x); });
  expectFloats("mulAdd", mulAdd(a, b, 2.0F), [](float x, float y) { return x * y + 2.0F; });
  EXPECT_EQ(minOf(a), *std::min_element(kA.begin(), kA.begin() + kCount));
  EXPECT_EQ(maxOf(a), *std::max_element(kA.begin(), kA.begin() + kCount));
  float sum = 0.0F;
  for (std::size_t i = 0; i < kCount; ++i) sum += kA[i];
  EXPECT_FLOAT_EQ(sumOf(a), sum);
}

void testInts() {
  const Ints i = load(kI.data());
  const Floats a = load(kA.data());
  expectInts("+", i + 3, [](std::size_t at) { return kI[at] + 3; });
  expectInts("-", 3 - i, [](std::size_t at) { return 3 - kI[at]; });
  expectInts("*", i * 7, [](std::size_t at) { return kI[at] * 7; });
  expectInts("&", i & 0xF0, [](std::size_t at) { return kI[at] & 0xF0; });
  expectInts("|", i | 0xF0, [](std::size_t at) { return kI[at] | 0xF0; });
  expectInts("<<", shiftLeft<4>(i), [](std::size_t at) { return kI[at] * 16; });
  expectInts(">>", shiftRight<4>(i),
             [](std::size_t at) { return static_cast<std::int32_t>(static_cast<std::uint32_t>(kI[at]) >> 4U); });
  expectInts("truncate", truncate(a), [](std::size_t at) { return static_cast<std::int32_t>(kA[at]); });
  expectInts("floor", floorToInts(a), [](std::size_t at) { return static_cast<std::int32_t>(std::floor(kA[at])); });
  expectInts("upwards", upwards(), [](std::size_t at) { return static_cast<std::int32_t>(at); });
  EXPECT_EQ(maxOf(i), *std::max_element(kI.begin(), kI.begin() + kCount));
}

void testMasks() {
  const Floats a = load(kA.data());
  const Floats b = load(kB.data());
  const Ints i = load(kI.data());
  const auto chosen = [&](Mask mask) { return select(mask, Ints(1), Ints(0)); };
  expectInts("<", chosen(a < b), [](std::size_t at) { return kA[at] < kB[at] ? 1 : 0; });
  expectInts("<=", chosen(a <= b), [](std::size_t at) { return kA[at] <= kB[at] ? 1 : 0; });
  expectInts(">", chosen(a > b), [](std::size_t at) { return kA[at] > kB[at] ? 1 : 0; });
  expectInts(">=", chosen(a >= b), [](std::size_t at) { return kA[at] >= kB[at] ? 1 : 0; });
  expectInts("whole <", chosen(i < 3), [](std::size_t at) { return kI[at] < 3 ? 1 : 0; });
  expectInts("whole >", chosen(i > 3), [](std::size_t at) { return kI[at] > 3 ? 1 : 0; });
  expectInts("==", chosen(i == 7), [](std::size_t at) { return kI[at] == 7 ? 1 : 0; });
  expectInts("!=", chosen(i != 7), [](std::size_t at) { return kI[at] != 7 ? 1 : 0; });
  expectInts("and", chosen((a < b) & (i > 3)), [](std::size_t at) { return kA[at] < kB[at] && kI[at] > 3 ? 1 : 0; });
  expectInts("or", chosen((a < b) | (i > 3)), [](std::size_t at) { return kA[at] < kB[at] || kI[at] > 3 ? 1 : 0; });
  expectInts("without", chosen(without(a<b, i> 3)),
             [](std::size_t at) { return kA[at] < kB[at] && kI[at] <= 3 ? 1 : 0; });
  expectFloats("select", select(a < b, a, b), [](float x, float y) { return x < y ? x : y; });
  expectFloats("onlyWhere", onlyWhere(a < b, a), [](float x, float y) { return x < y ? x : 0.0F; });
  EXPECT_TRUE(any(i == 7));
  EXPECT_FALSE(any(i == 12345));
  EXPECT_TRUE(all(i != 12345));
  EXPECT_FALSE(all(i != 7));
  EXPECT_FALSE(any(Mask()));
}

}  // namespace grove::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::simd {
namespace {

HWY_EXPORT(testFloats);
HWY_EXPORT(testInts);
HWY_EXPORT(testMasks);

/// Each fails if an operation does something else on some target.
TEST(LanesKernels, FloatsMatchScalar) {
  tests::onEachTarget([] { HWY_DYNAMIC_DISPATCH(testFloats)(); });
}
TEST(LanesKernels, IntsMatchScalar) {
  tests::onEachTarget([] { HWY_DYNAMIC_DISPATCH(testInts)(); });
}
TEST(LanesKernels, MasksMatchScalar) {
  tests::onEachTarget([] { HWY_DYNAMIC_DISPATCH(testMasks)(); });
}

}  // namespace
}  // namespace grove::simd

#endif  // HWY_ONCE
