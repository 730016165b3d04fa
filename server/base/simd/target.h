#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Kernels are the loops in which Grove spends its time: free functions over plain data, in files named
/// `*_kernels.cpp`, each compiled for every *target* (SSE4, AVX2, AVX3; NEON) by means of Google Highway. All else is
/// compiled for the least processor that Grove runs on, so that one binary serves all. The target is chosen once.
namespace grove::simd {

/// One of Highway's bits, for example HWY_AVX2.
using Target = std::int64_t;

/// The targets that kernels are compiled for and that this processor has, best first; never empty.
[[nodiscard]] const std::vector<Target>& availableTargets();

/// The target that kernels run as.
[[nodiscard]] Target currentTarget();

/// "avx2", for example; and back.
[[nodiscard]] std::string nameOf(Target target);
[[nodiscard]] std::optional<Target> availableTarget(std::string_view name);

/// From now on kernels run as `target`, which is one of those available. No kernel may be running.
void use(Target target);

/// Uses the best target there is, or the one that the environment variable GROVE_SIMD names. To be called ahead of the
/// first kernel. Throws EnvironmentError if this processor has no such target.
void chooseTarget();

}  // namespace grove::simd
