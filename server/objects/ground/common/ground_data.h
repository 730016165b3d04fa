#pragma once

#include <memory>
#include <span>
#include <utility>

#include "node/messages/shared_data.h"
#include "objects/ground/common/ground_maps.h"

namespace grove::objects::ground {

inline constexpr const char* kTypeName = "ground";

/// The ground's data, shared by all visitors, under the empty key.
class GroundData final : public node::SharedData {
 public:
  explicit GroundData(GroundMaps maps) : maps_(std::move(maps)) {}
  /// The inverse of pack(). Throws node::PackingError.
  [[nodiscard]] static std::shared_ptr<GroundData> unpack(std::span<const std::byte> bytes);

  [[nodiscard]] const GroundMaps& maps() const noexcept { return maps_; }

 private:
  [[nodiscard]] std::size_t ownBytes() const noexcept override;
  [[nodiscard]] node::PackedBytes pack() const override;

  const GroundMaps maps_;
};

}  // namespace grove::objects::ground
