#include "objects/fluid/common/snapshot_steps.h"

#include <algorithm>

namespace grove::objects::fluid {
namespace {

struct Scale {
  std::vector<float> FluidSnapshot::*values;
  float steps;  ///< per unit of the values
  float low;    ///< in steps
  float high;
};

constexpr float kFar = 1 << 24;

constexpr std::array<Scale, SnapshotSteps::kFields> kScales{{
    {&FluidSnapshot::velocityX, 4.0F, -32767.0F, 32767.0F},
    {&FluidSnapshot::velocityY, 4.0F, -32767.0F, 32767.0F},
    {&FluidSnapshot::velocityZ, 4.0F, -32767.0F, 32767.0F},
    {&FluidSnapshot::x, 128.0F, -kFar, kFar},
    {&FluidSnapshot::y, 128.0F, -kFar, kFar},
    {&FluidSnapshot::z, 128.0F, -kFar, kFar},
    {&FluidSnapshot::age, 1920.0F, 0.0F, 65535.0F},
    {&FluidSnapshot::lifetime, FluidSnapshot::kLifetimeSteps, 0.0F, 65535.0F},
    {&FluidSnapshot::temperature, 63.0F, 0.0F, 63.0F},
    {&FluidSnapshot::skyLight, 63.0F, 0.0F, 63.0F},
    {&FluidSnapshot::sunLight, 63.0F, 0.0F, 63.0F},
}};

inline std::int32_t rounded(float steps, float low, float high) {
  const float bounded = std::min(high, std::max(low, steps));
  return static_cast<std::int32_t>(bounded + (bounded < 0.0F ? -0.5F : 0.5F));
}

}  // namespace

SnapshotSteps stepsOf(const FluidSnapshot& snapshot) {
  SnapshotSteps steps;
  steps.resize(snapshot.count());
  for (std::size_t field = 0; field < SnapshotSteps::kFields; ++field) {
    const Scale& scale = kScales[field];
    const float* const values = (snapshot.*scale.values).data();
    std::int32_t* const to = steps.fields[field].data();
    for (std::size_t i = 0; i < snapshot.count(); ++i) to[i] = rounded(values[i] * scale.steps, scale.low, scale.high);
  }
  return steps;
}

void restore(const SnapshotSteps& steps, FluidSnapshot& snapshot) {
  snapshot.resize(steps.count());
  for (std::size_t field = 0; field < SnapshotSteps::kFields; ++field) {
    const Scale& scale = kScales[field];
    const std::int32_t* const from = steps.fields[field].data();
    float* const values = (snapshot.*scale.values).data();
    for (std::size_t i = 0; i < steps.count(); ++i) values[i] = static_cast<float>(from[i]) / scale.steps;
  }
}

}  // namespace grove::objects::fluid
