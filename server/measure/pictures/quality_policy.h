#pragma once

#include <array>

namespace grove::measure {

/// How good across-user work is done: 0 is what the scene asks for, each step above costs more, once for all.
inline constexpr int kQualitySteps = 3;

/// What the machine and its visitors are at.
struct QualityLoad {
  double visitors = 0.0;
  double cores = 1.0;            ///< that the machine has
  double busyCores = 0.0;        ///< that the process uses
  double acrossUserCores = 0.0;  ///< of them, for work that a clock drives
  double frameShare = 1.0;       ///< frames that visitors get, of those that they should
};

/// Spends on quality what sharing saves, and never more: at any step a visitor's share of the across-user bill is at
/// most what he would pay alone for step 0. Goes up only after the room for it has been there for a while, goes down at
/// the first signs of trouble, and does not come back at once. One thread.
class QualityPolicy {
 public:
  /// Takes a measurement, at `now` in seconds, and returns the step to be at.
  int update(double now, const QualityLoad& load);

  [[nodiscard]] int step() const noexcept { return step_; }

  /// Costs of the steps, in step 0's: cells of grids with 64, 96 and 128 to an edge.
  static constexpr std::array<double, kQualitySteps> kCosts{1.0, 3.375, 8.0};
  static constexpr double kRoomyShare = 0.75;    ///< of the cores, to go up to
  static constexpr double kCrowdedShare = 0.92;  ///< of the cores, to go down from
  static constexpr double kMinFrameShare = 0.9;
  static constexpr double kPatience = 8.0;  ///< seconds of room before it goes up
  static constexpr double kSettling = 3.0;  ///< seconds after a change in which measurements show the old step, too
  static constexpr double kRegret = 45.0;   ///< seconds after a step down before it goes up

 private:
  [[nodiscard]] bool inTrouble(const QualityLoad& load) const;
  [[nodiscard]] bool hasRoom(const QualityLoad& load) const;
  void moveTo(int step, double now);

  int step_ = 0;
  double changed_ = -kSettling;
  double roomSince_ = -1.0;  ///< negative: there is none
  double notBefore_ = 0.0;
};

}  // namespace grove::measure
