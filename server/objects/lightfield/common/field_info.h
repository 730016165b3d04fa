#pragma once

#include <memory>
#include <span>

#include "node/messages/shared_data.h"
#include "objects/lightfield/format/view_camera.h"

namespace grove::objects::lightfield {

inline constexpr const char* kTypeName = "lightfield";

/// A frontend half's description of a light field, under the empty key: enough to choose pictures.
class FieldInfo final : public node::SharedData {
 public:
  struct Parts {
    ViewGeometry geometry;
    int viewSize = 0;       ///< texels per edge of a view
    int number = 0;         ///< version of the light field that the object shows; later ones are finer
    float maxError = 0.0F;  ///< pixels of parallax that reprojection may fill in; 0: makes every picture anew
    bool hasNear = false;   ///< whether pictures can be made from its triangles
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
