#include "objects/herd/common/herd_snapshot.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

/// Packed, little-endian:
///
///     offset  size  what
///          0     4  "GHRD"
///          4     2  version, 1
///          6     2  animals
///          8     8  tick
///         16     8  time, seconds, double
///         24   124  per animal: PackedAnimal
namespace grove::objects::herd {
namespace {

static_assert(std::endian::native == std::endian::little, "structures are copied as they are");

constexpr float kPlaceSteps = 4096.0F;    // per metre
constexpr float kFootSteps = 8192.0F;     // per metre, from the animal's place
constexpr float kPostureSteps = 8192.0F;  // per metre and radian
constexpr float kWholeTurn = 6.2831853F;
constexpr float kYawSteps = 10'000.0F;  // per radian
constexpr float kShareSteps = 255.0F;
constexpr float kSizeSteps = 100.0F;

struct PackedPose {
  std::array<std::int32_t, 3> place{};
  std::array<std::array<std::int16_t, 3>, kLegs> feet{};
  std::array<std::int16_t, kPostureValues> posture{};
  std::int16_t yaw = 0;
  std::int16_t zero = 0;
};
static_assert(sizeof(PackedPose) == 60);

struct PackedAnimal {
  std::uint8_t kind = 0;
  std::uint8_t size = 0;
  std::uint8_t sunShare = 0;
  std::uint8_t zero = 0;
  PackedPose before;
  PackedPose now;
};
static_assert(sizeof(PackedAnimal) == 124);

struct Header {
  std::array<char, 4> magic{'G', 'H', 'R', 'D'};
  std::uint16_t version = 1;
  std::uint16_t count = 0;
  std::uint64_t tick = 0;
  double time = 0.0;
};
static_assert(sizeof(Header) == 24);

template <class Integer>
Integer steps(float value, float perUnit) {
  const float highest = 0.995F * static_cast<float>(std::numeric_limits<Integer>::max());
  return static_cast<Integer>(std::lround(std::clamp(value * perUnit, -highest, highest)));
}

PackedPose inSteps(const AnimalPose& pose) {
  PackedPose bytes;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    bytes.place[i] = steps<std::int32_t>(pose.place[axis], kPlaceSteps);
    const float place = static_cast<float>(bytes.place[i]) / kPlaceSteps;
    for (std::size_t leg = 0; leg < kLegs; ++leg) {
      bytes.feet[leg][i] = steps<std::int16_t>(pose.feet[leg][axis] - place, kFootSteps);
    }
  }
  const auto posture = std::bit_cast<std::array<float, kPostureValues>>(pose.posture);
  std::ranges::transform(posture, bytes.posture.begin(),
                         [](float value) { return steps<std::int16_t>(value, kPostureSteps); });
  bytes.yaw = steps<std::int16_t>(std::remainder(pose.yaw, kWholeTurn), kYawSteps);
  return bytes;
}

AnimalPose unpacked(const PackedPose& bytes) {
  AnimalPose pose;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    pose.place[axis] = static_cast<float>(bytes.place[i]) / kPlaceSteps;
    for (std::size_t leg = 0; leg < kLegs; ++leg) {
      pose.feet[leg][axis] = pose.place[axis] + static_cast<float>(bytes.feet[leg][i]) / kFootSteps;
    }
  }
  std::array<float, kPostureValues> posture{};
  std::ranges::transform(bytes.posture, posture.begin(),
                         [](std::int16_t value) { return static_cast<float>(value) / kPostureSteps; });
  pose.posture = std::bit_cast<Posture>(posture);
  pose.yaw = static_cast<float>(bytes.yaw) / kYawSteps;
  return pose;
}

PackedAnimal inSteps(const Animal& animal) {
  return {static_cast<std::uint8_t>(animal.kind),
          static_cast<std::uint8_t>(std::lround(std::clamp(animal.size * kSizeSteps, 1.0F, 255.0F))),
          static_cast<std::uint8_t>(std::lround(std::clamp(animal.sunShare, 0.0F, 1.0F) * kShareSteps)),
          0,
          inSteps(animal.before),
          inSteps(animal.now)};
}

Animal unpacked(const PackedAnimal& bytes) {
  return {static_cast<Kind>(bytes.kind), static_cast<float>(bytes.size) / kSizeSteps,
          static_cast<float>(bytes.sunShare) / kShareSteps, unpacked(bytes.before), unpacked(bytes.now)};
}

std::vector<Animal> rounded(std::vector<Animal> animals) {
  for (Animal& animal : animals) animal = unpacked(inSteps(animal));
  return animals;
}

[[noreturn]] void refuse(const char* reason) { throw node::PackingError(std::string("a packed herd: ") + reason); }

}  // namespace

HerdSnapshot::HerdSnapshot(std::uint64_t tick, double time, std::vector<Animal> animals)
    : SharedData(static_cast<node::Version>(tick), kTicksPerSecond),
      tick_(tick),
      time_(time),
      animals_(rounded(std::move(animals))) {
  assert(animals_.size() <= kMaxAnimals);
}

AnimalPose HerdSnapshot::poseAt(const Animal& animal, double time) const {
  const double ticks = (time - time_) * kTicksPerSecond;
  const auto share = static_cast<float>(std::clamp(std::isfinite(ticks) ? ticks : 1.0, 0.0, 1.0));
  return mixed(animal.before, animal.now, share);
}

node::PackedBytes HerdSnapshot::pack() const {
  const Header header{.count = static_cast<std::uint16_t>(animals_.size()), .tick = tick_, .time = time_};
  node::PackedBytes bytes(sizeof header + animals_.size() * sizeof(PackedAnimal));
  std::memcpy(bytes.data(), &header, sizeof header);
  std::byte* out = bytes.data() + sizeof header;
  for (const Animal& animal : animals_) {
    const PackedAnimal one = inSteps(animal);
    std::memcpy(out, &one, sizeof one);
    out += sizeof one;
  }
  return bytes;
}

std::shared_ptr<HerdSnapshot> unpackHerd(std::span<const std::byte> bytes) {
  Header header;
  if (bytes.size() < sizeof header) refuse("it is too short");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.magic != Header{}.magic || header.version != Header{}.version) refuse("it is of another kind or version");
  if (header.count > kMaxAnimals) refuse("it has too many animals");
  if (bytes.size() != sizeof header + header.count * sizeof(PackedAnimal)) refuse("it has another length");
  if (std::isnan(header.time)) refuse("it has no time");
  std::vector<Animal> animals;
  animals.reserve(header.count);
  for (std::size_t i = 0; i < header.count; ++i) {
    PackedAnimal one;
    std::memcpy(&one, bytes.data() + sizeof header + i * sizeof one, sizeof one);
    if (one.kind >= kKinds || one.size == 0) refuse("it has an unknown animal");
    animals.push_back(unpacked(one));
  }
  return std::make_shared<HerdSnapshot>(header.tick, header.time, std::move(animals));
}

}  // namespace grove::objects::herd
