#include "objects/ground/shade_rows.h"

#include <algorithm>
#include <array>

#include "objects/ground/halves.h"

namespace grove::objects::ground {
namespace {

struct Curve {
  const FineSoil::Channels& first;
  const FineSoil::Channels& step;

  /// 0..255.
  [[nodiscard]] UnsignedHalves shown(int i, std::int16_t steps, UnsignedHalves root) const {
    const auto at = [&](FineSoil::Line FineSoil::Channels::*line) {
      return load<Halves>((first.*line).data() + i) + load<Halves>((step.*line).data() + i) * steps;
    };
    const auto q = reinterpret_cast<Halves>(root);
    const Halves slope = at(&FineSoil::Channels::slope) + part(q, at(&FineSoil::Channels::square));
    const Halves level = at(&FineSoil::Channels::base) + upper(q, slope);
    constexpr auto kMost = static_cast<std::int16_t>(256.0F * kSoilSteps - 1.0F);
    static_assert(kSoilSteps == 16.0F);
    return reinterpret_cast<UnsignedHalves>(least(most(level, Halves{}), Halves{} + kMost)) >> 4;
  }
};

/// What grows at the roots, its share that shows, and its depth.
void pull(const Frame& frame, const Row& row, const GrassRows& grass, std::uint32_t* __restrict grown,
          std::uint32_t* __restrict shares, float* __restrict depth) {
  // 16-bit values stay out of the loop that gathers, or the compiler would gather by 64-bit indices.
  alignas(64) std::array<int, kTile> roots;
  for (std::size_t i = 0; i < kTile; ++i) roots[i] = grass.roots[i];
  const std::uint32_t* __restrict texels = grass.texels.data();
  const float inverseStep = frame.inverseStep;
  const float inverse = frame.firstInverse + static_cast<float>(row.row) * inverseStep;
  const int thisRow = row.row;
  for (int i = 0; i < kTile; ++i) {
    const int root = roots[static_cast<std::size_t>(i)];
    const int above = root & static_cast<int>(kRootMask);
    const int share = root - above;
    grown[i] = texels[((thisRow + above) & (kRootRows - 1)) * kTile + i];
    shares[i] = static_cast<std::uint32_t>(share | share << 16);
    depth[i] = 1.0F / (inverse + static_cast<float>(above) * inverseStep);
  }
}

}  // namespace

void shadeRow(const Frame& frame, const Row& row, const SoilBetween& soil, const GrassRows& grass,
              std::uint32_t* __restrict colour, float* __restrict depth) {
  alignas(64) std::array<std::uint32_t, kTile> grown;
  alignas(64) std::array<std::uint32_t, kTile> shares;
  pull(frame, row, grass, grown.data(), shares.data(), depth);

  const Curve low{soil.first.low, soil.step.low};
  const Curve high{soil.first.high, soil.step.high};
  const auto steps = static_cast<std::int16_t>(soil.steps);
  for (int i = 0; i < kTile; i += kHalves / 2) {
    const auto texel = load<UnsignedHalves>(grown.data() + i);
    const auto share = load<UnsignedHalves>(shares.data() + i);
    const UnsignedHalves lowRoot = upper((texel & 0xFF) << 7, share);
    const UnsignedHalves highRoot = upper((texel >> 8) << 7, share);
    store(low.shown(2 * i, steps, lowRoot) | high.shown(2 * i, steps, highRoot) << 8, colour + i);
  }
}

}  // namespace grove::objects::ground
