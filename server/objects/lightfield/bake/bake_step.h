#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "objects/lightfield/bake/bake.h"
#include "pipeline/clocks.h"

namespace grove::bake {

using ProgressCall = std::function<void(const BakeProgress&)>;

/// Reports the progress of one step and estimates the remaining time from the elapsed time.
class BakeStep {
 public:
  BakeStep(std::string_view name, const ProgressCall& progress)
      : name_(name), progress_(progress), begin_(pipeline::wallNanoseconds()) {
    progress_({name_, 0.0F, 0.0});
  }
  [[nodiscard]] double seconds() const { return static_cast<double>(pipeline::wallNanoseconds() - begin_) * 1.0e-9; }
  void show(float share) const {
    progress_({name_, share,
               share > 0.0F ? seconds() / static_cast<double>(share) * (1.0 - static_cast<double>(share)) : 0.0});
  }

 private:
  std::string_view name_;
  const ProgressCall& progress_;
  std::int64_t begin_;
};

}  // namespace grove::bake
