#pragma once

#include <memory>
#include <span>
#include <utility>

#include "node/messages/shared_data.h"
#include "objects/sky/common/panorama.h"

namespace grove::objects::sky {

inline constexpr const char* kTypeName = "sky";

/// The sky's data, shared by all visitors, under the empty key.
class SkyData final : public node::SharedData {
 public:
  explicit SkyData(SkyMaps maps) : maps_(std::move(maps)) {}
  /// The inverse of pack(). Throws node::PackingError.
  [[nodiscard]] static std::shared_ptr<SkyData> unpack(std::span<const std::byte> bytes);

  [[nodiscard]] const SkyMaps& maps() const noexcept { return maps_; }

 private:
  [[nodiscard]] std::size_t ownBytes() const noexcept override;
  [[nodiscard]] node::PackedBytes pack() const override;

  const SkyMaps maps_;
};

}  // namespace grove::objects::sky
