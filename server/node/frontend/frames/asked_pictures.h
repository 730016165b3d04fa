#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>

#include "node/messages/request.h"
#include "node/messages/result.h"

namespace grove::node {

/// The pictures that the sessions of a frontend process have requested, for the newest frames of each session. A
/// backend node can send no others, and no larger ones. Thread-safe.
class AskedPictures {
 public:
  /// Number of newest frames whose pictures are still useful.
  static constexpr std::size_t kFrames = 16;

  /// A session begins to send requests.
  void begin(SessionId session);
  void end(SessionId session);

  /// Adds a request, which has a view. Ignores requests of ended sessions.
  void add(const Request& request);

  /// Returns the requested rectangle, once; empty if no session waits for this result.
  [[nodiscard]] std::optional<world::Rect> take(const Result& answer);

 private:
  using Slots = std::map<std::uint32_t, world::Rect>;
  std::mutex mutex_;
  std::map<SessionId, std::map<FrameNumber, Slots>> sessions_;
};

}  // namespace grove::node
