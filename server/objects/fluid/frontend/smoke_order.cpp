#include "objects/fluid/frontend/smoke_order.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace grove::objects::fluid {

void SmokeOrder::sortBackToFront(std::span<const float> depth, std::vector<std::uint32_t>& sprites) {
  if (sprites.size() < 2) return;
  float nearest = depth[sprites.front()];
  float farthest = nearest;
  for (const std::uint32_t sprite : sprites) {
    nearest = std::min(nearest, depth[sprite]);
    farthest = std::max(farthest, depth[sprite]);
  }
  const float steps = 65535.0F / std::max(farthest - nearest, 1e-6F);

  entries_.resize(sprites.size());
  scratch_.resize(sprites.size());
  std::array<std::array<std::uint32_t, 256>, 2> places{};
  for (std::size_t i = 0; i < sprites.size(); ++i) {
    const auto key = std::min(static_cast<std::uint32_t>((farthest - depth[sprites[i]]) * steps), 65535U);
    entries_[i] = {key, sprites[i]};
    ++places[0][key & 255U];
    ++places[1][key >> 8U];
  }
  for (std::array<std::uint32_t, 256>& digit : places) {
    std::uint32_t sum = 0;
    for (std::uint32_t& place : digit) sum += std::exchange(place, sum);
  }
  for (const Entry& entry : entries_) scratch_[places[0][entry.key & 255U]++] = entry;
  for (const Entry& entry : scratch_) sprites[places[1][entry.key >> 8U]++] = entry.sprite;
}

}  // namespace grove::objects::fluid
