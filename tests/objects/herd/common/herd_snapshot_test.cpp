#include "objects/herd/common/herd_snapshot.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <random>

#include "objects/herd/poses.h"

namespace grove::objects::herd {
namespace {

node::PackedBytes packedBytesOf(const node::SharedData& data) {
  pipeline::Timeline timeline;
  return *data.packed(timeline, "herd");
}

/// Animals with poses that no rounded number says exactly.
std::vector<Animal> randomAnimals(std::size_t count) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> any(-1.0F, 1.0F);
  const auto randomPose = [&] {
    AnimalPose pose = standingAt({40.0F * any(random), 3.0F * any(random), 40.0F * any(random)}, 3.0F * any(random));
    for (world::Vec3& foot : pose.feet) foot += 0.2F * world::Vec3(any(random), any(random), any(random));
    pose.posture = {0.2F * any(random), 0.1F * any(random), 0.1F * any(random), 0.3F * any(random), any(random),
                    any(random),        any(random),        any(random),        any(random),        any(random)};
    return pose;
  };
  std::vector<Animal> animals;
  for (std::size_t i = 0; i < count; ++i) {
    animals.push_back({static_cast<Kind>(i % kKinds), 0.9F + 0.3F * any(random), 0.5F + 0.5F * any(random),
                       randomPose(), randomPose()});
  }
  return animals;
}

std::array<float, kPostureValues> valuesOf(const Posture& posture) {
  return std::bit_cast<std::array<float, kPostureValues>>(posture);
}

bool areSame(const AnimalPose& a, const AnimalPose& b) {
  return a.place == b.place && a.yaw == b.yaw && a.feet == b.feet && valuesOf(a.posture) == valuesOf(b.posture);
}

void expectSame(const HerdSnapshot& a, const HerdSnapshot& b) {
  EXPECT_EQ(a.version(), b.version());
  EXPECT_EQ(a.time(), b.time());
  ASSERT_EQ(a.animals().size(), b.animals().size());
  for (std::size_t i = 0; i < a.animals().size(); ++i) {
    const Animal& one = a.animals()[i];
    const Animal& other = b.animals()[i];
    EXPECT_EQ(one.kind, other.kind);
    EXPECT_EQ(one.size, other.size);
    EXPECT_EQ(one.sunShare, other.sunShare);
    EXPECT_TRUE(areSame(one.before, other.before)) << i;
    EXPECT_TRUE(areSame(one.now, other.now)) << i;
  }
}

/// Would catch herds that differ between a process and another machine, or that drift each time that they are sent on.
TEST(HerdSnapshotTest, BytesSayAllOfIt) {
  const HerdSnapshot herd(77, 12.5, randomAnimals(kMaxAnimals));
  const auto once = unpackHerd(packedBytesOf(herd));
  const auto twice = unpackHerd(packedBytesOf(*once));
  expectSame(herd, *once);
  expectSame(herd, *twice);
}

/// Would catch rounding that one could see.
TEST(HerdSnapshotTest, RoundsBelowAMillimetre) {
  const std::vector<Animal> animals = randomAnimals(20);
  const HerdSnapshot herd(1, 0.0, animals);
  for (std::size_t i = 0; i < animals.size(); ++i) {
    const AnimalPose& exact = animals[i].now;
    const AnimalPose& rounded = herd.animals()[i].now;
    EXPECT_LT(glm::distance(exact.place, rounded.place), 0.001F);
    for (std::size_t leg = 0; leg < kLegs; ++leg) EXPECT_LT(glm::distance(exact.feet[leg], rounded.feet[leg]), 0.001F);
    EXPECT_NEAR(exact.yaw, rounded.yaw, 0.001F);
    EXPECT_NEAR(exact.posture.neckYaw, rounded.posture.neckYaw, 0.001F);
  }
}

/// Would catch animals that jump from tick to tick, or that run ahead of their newest pose.
TEST(HerdSnapshotTest, InterpolatesWithinTheTick) {
  Animal animal;
  animal.before = standingAt({0, 0, 0});
  animal.now = standingAt({1, 0, 0});
  const HerdSnapshot herd(3, 10.0, {animal});
  const auto xAt = [&](double time) { return herd.poseAt(herd.animals()[0], time).place.x; };
  EXPECT_EQ(xAt(9.0), 0.0F);
  EXPECT_EQ(xAt(10.0), 0.0F);
  EXPECT_NEAR(xAt(10.0 + 0.25 / kTicksPerSecond), 0.25F, 1.0e-4F);
  EXPECT_EQ(xAt(11.0), 1.0F);
}

/// Would catch a sleeping herd that vanishes, or that stays at the tick before.
TEST(HerdSnapshotTest, ASleepingHerdStaysAtItsPose) {
  Animal animal;
  animal.before = standingAt({0, 0, 0});
  animal.now = standingAt({1, 0, 0});
  const HerdSnapshot herd(3, std::numeric_limits<double>::infinity(), {animal});
  EXPECT_EQ(unpackHerd(packedBytesOf(herd))->poseAt(herd.animals()[0], 5.0).place.x, 1.0F);
}

class HerdRefusalTest : public testing::Test {
 protected:
  node::PackedBytes bytes_ = packedBytesOf(HerdSnapshot(5, 1.0, randomAnimals(2)));
  void expectRefusal() const { EXPECT_THROW(static_cast<void>(unpackHerd(bytes_)), node::PackingError); }
  void set(std::size_t at, int value) { bytes_[at] = static_cast<std::byte>(value); }
};

// Each would catch bytes of another program that are read beyond their end, or shown as animals.

TEST_F(HerdRefusalTest, AcceptsUnchangedBytes) { EXPECT_EQ(unpackHerd(bytes_)->animals().size(), 2U); }

TEST_F(HerdRefusalTest, OtherLengths) {
  bytes_.pop_back();
  expectRefusal();
  bytes_.resize(10);
  expectRefusal();
  bytes_.clear();
  expectRefusal();
}

TEST_F(HerdRefusalTest, TooManyBytes) {
  bytes_.push_back(std::byte{0});
  expectRefusal();
}

TEST_F(HerdRefusalTest, AnotherMagic) {
  set(0, 'X');
  expectRefusal();
}

TEST_F(HerdRefusalTest, AnotherVersion) {
  set(4, 2);
  expectRefusal();
}

TEST_F(HerdRefusalTest, AnotherCount) {
  set(6, 3);
  expectRefusal();
}

TEST_F(HerdRefusalTest, MoreThanTheMostAnimals) {
  const std::size_t animal = (bytes_.size() - 24) / 2;
  bytes_.resize(24 + (kMaxAnimals + 1) * animal, bytes_[24]);
  set(6, static_cast<int>(kMaxAnimals + 1));
  expectRefusal();
}

TEST_F(HerdRefusalTest, AnUnknownKind) {
  set(24, static_cast<int>(kKinds));
  expectRefusal();
}

TEST_F(HerdRefusalTest, NoSize) {
  set(25, 0);
  expectRefusal();
}

TEST_F(HerdRefusalTest, NoTime) {
  const double time = std::numeric_limits<double>::quiet_NaN();
  std::memcpy(bytes_.data() + 16, &time, sizeof time);
  expectRefusal();
}

}  // namespace
}  // namespace grove::objects::herd
