#include "objects/fluid/backend/solver/advection/resampling.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace grove::objects::fluid {

namespace {

constexpr std::size_t kMaxValues = 129;  // along an axis: the faces of the finest grid
constexpr std::size_t kMaxKnown = 131;   // with ghosts

/// For each value of the target grid along an axis, the two values of the source grid around it.
struct Axis {
  Axis(int fromCells, int toCells, bool onFaces) : count(toCells + (onFaces ? 1 : 0)) {
    const double middle = onFaces ? 0.0 : 0.5;
    for (int i = 0; i < count; ++i) {
      const double at = (static_cast<double>(i) + middle) * fromCells / toCells - middle;
      const double below = std::floor(at);
      base[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(below);
      share[static_cast<std::size_t>(i)] = static_cast<float>(at - below);
    }
  }

  int count;
  std::array<std::int32_t, kMaxValues> base{};
  std::array<float, kMaxValues> share{};  ///< weight of the upper value
};

}  // namespace

void resample(const Layout& fromLayout, const Field& from, Place place, const Layout& toLayout, Field& to) {
  assert(toLayout.cells < static_cast<int>(kMaxValues) && fromLayout.cells < static_cast<int>(kMaxValues));
  const auto axis = [&](Place faces) { return Axis(fromLayout.cells, toLayout.cells, place == faces); };
  const Axis alongX = axis(Place::kFaceX);
  const Axis alongY = axis(Place::kFaceY);
  const Axis alongZ = axis(Place::kFaceZ);
  std::array<float, kMaxKnown> known{};
  const int length = fromLayout.cells + 3;
  for (int z = 0; z < alongZ.count; ++z) {
    const float fz = alongZ.share[static_cast<std::size_t>(z)];
    for (int y = 0; y < alongY.count; ++y) {
      const float fy = alongY.share[static_cast<std::size_t>(y)];
      const float* row = from.data() + fromLayout.index(-1, alongY.base[static_cast<std::size_t>(y)],
                                                        alongZ.base[static_cast<std::size_t>(z)]);
      const float* rowAbove = row + fromLayout.stride;
      const float* behind = row + fromLayout.plane;
      const float* behindAbove = behind + fromLayout.stride;
      for (int i = 0; i < length; ++i) {
        const float near = row[i] + fy * (rowAbove[i] - row[i]);
        const float far = behind[i] + fy * (behindAbove[i] - behind[i]);
        known[static_cast<std::size_t>(i)] = near + fz * (far - near);
      }
      const float* middle = known.data() + 1;
      float* __restrict out = to.data() + toLayout.index(0, y, z);
      for (int i = 0; i < alongX.count; ++i) {
        const std::int32_t below = alongX.base[static_cast<std::size_t>(i)];
        out[i] = middle[below] + alongX.share[static_cast<std::size_t>(i)] * (middle[below + 1] - middle[below]);
      }
    }
  }
}

}  // namespace grove::objects::fluid
