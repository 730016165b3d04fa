#include "stream/adapt/governor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <list>
#include <memory>
#include <optional>

namespace grove::stream {
namespace {

constexpr double kFullRate = 30.0;

/// A machine that makes so many whole pictures a second, for visitors who all want as many. Smaller pictures cost less,
/// by a power of their width that is known here only.
class Machine {
 public:
  Machine(double pictures, std::size_t visitors, double exponent = 1.5) : pictures_(pictures), exponent_(exponent) {
    setVisitors(visitors);
  }

  void setVisitors(std::size_t count) {
    while (streams_.size() < count) streams_.emplace_back(governor_);
    while (streams_.size() > count) streams_.pop_back();
  }
  void setPictures(double pictures) { pictures_ = pictures; }

  /// Returns how often pictures changed their size.
  int run(double seconds) {
    int changes = 0;
    for (const double end = now_ + seconds; now_ < end; now_ += 0.03) {
      const double before = governor_->scale();
      const double can = pictures_ / std::pow(before, exponent_) / static_cast<double>(streams_.size());
      const double achieved = std::min(kFullRate, can);
      busy_ = achieved / can;
      for (Governor::Stream& stream : streams_) {
        stream.update(Governor::Pace{kFullRate, achieved, 1.0 - achieved / kFullRate}, now_);
      }
      changes += governor_->scale() == before ? 0 : 1;
    }
    return changes;
  }

  [[nodiscard]] double scale() const { return governor_->scale(); }
  const std::shared_ptr<Governor>& governor() { return governor_; }
  [[nodiscard]] double now() const { return now_; }

 private:
  double pictures_;
  const double exponent_;
  double busy_ = 0.0;
  const std::shared_ptr<Governor> governor_ = std::make_shared<Governor>([this] { return busy_; });
  std::list<Governor::Stream> streams_;
  double now_ = 100.0;
};

// Fault: smaller pictures on a machine that holds the rate, or nearly.
TEST(Governor, KeepsFullSizeWhileTheRateHolds) {
  for (const double pictures : {500.0, 130.0, 114.0}) {
    Machine machine(pictures, 4);
    EXPECT_EQ(machine.run(60.0), 0) << pictures;
    EXPECT_EQ(machine.scale(), 1.0) << pictures;
  }
}

// Faults: frames that are lost before pixels; more pixels lost than needed.
TEST(Governor, ShrinksPicturesAsFarAsNeeded) {
  struct Case {
    double pictures;
    double scale;
  };
  for (const auto& [pictures, scale] :
       {Case{100.0, 5.0 / 6.0}, Case{70.0, 2.0 / 3.0}, Case{45.0, 0.5}, Case{9.0, 0.5}}) {
    Machine machine(pictures, 4);
    EXPECT_EQ(machine.run(0.2), 0) << "newcomers cost more for a moment";
    machine.run(4.8);
    EXPECT_EQ(machine.scale(), scale) << pictures;
  }
}

// Fault: a machine whose pictures cost almost the same at any size, or go by their pixels, and sizes that never settle.
TEST(Governor, SettlesForAnyCost) {
  for (const double exponent : {0.7, 1.0, 2.0}) {
    for (const double pictures : {110.0, 90.0, 60.0, 40.0}) {
      Machine machine(pictures, 4, exponent);
      machine.run(30.0);
      EXPECT_LE(machine.run(600.0), 14) << exponent << ' ' << pictures;
    }
  }
}

// Faults: pictures that stay small when others have left; that grow where it fails.
TEST(Governor, GrowsPicturesWithSpareTime) {
  Machine machine(45.0, 4);
  machine.run(5.0);
  ASSERT_EQ(machine.scale(), 0.5);
  machine.setVisitors(2);
  machine.run(20.0);
  EXPECT_EQ(machine.scale(), 5.0 / 6.0) << "two get 30 frames a second of that size, and 22 whole ones";
  machine.setVisitors(1);
  machine.run(40.0);
  EXPECT_EQ(machine.scale(), 1.0);
}

// Fault: small pictures for a visitor who comes after all others have left.
TEST(Governor, ResetsWhenEverybodyHasLeft) {
  Machine machine(45.0, 4);
  machine.run(5.0);
  ASSERT_EQ(machine.scale(), 0.5);
  machine.setVisitors(0);
  EXPECT_EQ(machine.scale(), 1.0);
}

// Fault: a size that is tried again and again though it failed each time.
TEST(Governor, BacksOffAfterFailedSizes) {
  Machine machine(45.0, 4);
  machine.run(5.0);
  int tries = 0;
  for (int i = 0; i < 600; ++i) {
    // Room at half the size, and none at any other.
    machine.setPictures(machine.scale() > 0.5 ? 45.0 : 120.0);
    tries += machine.run(1.0);
  }
  EXPECT_GE(tries, 6);
  EXPECT_LE(tries, 18);
}

// Faults: a slow line or browser, or a page that nobody sees, for which the machine is taken to be slow; the pace of a
// visitor who has left, which counts for ever.
TEST(Governor, CountsOnlyMachineLimitedStreams) {
  Machine machine(500.0, 2);
  const Governor::Pace slow{kFullRate, 5.0, 0.9};
  {
    Governor::Stream gone(machine.governor());
    gone.update(slow, machine.now());
  }
  Governor::Stream hidden(machine.governor());
  hidden.update(slow, machine.now());
  hidden.rest();
  Governor::Stream elsewhere(machine.governor());
  elsewhere.update(slow, machine.now());
  elsewhere.update(std::nullopt, machine.now());
  Governor::Stream punctual(machine.governor());
  punctual.update(Governor::Pace{kFullRate, 12.0, 0.0}, machine.now());
  EXPECT_EQ(machine.run(30.0), 0);
}

}  // namespace
}  // namespace grove::stream
