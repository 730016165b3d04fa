#include "pipeline/reuse.h"

#include <algorithm>

namespace grove::pipeline {

Reuse& Reuse::operator+=(const Reuse& more) noexcept {
  made += more.made;
  used += more.used;
  shared += more.shared;
  madeBytes += more.madeBytes;
  sharedBytes += more.sharedBytes;
  usesAgain += more.usesAgain;
  usesByOthers += more.usesByOthers;
  return *this;
}

double Reuse::sharedPart() const noexcept {
  if (madeBytes == 0) return 0.0;
  return std::min(1.0, static_cast<double>(sharedBytes) / static_cast<double>(madeBytes));
}

Reuse operator-(const Reuse& now, const Reuse& before) noexcept {
  return {.made = now.made - before.made,
          .used = now.used - before.used,
          .shared = now.shared - before.shared,
          .madeBytes = now.madeBytes - before.madeBytes,
          .sharedBytes = now.sharedBytes - before.sharedBytes,
          .usesAgain = now.usesAgain - before.usesAgain,
          .usesByOthers = now.usesByOthers - before.usesByOthers};
}

}  // namespace grove::pipeline
