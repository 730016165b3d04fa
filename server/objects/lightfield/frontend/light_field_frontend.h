#pragma once

#include "node/object_type.h"

namespace grove::objects::lightfield {

/// Turns shared pictures into one visitor's view: moves them by their depth to where this eye sees them.
class LightFieldFrontend final : public node::FrontendHalf {
 public:
  void lay(const node::VisibleObject& object, const node::Payload& payload, const node::View& view,
           node::FrameBuilder& frame) override;
};

}  // namespace grove::objects::lightfield
