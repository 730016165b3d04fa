#include "pipeline/busy_share.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace grove::pipeline {

void BusyShare::begin(double now) {
  assert(running_ < workers_);
  mean_ = at(now);
  since_ = now;
  ++running_;
}

void BusyShare::end(double now) {
  assert(running_ > 0);
  mean_ = at(now);
  since_ = now;
  --running_;
}

double BusyShare::at(double now) const {
  const double passed = std::max(now - since_, 0.0);
  return runningShare() + (mean_ - runningShare()) * std::exp(-passed / kSeconds);
}

}  // namespace grove::pipeline
