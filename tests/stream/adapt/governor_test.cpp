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
/// by a power of their width that is known here only. The first `moving` visitors have pages that move pictures.
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
  void setMoving(std::size_t count) { moving_ = count; }

  /// Returns how often pictures changed their size or rate.
  int run(double seconds) {
    int changes = 0;
    for (const double end = now_ + seconds; now_ < end; now_ += 0.03) {
      const Governor::Share before = governor_->share();
      const double moved = std::min(kFullRate, before.movedPerSecond);
      const auto moving = static_cast<double>(std::min(moving_, streams_.size()));
      const double wanted = moving * moved + (static_cast<double>(streams_.size()) - moving) * kFullRate;
      const double part = std::min(1.0, pictures_ / std::pow(before.scale, exponent_) / wanted);
      busy_ = std::min(1.0, wanted * std::pow(before.scale, exponent_) / pictures_);
      std::size_t index = 0;
      for (Governor::Stream& stream : streams_) {
        const bool moves = index++ < moving_;
        const double rate = moves ? moved : kFullRate;
        stream.update(Governor::Pace{rate, part * rate, 1.0 - part, moves}, now_);
      }
      changes += governor_->share() == before ? 0 : 1;
    }
    return changes;
  }

  [[nodiscard]] double scale() const { return governor_->share().scale; }
  [[nodiscard]] double movedPerSecond() const { return governor_->share().movedPerSecond; }
  const std::shared_ptr<Governor>& governor() { return governor_; }
  [[nodiscard]] double now() const { return now_; }

 private:
  double pictures_;
  const double exponent_;
  std::size_t moving_ = 0;
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

// Faults: pages that could move pictures lose lines first; pictures that come more seldom than the machine needs; that
// stay rare when there is room.
TEST(Governor, SendsFewerPicturesToPagesThatMoveThem) {
  struct Case {
    double pictures;
    double perSecond;
    double scale;
  };
  for (const auto& [pictures, perSecond, scale] :
       {Case{100.0, 20.0, 1.0}, Case{65.0, 15.0, 1.0}, Case{47.0, 15.0, 5.0 / 6.0}, Case{9.0, 15.0, 0.5}}) {
    Machine machine(pictures, 4);
    machine.setMoving(4);
    machine.run(4.8);
    EXPECT_EQ(machine.movedPerSecond(), perSecond) << pictures;
    EXPECT_EQ(machine.scale(), scale) << pictures;
    machine.setPictures(300.0);
    machine.run(60.0);
    EXPECT_EQ(machine.governor()->share(), Governor::Share()) << pictures;
  }
}

// Fault: a rate that falls although nobody's page moves pictures, while all wait for smaller ones.
TEST(Governor, ShrinksAtOnceWhenNobodyMovesPictures) {
  Machine machine(45.0, 4);
  EXPECT_EQ(machine.run(4.8), 3);
  EXPECT_EQ(machine.governor()->share(), (Governor::Share{.scale = 0.5}));
}

// Fault: one visitor whose page moves pictures pays for those whose pages do not.
TEST(Governor, ShrinksEverybodysPicturesWhenFewMove) {
  Machine machine(60.0, 4);
  machine.setMoving(1);
  machine.run(6.0);
  EXPECT_EQ(machine.scale(), 2.0 / 3.0);
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
