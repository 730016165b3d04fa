#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cli/bench/picture_size.h"
#include "cli/bench/view/stand_cost.h"
#include "cli/bench/view/view_cost.h"
#include "cli/bench/view/view_memory.h"
#include "cli/bench/view/view_quality.h"

namespace grove::cli {

/// What `grove bench view` has measured, as far as it came.
struct ViewReport {
  std::string walk;
  PictureSize size;
  std::optional<ViewCost> paced;  ///< at thirty frames a second
  std::optional<ViewCost> inLoop;
  std::optional<ViewQuality> quality;
  std::optional<std::int64_t> bytes;  ///< that a frame touches
  std::optional<StandCost> standing;  ///< instead of all these
  bool interrupted = false;
};

/// One document; null is what was not measured.
[[nodiscard]] std::string viewJson(const ViewReport& report);
/// A table on stdout.
void printView(const ViewReport& report);

/// The same of visitors who stand.
[[nodiscard]] std::string standJson(const ViewReport& report);
void printStand(const ViewReport& report);

}  // namespace grove::cli
