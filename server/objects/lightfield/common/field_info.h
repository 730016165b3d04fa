#pragma once

#include <memory>
#include <span>

#include "node/messages/shared_data.h"
#include "objects/lightfield/format/view_camera.h"

namespace grove::objects::lightfield {

inline constexpr const char* kTypeName = "lightfield";

/// What a frontend half knows of a light field, under the empty key: enough to know which pictures of it to show.
class FieldInfo final : public node::SharedData {
 public:
  struct Parts {
    ViewGeometry geometry;
    int viewSize = 0;       ///< texels an edge of one of its views
    int number = 0;         ///< counts the light fields that the object has shown; a later one is finer
    float maxError = 0.0F;  ///< pixels of parallax that reprojection may have to mend; 0: every picture is made anew
  };
  FieldInfo(const Parts& parts, node::Version version) : SharedData(version), parts_(parts) {}
  /// The inverse of pack(). Throws node::PackingError.
  [[nodiscard]] static std::shared_ptr<FieldInfo> unpack(std::span<const std::byte> bytes, node::Version version);

  [[nodiscard]] const Parts& parts() const noexcept { return parts_; }

 private:
  [[nodiscard]] std::size_t ownBytes() const noexcept override { return sizeof *this; }
  [[nodiscard]] node::PackedBytes pack() const override;

  const Parts parts_;
};

}  // namespace grove::objects::lightfield
