#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "node/messages.h"

namespace grove::node {

/// A frame with an answer for each of its requests, in the order of its list.
struct CompleteFrame {
  std::shared_ptr<const FrameList> list;
  std::vector<Payload> payloads;
  std::vector<bool> fulfilled;  ///< all, unless the deadline has passed
};

/// Requests x frames in flight (section 4.4): keeps results that come in any order until their frame is complete.
/// Bounded by the frames it may hold, the requests of each and the deadline of each. Used by one thread at a time.
class ResultTable {
 public:
  explicit ResultTable(std::size_t maxFrames) : maxFrames_(maxFrames) {}

  /// Makes a row for a frame; false if the table is full or has it already. A frame without requests is complete at
  /// once and may be taken.
  bool open(std::shared_ptr<const FrameList> list);

  /// Takes the payload and marks the request as fulfilled. False, and nothing changes, for an unknown frame or slot or
  /// a second answer.
  bool put(FrameNumber frame, std::uint32_t slot, Payload& payload);

  /// The frame, if it is there and complete; its row is free again.
  [[nodiscard]] std::optional<CompleteFrame> take(FrameNumber frame);

  /// The oldest frame, with what has come of it, if its deadline has passed; its row is free again, and further results
  /// for it are refused.
  [[nodiscard]] std::optional<CompleteFrame> takeOverdue(double now);

  [[nodiscard]] std::size_t frames() const noexcept { return rows_.size(); }

 private:
  struct Row {
    CompleteFrame frame;
    std::size_t missing = 0;
  };
  const std::size_t maxFrames_;
  std::map<FrameNumber, Row> rows_;
};

}  // namespace grove::node
