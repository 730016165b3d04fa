#pragma once

#include "node/backend/request_handler.h"

namespace grove::node {

/// Renders images of an object from the request's camera (section 4.2, step 4).
class Renderer final : public RequestHandler {
 public:
  Renderer(std::string_view subject, BackendHalf& half, pipeline::Timeline& timeline)
      : RequestHandler("Renderer", subject, half, timeline) {}
};

}  // namespace grove::node
