#include "objects/herd/backend/motion/course.h"

#include <algorithm>
#include <cstddef>

namespace grove::objects::herd {
namespace {

constexpr int kSteps = 120;  // per second

}  // namespace

Course::Course(const Ramp& speed, const Ramp& turn, float begin, float end)
    : speed_(speed), turn_(turn), begin_(begin), end_(end) {
  const auto count = static_cast<int>(std::ceil((end - begin) * static_cast<float>(kSteps))) + 1;
  RootMove root;
  roots_.push_back(root);
  constexpr float kStep = 1.0F / static_cast<float>(kSteps);
  for (int i = 0; i < count; ++i) {
    const float middle = begin + (static_cast<float>(i) + 0.5F) * kStep;
    root.yaw += 0.5F * kStep * turn_.at(middle);
    root.place += kStep * speed_.at(middle) * root.heading();
    root.yaw += 0.5F * kStep * turn_.at(middle);
    roots_.push_back(root);
  }
  const RootMove origin = at(0.0F);
  for (RootMove& one : roots_) one = origin.to(one);
}

RootMove Course::at(float seconds) const noexcept {
  const float step =
      std::clamp((seconds - begin_) * static_cast<float>(kSteps), 0.0F, static_cast<float>(roots_.size() - 2));
  const auto i = std::min(static_cast<std::size_t>(step), roots_.size() - 2);
  const float share = step - static_cast<float>(i);
  const RootMove& a = roots_[i];
  const RootMove& b = roots_[i + 1];
  return {a.place + share * (b.place - a.place), a.yaw + share * (b.yaw - a.yaw)};
}

}  // namespace grove::objects::herd
