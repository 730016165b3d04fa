#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace grove::stream {

/// How a preparation gets on, for people: of several steps at once, one is reported until it is done, or nothing was
/// heard of it for a second. One thread at a time; times are seconds of pipeline::wallSeconds().
class StepProgress {
 public:
  /// False if another step is being reported.
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
