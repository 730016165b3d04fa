#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace grove::stream {

/// The progress of a preparation, for display: of several parallel steps, shows one until it is done, or has sent no
/// update for a second. Not thread-safe; times are seconds of pipeline::wallSeconds().
class StepProgress {
 public:
  /// Returns false if another step is shown.
  bool update(std::string_view step, float share, double now);
  void clear() noexcept;

  [[nodiscard]] const std::string& step() const noexcept { return step_; }
  [[nodiscard]] std::uint8_t percent() const noexcept { return percent_; }

 private:
  std::string step_;
  std::uint8_t percent_ = 0;
  double heard_ = 0.0;
};

}  // namespace grove::stream
