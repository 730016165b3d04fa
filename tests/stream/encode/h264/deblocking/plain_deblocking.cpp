#include "stream/encode/h264/deblocking/plain_deblocking.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace grove::tests {

using stream::h264::Macroblock;

namespace {

/// Table 8-16.
constexpr std::array<int, 52> kAlpha = {0,  0,  0,  0,  0,  0,  0,   0,   0,   0,   0,   0,   0,   0,   0,   0,  4,  4,
                                        5,  6,  7,  8,  9,  10, 12,  13,  15,  17,  20,  22,  25,  28,  32,  36, 40, 45,
                                        50, 56, 63, 71, 80, 90, 101, 113, 127, 144, 162, 182, 203, 226, 255, 255};
constexpr std::array<int, 52> kBeta = {0,  0,  0,  0,  0,  0,  0,  0,  0,  0,  0,  0,  0,  0,  0,  0, 2,  2,
                                       2,  3,  3,  3,  3,  4,  4,  4,  6,  6,  7,  7,  8,  8,  9,  9, 10, 10,
                                       11, 11, 12, 12, 13, 13, 14, 14, 15, 15, 16, 16, 17, 17, 18, 18};
/// Table 8-17, by strength - 1.
constexpr std::array<std::array<int, 52>, 3> kTC0 = {{
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1,  1,  1,
     1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 4, 4, 4, 5, 6, 6, 7, 8, 9, 10, 11, 13},
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,  1,  1,  1,  1,  1,
     1, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 4, 4, 5, 5, 6, 7, 8, 8, 10, 11, 12, 13, 15, 17},
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1,  1,  1,  1,  1,  1,  1,  1,  1,
     1, 2, 2, 2, 2, 3, 3, 3, 4, 4, 4, 5, 6, 6, 7, 8, 9, 10, 11, 13, 14, 16, 18, 20, 23, 25},
}};
/// Table 8-15, from 30 on.
constexpr std::array<int, 22> kChromaQuantiser = {29, 30, 31, 32, 32, 33, 34, 34, 35, 35, 36,
                                                  36, 37, 37, 37, 38, 38, 38, 39, 39, 39, 39};

int quantiserOf(const Macroblock& macroblock, bool chroma) {
  const int luma = macroblock.quantiser;
  return chroma && luma >= 30 ? kChromaQuantiser[static_cast<std::size_t>(luma - 30)] : luma;
}

/// Of the 4 x 4 block, or the 8 x 8 block's vector, that contains a sample of luma.
int countAt(const Macroblock& macroblock, int x, int y) {
  const int block = y % 16 / 4 * 4 + x % 16 / 4;
  return macroblock.lumaCounts[static_cast<std::size_t>(block)];
}
const stream::MotionVector& vectorAt(const Macroblock& macroblock, int x, int y) {
  const int block = y % 16 / 8 * 2 + x % 16 / 8;
  return macroblock.vectors[static_cast<std::size_t>(block)];
}

/// Adds arrays of arrays of counts.
void addTo(int& sum, int value) { sum += value; }
template <typename Counts>
void addTo(Counts& sum, const Counts& values) {
  for (std::size_t i = 0; i < sum.size(); ++i) addTo(sum[i], values[i]);
}

}  // namespace

void DeblockingCases::add(const DeblockingCases& other) {
  addTo(strengths, other.strengths);
  addTo(filtered, other.filtered);
  addTo(strongSmooth, other.strongSmooth);
  addTo(normalSmooth, other.normalSmooth);
  addTo(clipped, other.clipped);
}

void PlainDeblocking::run() {
  for (int row = 0; row < grid_.down; ++row) {
    for (int column = 0; column < grid_.across; ++column) filterMacroblock(column, row);
  }
}

void PlainDeblocking::filterMacroblock(int column, int row) {
  for (std::size_t plane = 0; plane < 3; ++plane) {
    const int size = plane == 0 ? 16 : 8;
    for (const bool vertical : {true, false}) {
      for (int at = 0; at < size; at += 4) {
        const bool border = at == 0 && (vertical ? column : row) == 0;
        if (border) continue;
        filterEdge(plane, vertical, {column * size + (vertical ? at : 0), row * size + (vertical ? 0 : at)});
      }
    }
  }
}

void PlainDeblocking::filterEdge(std::size_t plane, bool vertical, Place q0) {
  const int size = plane == 0 ? 16 : 8;
  for (int k = 0; k < size; ++k) {
    filterSamples(plane, vertical, vertical ? Place{q0.x, q0.y + k} : Place{q0.x + k, q0.y});
  }
}

void PlainDeblocking::filterSamples(std::size_t plane, bool vertical, Place q0) {
  const int reach = plane == 0 ? 4 : 2;
  const auto at = [&](int i) -> std::uint8_t& {
    return *picture_.plane(plane).at(vertical ? q0.x + i : q0.x, vertical ? q0.y : q0.y + i);
  };
  Samples samples{};
  for (int i = 0; i < reach; ++i) {
    samples.p[static_cast<std::size_t>(i)] = at(-1 - i);
    samples.q[static_cast<std::size_t>(i)] = at(i);
  }
  const Place p0 = vertical ? Place{q0.x - 1, q0.y} : Place{q0.x, q0.y - 1};
  samples = filtered(samples, settingAt(plane, p0, q0));
  for (int i = 0; i < reach; ++i) {
    at(-1 - i) = static_cast<std::uint8_t>(samples.p[static_cast<std::size_t>(i)]);
    at(i) = static_cast<std::uint8_t>(samples.q[static_cast<std::size_t>(i)]);
  }
}

