#include <gtest/gtest.h>

#include "cli/bench/view/walk_faults.h"

namespace grove::cli {
namespace {

/// Fails if a visitor sees a near-black pixel that drawing everything does not show. Of foreign pixels and jumping
/// blocks there are up to 2 and 0.1.
TEST(FineWalkFaults, HaveNoDarkGaps) {
  expectFewFaults(LightFields::kFine, {.count = 60, .step = 4},
                  {.darkGaps = 0.0, .foreignPixels = 20.0, .blockJumps = 10.0});
}

}  // namespace
}  // namespace grove::cli
