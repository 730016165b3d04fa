#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>

#include "node/messages/request.h"
#include "node/messages/result.h"

namespace grove::node {

/// The pictures that the sessions of a frontend process wait for, so that a backend node can send no others, and none
/// that are larger. Of each session those of the newest frames. Any thread.
class AskedPictures {
 public:
  /// Frames whose pictures are still of use.
  static constexpr std::size_t kFrames = 16;

  /// A session asks from now on.
  void begin(SessionId session);
  void end(SessionId session);

  /// The request has a view. One of a session that has ended is left out.
  void add(const Request& request);

  /// The rectangle that was asked for, once; nothing if nobody waits for this answer.
  [[nodiscard]] std::optional<world::Rect> take(const Result& answer);

 private:
  using Slots = std::map<std::uint32_t, world::Rect>;
  std::mutex mutex_;
  std::map<SessionId, std::map<FrameNumber, Slots>> sessions_;
};

}  // namespace grove::node
