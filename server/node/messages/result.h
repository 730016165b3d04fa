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

/// A request that could not be answered; the frame is shown without the object.
struct Failure {
  std::string reason;
  bool notNow = false;  ///< nothing is wrong: there is no time for it at present
};

/// A picture for one visitor's camera (null if nothing shows; smaller than what was asked for where nothing shows
/// beside it), shared data, or a failure.
using Payload = std::variant<std::shared_ptr<const raster::Image>, std::shared_ptr<const SharedData>, Failure>;

/// What a backend node answers.
struct Result {
  SessionId session = 0;  ///< 0 and frame 0: shared data that no frame asked for
  FrameNumber frame = 0;
  std::uint32_t slot = 0;
  SharedKey what;  ///< the object; of shared data, its key
  bool shared = false;
  Version version = 0;  ///< of shared data
  bool pushed = false;  ///< it was subscribed to: no request of its own asks for it
  Payload payload;
  /// The payload as bytes, between the Compressor and the Decompressor where nodes share no memory; then `payload` is
  /// a null picture.
  std::shared_ptr<const PackedBytes> packed = nullptr;
};

/// The answer to a request.
[[nodiscard]] Result resultOf(const Request& request, Payload payload);

/// Shared data has changed: there is a newer version than frontends have.
struct Announcement {
  SharedKey what;
  Version version = 0;
};

inline pipeline::TraceTag traceTag(const Result& result) { return traceTag(result.session, result.frame); }

}  // namespace grove::node
