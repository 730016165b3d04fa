#pragma once

#include <algorithm>
#include <optional>

namespace grove::stream {

/// The minimum of the last five to ten seconds, in constant memory. Not thread-safe.
class WindowMin {
 public:
  void add(double now, double value) {
    if (!current_ || now - began_ > kHalf) {
      previous_ = current_;
      current_ = value;
      began_ = now;
    }
    current_ = std::min(*current_, value);
  }

  /// Empty before the first value.
  [[nodiscard]] std::optional<double> value() const {
    return previous_ && current_ ? std::min(*previous_, *current_) : current_;
  }

 private:
  static constexpr double kHalf = 5.0;
  std::optional<double> current_;
  std::optional<double> previous_;
  double began_ = 0.0;
};

}  // namespace grove::stream
