#pragma once

#include "node/frontend/frontend_half.h"

namespace grove::objects::ground {

/// Grows the grass in each visitor's view.
class GroundFrontendType final : public node::FrontendType {
 public:
  [[nodiscard]] std::string_view name() const override;
  [[nodiscard]] std::unique_ptr<node::FrontendHalf> makeHalf(const node::FrontendTools& tools) const override;
  [[nodiscard]] std::shared_ptr<node::SharedData> unpack(const node::Key& key, node::Version version,
                                                         std::span<const std::byte> bytes,
                                                         const node::SharedData* known) const override;
};

}  // namespace grove::objects::ground
