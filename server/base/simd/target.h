#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Kernels are the loops in which Grove spends its time: free functions over plain data, in files named
/// `*_kernels.cpp`, each compiled for every *target* (SSE4, AVX2, AVX3; NEON) by Google Highway. All other code is
/// compiled for the least processor that Grove supports, so that one binary serves all. The target is chosen once.
namespace grove::simd {

/// One of Highway's bits, for example HWY_AVX2.
using Target = std::int64_t;

/// The targets for which kernels are compiled and that this processor supports, best first; never empty.
[[nodiscard]] const std::vector<Target>& availableTargets();

/// The target in use.
[[nodiscard]] Target currentTarget();

/// A target's name, as in "avx2", and the inverse.
[[nodiscard]] std::string nameOf(Target target);
[[nodiscard]] std::optional<Target> availableTarget(std::string_view name);

/// Runs kernels as `target` from now on, which must be available. No kernel may be running.
void use(Target target);

/// Uses the best target, or the one in the environment variable GROVE_SIMD. Call it before the first kernel. Throws
/// EnvironmentError if this processor has no such target.
void chooseTarget();

}  // namespace grove::simd
