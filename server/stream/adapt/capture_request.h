#pragma once

#include <cstdint>
#include <optional>
#include <utility>

namespace grove::stream {

/// A visitor's requested screenshot, from the request until its frame is drawn. Keeps the newest request, and starts at
/// most one capture a second. Not thread-safe; times are monotonic seconds.
class CaptureRequest {
 public:
  void ask(std::uint32_t number) { wanted_ = number; }

  /// Returns whether the frame that begins becomes the capture.
  [[nodiscard]] bool begin(std::uint32_t frame, double now) {
    if (!wanted_ || now - began_ < kMinSecondsBetween) return false;
    made_ = {frame, *std::exchange(wanted_, std::nullopt)};
    began_ = now;
    return true;
  }

  /// Returns the capture's number if this drawn frame is the capture; once.
  [[nodiscard]] std::optional<std::uint32_t> take(std::uint32_t frame) {
    if (!made_ || made_->first != frame) return std::nullopt;
    return std::exchange(made_, std::nullopt)->second;
  }

 private:
  static constexpr double kMinSecondsBetween = 1.0;
  std::optional<std::uint32_t> wanted_;
  std::optional<std::pair<std::uint32_t, std::uint32_t>> made_;  ///< frame and number
  double began_ = -kMinSecondsBetween;
};

}  // namespace grove::stream
