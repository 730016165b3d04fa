#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "node/frontend/result_table.h"

namespace grove::node {

/// What a visitor's newest frame was made of, to stand in for results that do not come in time. Used by one thread at a
/// time.
class LastResults {
 public:
  void keep(CompleteFrame frame) { newest_ = std::move(frame); }

  /// Gives each slot without a result the last one of its object, or a Failure if there is none that fits. Returns the
  /// slots that it looked after.
  std::vector<std::size_t> fillIn(CompleteFrame& frame) const;

 private:
  [[nodiscard]] const Payload* of(const VisibleObject& object, const View& view) const;

  CompleteFrame newest_;
};

}  // namespace grove::node
