#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "objects/figure/backend/shadow/shade_kernels.h"

namespace grove::objects::figure {

/// Columns of a row, from `begin` to before `end`.
struct Columns {
  int begin = 0;
  int end = 0;

  [[nodiscard]] bool empty() const noexcept { return begin >= end; }
  /// The columns whose middles lie between two places.
  [[nodiscard]] static Columns between(float from, float to, const Columns& within) noexcept {
    const auto first = [&](float place) {
      const auto low = static_cast<float>(within.begin);
      return static_cast<int>(std::ceil(std::clamp(place - 0.5F, low, static_cast<float>(within.end))));
    };
    return {first(from), first(to)};
  }
};

/// How much darker a row of pixels gets.
class RowShade {
 public:
  explicit RowShade(const Columns& columns)
      : columns_(columns),
        sun_(static_cast<std::size_t>(std::max(0, columns.end - columns.begin)) + kShadePadding),
        sky_(sun_.size()) {}

  /// Those of the picture.
  [[nodiscard]] const Columns& columns() const noexcept { return columns_; }
  /// Those which may be darker.
  [[nodiscard]] const Columns& used() const noexcept { return used_; }

  /// What the columns lack of the light of the sun and of the whole sky, 0..1, from one column on.
  [[nodiscard]] float* sun(int column) noexcept { return sun_.data() + (column - columns_.begin); }
  [[nodiscard]] float* sky(int column) noexcept { return sky_.data() + (column - columns_.begin); }

  /// Before changing them.
  void use(const Columns& columns) noexcept {
    used_ = used_.empty() ? columns : Columns{std::min(used_.begin, columns.begin), std::max(used_.end, columns.end)};
  }

  void clear() noexcept {
    if (used_.empty()) return;
    std::fill(sun(used_.begin), sun(used_.end), 0.0F);
    std::fill(sky(used_.begin), sky(used_.end), 0.0F);
    used_ = {};
  }

 private:
  Columns columns_;
  Columns used_;
  std::vector<float> sun_;
  std::vector<float> sky_;
};

}  // namespace grove::objects::figure
