#include "stream/session/stroll.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace grove::stream {
namespace {

constexpr double kSecondsPerStep = 1.5;
constexpr std::array<std::uint8_t, 6> kSteps = {
    world::kForward, world::kForward | world::kLeft, 0, world::kBack, world::kForward | world::kRight | world::kRun,
    world::kRight,
};

}  // namespace

world::Input stroll(int index, float yaw, double seconds) {
  const double phase = seconds + 0.7 * index;
  world::Input input;
  input.keys = kSteps[static_cast<std::size_t>(phase / kSecondsPerStep) % kSteps.size()];
  input.yaw = yaw + static_cast<float>(0.8 * std::sin(0.5 * phase));
  input.pitch = static_cast<float>(0.15 * std::sin(0.9 * phase));
  return input;
}

void InputLatency::shown(std::uint32_t lastInput, double now, std::vector<float>& milliseconds) {
  while (!unseen_.empty() && unseen_.front().input <= lastInput) {
    milliseconds.push_back(static_cast<float>((now - unseen_.front().time) * 1e3));
    unseen_.pop_front();
  }
}

}  // namespace grove::stream
