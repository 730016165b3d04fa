#pragma once

#include "node/frontend/frontend_half.h"

namespace grove::objects::sky {

/// Shows each visitor their part of the panorama, behind everything.
class SkyFrontendType final : public node::FrontendType {
 public:
  [[nodiscard]] std::string_view name() const override;
  [[nodiscard]] std::unique_ptr<node::FrontendHalf> makeHalf(const node::FrontendTools& tools) const override;
  [[nodiscard]] std::shared_ptr<node::SharedData> unpack(const node::Key& key, node::Version version,
                                                         std::span<const std::byte> bytes,
                                                         const node::SharedData* known) const override;
};

}  // namespace grove::objects::sky
