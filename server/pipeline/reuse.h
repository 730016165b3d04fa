#pragma once

#include <cstdint>

namespace grove::pipeline {

/// Shared data that visitors' views caused (Work::kOnDemand), and its uses: each is by one frame
/// of one session.
struct Reuse {
  std::uint64_t made = 0;    ///< pieces of data
  std::uint64_t used = 0;    ///< of them, by anybody
  std::uint64_t shared = 0;  ///< of these, by at least two sessions; counted at the second session's first use
  std::uint64_t madeBytes = 0;
  std::uint64_t sharedBytes = 0;
  std::uint64_t usesAgain = 0;     ///< by the session that used it first, without that use
  std::uint64_t usesByOthers = 0;  ///< by all other sessions

  Reuse& operator+=(const Reuse& more) noexcept;
  friend bool operator==(const Reuse&, const Reuse&) = default;

  [[nodiscard]] std::uint64_t uses() const noexcept { return used + usesAgain + usesByOthers; }
  [[nodiscard]] std::uint64_t usedByOne() const noexcept { return used > shared ? used - shared : 0; }
  /// The part, by bytes, that at least two sessions used, from 0 to 1. In a short while, more may become shared than is
  /// made; that counts as 1.
  [[nodiscard]] double sharedPart() const noexcept;
};

/// From totals that only grow.
[[nodiscard]] Reuse operator-(const Reuse& now, const Reuse& before) noexcept;

}  // namespace grove::pipeline
