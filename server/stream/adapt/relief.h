#pragma once

#include <cstddef>
#include <span>

namespace grove::stream {

/// Decides what a browser that cannot keep up with a stream is spared: frames or pixels, as many steps at once as are
/// needed, and less again, a step at a time, when it has time for a while. One thread at a
/// time; times are seconds that do not go back.
class Relief {
 public:
  struct Share {
    double rate = 1.0;   ///< of the wanted frames a second
    double scale = 1.0;  ///< of width and height
    friend bool operator==(const Share&, const Share&) = default;
  };

  /// `steps`: the first is no relief, each further one is more; they outlive this. Who sends fewer than `tooFew` of the
  /// frames that are due is strained: to spare more would gain nothing else.
  Relief(std::span<const Share> steps, double tooFew) : steps_(steps), tooFew_(tooFew) {}

  /// `blocked`: share of the time in which a due frame was kept back. `achieved`: frames that began a second, of
  /// `wanted` without relief. To be asked a few times a second at least.
  const Share& update(double now, double blocked, double achieved, double wanted);
  [[nodiscard]] const Share& share() const noexcept { return steps_[step_]; }
  [[nodiscard]] bool isGiven() const noexcept { return step_ > 0; }

 private:
  /// Whether enough frames are to be expected at a step: those that are achieved now, by the pixels of each.
  [[nodiscard]] bool suffices(std::size_t step, double achieved, double wanted) const;

  const std::span<const Share> steps_;
  const double tooFew_;
  std::size_t step_ = 0;
  double strainedSince_ = -1.0;  ///< negative: it is not
  double changed_ = 0.0;
  double patience_ = 10.0;  ///< until the next try with less relief
};

}  // namespace grove::stream
