#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cli/bench/picture_size.h"
#include "cli/bench/view/exact_quality.h"
#include "cli/bench/view/stand_cost.h"
#include "cli/bench/view/view_cost.h"
#include "cli/bench/view/view_memory.h"
#include "cli/bench/view/view_quality.h"

namespace grove::cli {

/// Measurements of `grove bench view`; those that were not reached are empty.
struct ViewReport {
  std::string walk;
  PictureSize size;
  std::optional<ViewCost> paced;  ///< at 30 frames per second
  std::optional<ViewCost> inLoop;
  std::optional<ViewCost> whole;  ///< at 30 frames per second, with everything drawn in every frame
  std::optional<ViewQuality> quality;
  std::optional<std::int64_t> bytes;  ///< touched by a frame
  std::optional<StandCost> standing;  ///< of standing visitors, instead of all above
  Shed shed;
  std::optional<ExactQuality> exact;  ///< of a busy server's pictures, instead of all above
  bool interrupted = false;
};

/// Returns one JSON document; missing measurements are null.
[[nodiscard]] std::string viewJson(const ViewReport& report);
/// Prints a table to stdout.
void printView(const ViewReport& report);

/// The same for standing visitors.
[[nodiscard]] std::string standJson(const ViewReport& report);
void printStand(const ViewReport& report);

/// The same for the differences from exact pictures.
[[nodiscard]] std::string exactJson(const ViewReport& report);
void printExact(const ViewReport& report);

}  // namespace grove::cli
