#pragma once

#include <array>

namespace grove::measure {

/// Number of quality steps of across-user work: 0 is what the scene wants; each further step costs more, once for all
/// visitors.
inline constexpr int kQualitySteps = 3;

/// Load of the machine.
struct QualityLoad {
  double visitors = 0.0;
  double cores = 1.0;            ///< of the machine
  double busyCores = 0.0;        ///< used by the process
  double acrossUserCores = 0.0;  ///< of them, used by clock-driven work
  double frameShare = 1.0;       ///< share of the wanted frames that visitors get
};

/// Spends on quality at most what sharing saves: at any step, a visitor's share of the across-user cost is at most what
/// a single visitor would pay for step 0. Steps up only after there has been room for a while, steps down at the first
/// signs of overload, and does not step up again at once. Not thread-safe.
class QualityPolicy {
 public:
  /// Takes a measurement at `now` (seconds) and returns the new step.
  int update(double now, const QualityLoad& load);

  [[nodiscard]] int step() const noexcept { return step_; }

  /// Costs of the steps relative to step 0: cells of grids with 64, 96 and 128 per edge.
  static constexpr std::array<double, kQualitySteps> kCosts{1.0, 3.375, 8.0};
  static constexpr double kRoomyShare = 0.75;    ///< of the cores: maximum after a step up
  static constexpr double kCrowdedShare = 0.92;  ///< of the cores: above it, steps down
  static constexpr double kMinFrameShare = 0.9;
  static constexpr double kPatience = 8.0;  ///< seconds of room before a step up
  static constexpr double kSettling = 3.0;  ///< seconds after a change in which measurements include the old step
  static constexpr double kRegret = 45.0;   ///< seconds after a step down before a step up

 private:
  [[nodiscard]] bool inTrouble(const QualityLoad& load) const;
  [[nodiscard]] bool hasRoom(const QualityLoad& load) const;
  void moveTo(int step, double now);

  int step_ = 0;
  double changed_ = -kSettling;
  double roomSince_ = -1.0;  ///< negative: no room
  double notBefore_ = 0.0;
};

}  // namespace grove::measure
