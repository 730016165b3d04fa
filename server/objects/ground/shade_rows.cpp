#include "objects/ground/shade_rows.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace grove::objects::ground {
namespace {

inline float channel(std::uint32_t texel, unsigned shift) {
  return static_cast<float>(static_cast<int>((texel >> shift) & 0xFFU));
}

}  // namespace

void shadeRow(const Frame& frame, const Row& row, const FineSoil& soil, const GrassRows& grass,
              std::uint32_t* __restrict colour, float* __restrict depth) {
  // 16-bit values stay out of the loop that gathers, or the compiler would gather by 64-bit indices.
  alignas(64) std::array<int, kTile> rootRows;
  for (std::size_t i = 0; i < kTile; ++i) rootRows[i] = grass.roots[i];
  const int* __restrict roots = rootRows.data();
  const std::uint32_t* __restrict texels = grass.texels.data();
  const float inverseStep = frame.inverseStep;
  const float firstInverse = frame.firstInverse;
  const int thisRow = row.row;
  // Where blades are shorter than a pixel only their tops are seen.
  const float streak = row.pixelsPerMetre * (0.35F * kTallest);
  const float tops = std::clamp(1.5F - 0.5F * streak, 0.0F, 1.0F);
  const float heightStep = 1.0F / (std::max(1e-3F, row.pixelsPerMetre) * (0.62F * kTallest));

  for (int first = 0; first < kTile; first += kLanes) {
    const int sample = first / kCoarse;
    for (int lane = 0; lane < kLanes; ++lane) {
      const int i = first + lane;
      const int root = roots[i];
      const std::uint32_t texel = texels[(root & (kRootRows - 1)) * kTile + i];
      const float above = static_cast<float>(root - thisRow) + 0.5F;
      const float stalk = std::sqrt(std::min(1.0F, above * heightStep));
      // Deep in the grass it is dark; the curve is the root of 0.30 + 1.05 * stalk.
      const float relief = 0.548F + stalk * (0.86F - 0.25F * stalk);
      const float stood = std::min(1.0F, 4.0F * soil.grass.at(sample, lane) + (root > thisRow ? 1.0F : 0.0F));
      const float factor = (relief + (1.0F - relief) * std::max(tops, 1.0F - stood)) * kMeadowStep;
      const float r = channel(texel, 0) * factor;
      const float g = channel(texel, 8) * factor;
      const float b = channel(texel, 16) * factor;
      const float shownR = soil.channels[0].base.at(sample, lane) +
                           r * (soil.channels[0].slope.at(sample, lane) + r * soil.channels[0].square.at(sample, lane));
      const float shownG = soil.channels[1].base.at(sample, lane) +
                           g * (soil.channels[1].slope.at(sample, lane) + g * soil.channels[1].square.at(sample, lane));
      const float shownB = soil.channels[2].base.at(sample, lane) +
                           b * (soil.channels[2].slope.at(sample, lane) + b * soil.channels[2].square.at(sample, lane));
      const int byteR = static_cast<int>(std::clamp(shownR, 0.0F, 255.0F));
      const int byteG = static_cast<int>(std::clamp(shownG, 0.0F, 255.0F));
      const int byteB = static_cast<int>(std::clamp(shownB, 0.0F, 255.0F));
      colour[i] = static_cast<std::uint32_t>(byteR | byteG << 8 | byteB << 16) | 0xFF000000U;
      depth[i] = 1.0F / (firstInverse + static_cast<float>(root) * inverseStep);
    }
  }
}

}  // namespace grove::objects::ground
