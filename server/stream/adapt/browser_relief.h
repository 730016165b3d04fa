#pragma once

#include <cstddef>

namespace grove::stream {

/// Decides what a browser that cannot keep up is spared: a third of the frames first, then pixels. One thread at a
/// time; times are seconds that do not go back.
class BrowserRelief {
 public:
  struct Share {
    double rate = 1.0;   ///< of the wanted frames a second
    double scale = 1.0;  ///< of width and height
    friend bool operator==(const Share&, const Share&) = default;
  };

  /// `blocked`: share of the time in which the browser kept a due frame back. `achieved`: frames that began a second,
  /// of `wanted` without relief. To be asked a few times a second at least.
  const Share& update(double now, double blocked, double achieved, double wanted);
  [[nodiscard]] const Share& share() const noexcept;

 private:
  std::size_t step_ = 0;
  double strainedSince_ = -1.0;  ///< negative: it is not
  double changed_ = 0.0;
  double patience_ = 10.0;  ///< until the next try with less relief
};

}  // namespace grove::stream
