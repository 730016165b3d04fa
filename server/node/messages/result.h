#pragma once

#include <memory>
#include <string>
#include <variant>

#include "node/messages/request.h"
#include "node/messages/shared_data.h"
#include "node/messages/shared_key.h"
#include "pipeline/timeline.h"
#include "raster/image.h"

namespace grove::node {

/// A request that failed; the frame is shown without the object.
struct Failure {
  std::string reason;
  bool notNow = false;  ///< temporary, for lack of time or room: not an error
};

/// A picture for one visitor's camera (null if nothing is visible; smaller than requested if the rest is empty), shared
/// data, or a failure.
using Payload = std::variant<std::shared_ptr<const raster::Image>, std::shared_ptr<const SharedData>, Failure>;

/// A backend node's response to a request.
struct Result {
  SessionId session = 0;  ///< 0, with frame 0: shared data that no frame requested
  FrameNumber frame = 0;
  std::uint32_t slot = 0;
  SharedKey what;  ///< the object; for shared data, its key
  bool shared = false;
  Version version = 0;  ///< of shared data
  bool pushed = false;  ///< by a subscription, without a request
  Payload payload;
  /// The payload as bytes, between the Compressor and the Decompressor if nodes share no memory; then `payload` is a
  /// null picture.
  std::shared_ptr<const PackedBytes> packed = nullptr;
};

/// Makes the result of a request.
[[nodiscard]] Result resultOf(const Request& request, Payload payload);

/// Shared data has changed: there is a newer version.
struct Announcement {
  SharedKey what;
  Version version = 0;
};

inline pipeline::TraceTag traceTag(const Result& result) { return traceTag(result.session, result.frame); }

}  // namespace grove::node
