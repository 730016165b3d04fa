#include "stream/encode/h264/deblocking/deblocking_limits.h"

#include <array>
#include <cstddef>

namespace grove::stream::h264 {
namespace {

constexpr std::size_t kQuantisers = 52;

/// Alpha and beta of table 8-16; tC0 of table 8-17 for strengths 1 to 3.
struct StandardLimits {
  std::uint8_t alpha;
  std::uint8_t beta;
  std::array<std::uint8_t, 3> tC0;
};

/// Everything is 0 below.
constexpr std::size_t kFirstFiltered = 16;
constexpr std::array<StandardLimits, kQuantisers - kFirstFiltered> kStandardLimits = {{
    {4, 2, {0, 0, 0}},      {4, 2, {0, 0, 1}},       {5, 2, {0, 0, 1}},       {6, 3, {0, 0, 1}},
    {7, 3, {0, 0, 1}},      {8, 3, {0, 1, 1}},       {9, 3, {0, 1, 1}},       {10, 4, {1, 1, 1}},
    {12, 4, {1, 1, 1}},     {13, 4, {1, 1, 1}},      {15, 6, {1, 1, 1}},      {17, 6, {1, 1, 2}},
    {20, 7, {1, 1, 2}},     {22, 7, {1, 1, 2}},      {25, 8, {1, 1, 2}},      {28, 8, {1, 2, 3}},
    {32, 9, {1, 2, 3}},     {36, 9, {2, 2, 3}},      {40, 10, {2, 2, 4}},     {45, 10, {2, 3, 4}},
    {50, 11, {2, 3, 4}},    {56, 11, {3, 3, 5}},     {63, 12, {3, 4, 6}},     {71, 12, {3, 4, 6}},
    {80, 13, {4, 5, 7}},    {90, 13, {4, 5, 8}},     {101, 14, {4, 6, 9}},    {113, 14, {5, 7, 10}},
    {127, 15, {6, 8, 11}},  {144, 15, {6, 8, 13}},   {162, 16, {7, 10, 14}},  {182, 16, {8, 11, 16}},
    {203, 17, {9, 12, 18}}, {226, 17, {10, 13, 20}}, {255, 18, {11, 15, 23}}, {255, 18, {13, 17, 25}},
}};

constexpr std::array<DeblockingLimits, kQuantisers> limitsByQuantiser() {
  std::array<DeblockingLimits, kQuantisers> limits{};
  for (std::size_t i = 0; i < kStandardLimits.size(); ++i) {
    const StandardLimits& from = kStandardLimits[i];
    DeblockingLimits& to = limits[kFirstFiltered + i];
    to.alpha = from.alpha;
    to.beta = from.beta;
    for (std::size_t j = 0; j < from.tC0.size(); ++j) to.clips |= (from.tC0[j] + 1U) << (8 * (j + 1));
  }
  return limits;
}
constexpr std::array<DeblockingLimits, kQuantisers> kLimits = limitsByQuantiser();

}  // namespace

const DeblockingLimits& deblockingLimits(int quantiser) { return kLimits[static_cast<std::size_t>(quantiser)]; }

}  // namespace grove::stream::h264
