#pragma once

#include <cstddef>
#include <span>

namespace grove::stream {

/// Decides how many frames or pixels fewer a browser gets that cannot keep up: at once as many steps fewer as needed,
/// and back one step at a time when it has had time for a while. Not thread-safe; times are monotonic seconds.
class Relief {
 public:
  struct Share {
    double rate = 1.0;   ///< of the wanted frames a second
    double scale = 1.0;  ///< of width and height
    friend bool operator==(const Share&, const Share&) = default;
  };

  /// `steps`: the first is no relief, each further one is more; they outlive this. Relief needs a reason: less than
  /// this share of the due frames, `tooFew`, begins.
  Relief(std::span<const Share> steps, double tooFew) : steps_(steps), tooFew_(tooFew) {}

  /// `blocked`: share of the time in which a due frame was delayed. `achieved`: frames that began a second, of `wanted`
  /// without relief. Call at least a few times a second.
  const Share& update(double now, double blocked, double achieved, double wanted);
  [[nodiscard]] const Share& share() const noexcept { return steps_[step_]; }
  [[nodiscard]] bool isActive() const noexcept { return step_ > 0; }

 private:
  /// Returns whether enough frames are to be expected at a step: those achieved now, scaled by the pixels of each.
  [[nodiscard]] bool suffices(std::size_t step, double achieved, double wanted) const;

  const std::span<const Share> steps_;
  const double tooFew_;
  std::size_t step_ = 0;
  double strainedSince_ = -1.0;  ///< negative: not strained
  double changed_ = 0.0;
  double patience_ = 10.0;  ///< seconds until the next try with less relief
};

}  // namespace grove::stream
