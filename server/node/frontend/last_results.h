#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "node/frontend/result_table.h"

namespace grove::node {

/// What a visitor's newest frame was made of, to stand in for results that do not come in time. Used by one thread at a
/// time.
class LastResults {
 public:
  void keep(CompleteFrame frame);

  /// Of a frame that was shown without it. True if it is the last one of its object now.
  bool keepStale(FrameNumber frame, std::uint32_t slot, Payload payload);

  /// Gives each slot without a result the last one of its object, or a Failure if there is none that fits. Returns the
  /// slots that it looked after.
  std::vector<std::size_t> fillIn(CompleteFrame& frame) const;

 private:
  /// Where the newest frame has this object, if it was of the same size.
  [[nodiscard]] std::optional<std::size_t> slotOf(const VisibleObject& object, const View& view) const;

  CompleteFrame newest_;
  /// Of frames that were shown without some of their results, oldest first.
  std::deque<std::shared_ptr<const FrameList>> incomplete_;
};

}  // namespace grove::node
