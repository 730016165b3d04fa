#include "base/simd/target.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "base/simd/target.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace grove::simd::HWY_NAMESPACE {

Target compiledTarget() { return HWY_TARGET; }

}  // namespace grove::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

#include <cctype>
#include <cstdlib>

#include "base/error.h"

namespace grove::simd {

HWY_EXPORT(compiledTarget);

namespace {

std::vector<Target> detect() {
  // The least target is the one for which all of Grove is compiled, even where Highway requires more for it than our
  // kernels do.
  Target left = (hwy::SupportedTargets() | HWY_STATIC_TARGET) & HWY_TARGETS;
  std::vector<Target> targets;
  for (; left != 0; left &= left - 1) targets.push_back(left & -left);
  return targets;
}

}  // namespace

const std::vector<Target>& availableTargets() {
  // Once, because Highway's detection of the processor also undoes the choice.
  static const std::vector<Target> targets = detect();
  return targets;
}

Target currentTarget() { return HWY_DYNAMIC_DISPATCH(compiledTarget)(); }

std::string nameOf(Target target) {
  std::string name = hwy::TargetName(target);
  for (char& letter : name) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return name;
}

std::optional<Target> availableTarget(std::string_view name) {
  for (const Target target : availableTargets()) {
    if (nameOf(target) == name) return target;
  }
  return std::nullopt;
}

void use(Target target) { hwy::GetChosenTarget().Update(target); }

void chooseTarget() {
  const char* const wanted = std::getenv("GROVE_SIMD");
  if (wanted == nullptr) return use(availableTargets().front());
  if (const std::optional<Target> target = availableTarget(wanted)) return use(*target);
  std::string names;
  for (const Target target : availableTargets()) names += (names.empty() ? "" : ", ") + nameOf(target);
  throw EnvironmentError("no such SIMD target on this processor: \"" + std::string(wanted) + "\"",
                         "environment variable GROVE_SIMD", "there are: " + names);
}

}  // namespace grove::simd

#endif  // HWY_ONCE
