#include "objects/fluid/common/snapshot_planes.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace grove::objects::fluid {
namespace {

constexpr float kLifetimeSteps = FluidSnapshot::kLifetimeSteps;
constexpr float kAgeSteps = 2048.0F;

using Vector = std::vector<float>;
constexpr std::array kPositions{&FluidSnapshot::x, &FluidSnapshot::y, &FluidSnapshot::z};
constexpr std::array kVelocities{&FluidSnapshot::velocityX, &FluidSnapshot::velocityY, &FluidSnapshot::velocityZ};
constexpr std::array kShares{&FluidSnapshot::temperature, &FluidSnapshot::skyLight, &FluidSnapshot::sunLight};

constexpr std::size_t kVelocityPlane = 6;
constexpr std::size_t kLifetimePlane = 9;
constexpr std::size_t kAgePlane = 11;
constexpr std::size_t kSharePlane = 13;

inline std::int32_t rounded(float value, float most) {
  return static_cast<std::int32_t>(std::min(most, std::max(0.0F, value)) + 0.5F);
}

struct Ends {
  float low, high;
};

/// The least and the largest of at least one value.
Ends endsOf(const float* values, std::size_t count) {
  float low = values[0];
  float high = values[0];
  for (std::size_t i = 0; i < count; ++i) {
    low = values[i] < low ? values[i] : low;
    high = values[i] > high ? values[i] : high;
  }
  return {low, high};
}

/// (values - offset) * scale in 16 bits, low bytes and high bytes apart.
void split(const float* __restrict values, std::size_t count, float offset, float scale, std::uint8_t* __restrict low,
           std::uint8_t* __restrict high) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t number = rounded((values[i] - offset) * scale, 65535.0F);
    low[i] = static_cast<std::uint8_t>(number & 255);
    high[i] = static_cast<std::uint8_t>(number >> 8);
  }
}

void join(const std::uint8_t* __restrict low, const std::uint8_t* __restrict high, std::size_t count, float offset,
          float scale, float* __restrict values) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t number = low[i] | high[i] << 8;
    values[i] = offset + scale * static_cast<float>(number);
  }
}

void packVelocity(const float* __restrict values, std::size_t count, float fastest, std::uint8_t* __restrict plane) {
  const float scale = fastest > 0.0F ? 1.0F / fastest : 0.0F;
  for (std::size_t i = 0; i < count; ++i) {
    const float share = std::sqrt(std::min(1.0F, std::abs(values[i]) * scale));
    const float signedShare = values[i] < 0.0F ? -share : share;
    plane[i] = static_cast<std::uint8_t>(rounded(128.0F + 127.0F * signedShare, 255.0F));
  }
}

void unpackVelocity(const std::uint8_t* __restrict plane, std::size_t count, float fastest, float* __restrict values) {
  const float scale = fastest / (127.0F * 127.0F);
  for (std::size_t i = 0; i < count; ++i) {
    const float root = static_cast<float>(static_cast<std::int32_t>(plane[i]) - 128);
    values[i] = scale * root * std::abs(root);
  }
}

/// Differences to the entry before as 0, -1, 1, -2, 2 ..., modulo 65536.
void packAges(const float* __restrict ages, std::size_t count, std::uint8_t* __restrict low,
              std::uint8_t* __restrict high) {
  const auto put = [&](std::size_t i, std::int32_t before) {
    const std::int32_t step = static_cast<std::int16_t>(rounded(ages[i] * kAgeSteps, 65535.0F) - before);
    const std::int32_t folded = step * 2 ^ step >> 15;
    low[i] = static_cast<std::uint8_t>(folded & 255);
    high[i] = static_cast<std::uint8_t>(folded >> 8 & 255);
  };
  if (count > 0) put(0, 0);
  for (std::size_t i = 1; i < count; ++i) put(i, rounded(ages[i - 1] * kAgeSteps, 65535.0F));
}

void unpackAges(const std::uint8_t* __restrict low, const std::uint8_t* __restrict high, std::size_t count,
                float* __restrict ages) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t folded = low[i] | static_cast<std::uint32_t>(high[i]) << 8U;
    number = (number + (folded >> 1U ^ (0U - (folded & 1U)))) & 65535U;
    ages[i] = static_cast<float>(static_cast<std::int32_t>(number)) * (1.0F / kAgeSteps);
  }
}

void packShares(const float* __restrict values, std::size_t count, std::uint8_t* __restrict plane) {
  for (std::size_t i = 0; i < count; ++i) plane[i] = static_cast<std::uint8_t>(rounded(values[i] * 255.0F, 255.0F));
}

void unpackShares(const std::uint8_t* __restrict plane, std::size_t count, float* __restrict values) {
  for (std::size_t i = 0; i < count; ++i) {
    values[i] = static_cast<float>(static_cast<std::int32_t>(plane[i])) * (1.0F / 255.0F);
  }
}

}  // namespace

SnapshotRange rangeOf(const FluidSnapshot& snapshot) {
  SnapshotRange range;
  const std::size_t count = snapshot.count();
  if (count == 0) return range;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Ends places = endsOf((snapshot.*kPositions[axis]).data(), count);
    const Ends speeds = endsOf((snapshot.*kVelocities[axis]).data(), count);
    range.low[axis] = places.low;
    range.size[axis] = places.high - places.low;
    range.fastest = std::max({range.fastest, -speeds.low, speeds.high});
  }
  return range;
}

void toPlanes(const FluidSnapshot& snapshot, const SnapshotRange& range, std::span<std::uint8_t> planes) {
  const std::size_t count = snapshot.count();
  assert(planes.size() >= kPlanes * count);
  const auto plane = [&](std::size_t index) { return planes.data() + index * count; };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float scale = range.size[axis] > 0.0F ? 65535.0F / range.size[axis] : 0.0F;
    split((snapshot.*kPositions[axis]).data(), count, range.low[axis], scale, plane(2 * axis), plane(2 * axis + 1));
    packVelocity((snapshot.*kVelocities[axis]).data(), count, range.fastest, plane(kVelocityPlane + axis));
    packShares((snapshot.*kShares[axis]).data(), count, plane(kSharePlane + axis));
  }
  split(snapshot.lifetime.data(), count, 0.0F, kLifetimeSteps, plane(kLifetimePlane), plane(kLifetimePlane + 1));
  packAges(snapshot.age.data(), count, plane(kAgePlane), plane(kAgePlane + 1));
}

void fromPlanes(const std::array<const std::uint8_t*, kPlanes>& planes, std::size_t count, const SnapshotRange& range,
                FluidSnapshot& snapshot) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    join(planes[2 * axis], planes[2 * axis + 1], count, range.low[axis], range.size[axis] / 65535.0F,
         (snapshot.*kPositions[axis]).data());
    unpackVelocity(planes[kVelocityPlane + axis], count, range.fastest, (snapshot.*kVelocities[axis]).data());
    unpackShares(planes[kSharePlane + axis], count, (snapshot.*kShares[axis]).data());
  }
  join(planes[kLifetimePlane], planes[kLifetimePlane + 1], count, 0.0F, 1.0F / kLifetimeSteps,
       snapshot.lifetime.data());
  unpackAges(planes[kAgePlane], planes[kAgePlane + 1], count, snapshot.age.data());
}

}  // namespace grove::objects::fluid
