#include "cli/bench/view/walk_faults.h"

#include <gtest/gtest.h>

namespace grove::cli {
namespace {

/// Fails if moved pictures show nothing, black or what lies behind where they are not covered, or are not moved right.
/// Rough light fields have up to 0.3, 5 and 4 faults. Where rays that meet nothing show nothing there are 220 to 300
/// foreign pixels on three walks; where pictures are not moved, 16 to 165 of about 700 blocks jump.
TEST(WalkFaults, AreFew) {
  expectFewFaults(LightFields::kRough, {}, {.darkGaps = 2.0, .foreignPixels = 150.0, .blockJumps = 12.0});
}

}  // namespace
}  // namespace grove::cli