const Macroblock& PlainDeblocking::macroblockAt(Place luma) const { return grid_.at(luma.x / 16, luma.y / 16); }

int PlainDeblocking::strengthAt(Place p0, Place q0) const {
  const Macroblock& p = macroblockAt(p0);
  const Macroblock& q = macroblockAt(q0);
  if (p.intra || q.intra) return &p == &q ? 3 : 4;
  if (countAt(p, p0.x, p0.y) > 0 || countAt(q, q0.x, q0.y) > 0) return 2;
  const stream::MotionVector& a = vectorAt(p, p0.x, p0.y);
  const stream::MotionVector& b = vectorAt(q, q0.x, q0.y);
  return std::abs(a.x - b.x) >= 4 || std::abs(a.y - b.y) >= 4 ? 1 : 0;
}

PlainDeblocking::Setting PlainDeblocking::settingAt(std::size_t plane, Place p0, Place q0) {
  const bool chroma = plane != 0;
  // 8.7.2: chroma has the strength of the luma sample in the same place of the picture.
  const int scale = chroma ? 2 : 1;
  const Place lumaQ{q0.x * scale, q0.y * scale};
  const Place lumaP{lumaQ.x - (q0.x - p0.x), lumaQ.y - (q0.y - p0.y)};
  const int strength = strengthAt(lumaP, lumaQ);
  if (!chroma) ++cases_.strengths[static_cast<std::size_t>(strength)];
  const int quantiser = (quantiserOf(macroblockAt(lumaP), chroma) + quantiserOf(macroblockAt(lumaQ), chroma) + 1) >> 1;
  const auto index = static_cast<std::size_t>(quantiser);
  const int tC0 = strength == 0 || strength == 4 ? 0 : kTC0[static_cast<std::size_t>(strength - 1)][index];
  return {chroma, strength, kAlpha[index], kBeta[index], tC0};
}

PlainDeblocking::Samples PlainDeblocking::filtered(const Samples& from, const Setting& setting) {
  if (setting.strength == 0) return from;
  const auto& [p, q] = from;
  const bool filters = std::abs(p[0] - q[0]) < setting.alpha && std::abs(p[1] - p[0]) < setting.beta &&
                       std::abs(q[1] - q[0]) < setting.beta;  // 8-468
  ++cases_.filtered[setting.chroma ? 1 : 0][filters ? 1 : 0];
  if (!filters) return from;
  return setting.strength < 4 ? filteredBelow4(from, setting) : filteredWith4(from, setting);
}

PlainDeblocking::Samples PlainDeblocking::filteredBelow4(const Samples& from, const Setting& setting) {
  const auto& [p, q] = from;
  Samples to = from;
  const bool smoothP = !setting.chroma && std::abs(p[2] - p[0]) < setting.beta;
  const bool smoothQ = !setting.chroma && std::abs(q[2] - q[0]) < setting.beta;
  const int tC = setting.chroma ? setting.tC0 + 1 : setting.tC0 + (smoothP ? 1 : 0) + (smoothQ ? 1 : 0);
  const int wanted = (((q[0] - p[0]) << 2) + (p[1] - q[1]) + 4) >> 3;
  const int delta = std::clamp(wanted, -tC, tC);
  to.p[0] = std::clamp(p[0] + delta, 0, 255);
  to.q[0] = std::clamp(q[0] - delta, 0, 255);
  const int middle = (p[0] + q[0] + 1) >> 1;
  if (smoothP) to.p[1] = p[1] + std::clamp((p[2] + middle - (p[1] << 1)) >> 1, -setting.tC0, setting.tC0);
  if (smoothQ) to.q[1] = q[1] + std::clamp((q[2] + middle - (q[1] << 1)) >> 1, -setting.tC0, setting.tC0);
  if (!setting.chroma) {
    ++cases_.normalSmooth[0][smoothP ? 1 : 0];
    ++cases_.normalSmooth[1][smoothQ ? 1 : 0];
    ++cases_.clipped[delta != wanted ? 1 : 0];
  }
  return to;
}

PlainDeblocking::Samples PlainDeblocking::filteredWith4(const Samples& from, const Setting& setting) {
  const auto& [p, q] = from;
  Samples to = from;
  const bool small = std::abs(p[0] - q[0]) < ((setting.alpha >> 2) + 2);
  const bool longP = !setting.chroma && small && std::abs(p[2] - p[0]) < setting.beta;
  const bool longQ = !setting.chroma && small && std::abs(q[2] - q[0]) < setting.beta;
  to.p[0] = (2 * p[1] + p[0] + q[1] + 2) >> 2;
  to.q[0] = (2 * q[1] + q[0] + p[1] + 2) >> 2;
  if (longP) {
    to.p[0] = (p[2] + 2 * p[1] + 2 * p[0] + 2 * q[0] + q[1] + 4) >> 3;
    to.p[1] = (p[2] + p[1] + p[0] + q[0] + 2) >> 2;
    to.p[2] = (2 * p[3] + 3 * p[2] + p[1] + p[0] + q[0] + 4) >> 3;
  }
  if (longQ) {
    to.q[0] = (p[1] + 2 * p[0] + 2 * q[0] + 2 * q[1] + q[2] + 4) >> 3;
    to.q[1] = (p[0] + q[0] + q[1] + q[2] + 2) >> 2;
    to.q[2] = (2 * q[3] + 3 * q[2] + q[1] + q[0] + p[0] + 4) >> 3;
  }
  if (!setting.chroma) {
    ++cases_.strongSmooth[0][longP ? 1 : 0];
    ++cases_.strongSmooth[1][longQ ? 1 : 0];
  }
  return to;
}

}  // namespace grove::tests
