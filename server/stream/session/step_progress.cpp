#include "stream/session/step_progress.h"

#include <algorithm>
#include <cmath>

namespace grove::stream {
namespace {

constexpr double kStepSeconds = 1.0;
constexpr int kDone = 99;

}  // namespace

bool StepProgress::update(std::string_view step, float share, double now) {
  const bool isOther = step != step_ && !step_.empty();
  if (isOther && percent_ < kDone && now - heard_ < kStepSeconds) return false;
  heard_ = now;
  step_ = step;
  percent_ = static_cast<std::uint8_t>(std::lround(100.0F * std::clamp(share, 0.0F, 1.0F)));
  return true;
}

void StepProgress::clear() noexcept {
  step_.clear();
  percent_ = 0;
}

}  // namespace grove::stream
