#pragma once

#include "sanitized.h"

namespace grove::cli {

/// Which light fields a visitor sees.
enum class LightFields {
  kRough,  ///< those in the cache folder, else rough ones
  kFine,   ///< as fine as the scene wants them; missing ones are baked
};

/// Which frames of a walk are compared.
struct Frames {
  int count = kSanitized ? 6 : 30;
  int step = 1;
};

/// What a walk shows that drawing everything does not show: means per frame.
struct Faults {
  double darkGaps = 0.0;
  double foreignPixels = 0.0;
  double blockJumps = 0.0;
};

/// Walks through the built-in world on each recorded walk, and compares the frames with drawn ones. A GoogleTest
/// assertion fails where there are more faults than `most`.
void expectFewFaults(LightFields fields, const Frames& frames, const Faults& most);

}  // namespace grove::cli
