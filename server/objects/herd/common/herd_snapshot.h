#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "node/messages/shared_data.h"
#include "objects/herd/common/animal_pose.h"
#include "pipeline/vector_bytes.h"

namespace grove::objects::herd {

inline constexpr double kTicksPerSecond = 30.0;
inline constexpr std::size_t kMaxAnimals = 64;

/// How an animal looks.
enum class Kind : std::uint8_t { kDoe, kBuck, kFawn };
inline constexpr std::size_t kKinds = 3;

/// One animal of a tick.
struct Animal {
  Kind kind = Kind::kDoe;
  float size = 1.0F;      ///< of a grown doe
  float sunShare = 1.0F;  ///< share of the sun that trees and stones leave it, 0..1
  AnimalPose before;      ///< at the tick before, so that frames between two ticks can interpolate
  AnimalPose now;
};

/// The herd of one tick, for every visitor. Constructed from poses of any precision, it holds them rounded to what
/// bytes can say, so that the herd is the same over every transport.
class HerdSnapshot final : public node::SharedData {
 public:
  /// `time`: the world clock at the tick, seconds; infinite while the herd sleeps. At most kMaxAnimals.
  HerdSnapshot(std::uint64_t tick, double time, std::vector<Animal> animals);

  [[nodiscard]] double time() const noexcept { return time_; }
  [[nodiscard]] const std::vector<Animal>& animals() const noexcept { return animals_; }

  /// The pose of an animal for a frame at this time of the world clock, which is shown one tick late.
  [[nodiscard]] AnimalPose poseAt(const Animal& animal, double time) const;

 private:
  [[nodiscard]] std::size_t ownBytes() const noexcept override { return pipeline::vectorBytes(animals_); }
  [[nodiscard]] node::PackedBytes pack() const override;

  const std::uint64_t tick_;
  const double time_;
  const std::vector<Animal> animals_;
};

/// Throws node::PackingError unless a snapshot was packed to these bytes.
[[nodiscard]] std::shared_ptr<HerdSnapshot> unpackHerd(std::span<const std::byte> bytes);

}  // namespace grove::objects::herd
