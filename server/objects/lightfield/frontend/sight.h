#pragma once

#include "node/frontend/frontend_half.h"
#include "objects/lightfield/common/field_info.h"

namespace grove::objects::lightfield {

/// What one frame sees of one light field. Refers to what it is made of.
struct Sight {
  const node::VisibleObject& object;
  const node::View& view;
  const node::SharedOf& shared;
  const FieldInfo::Parts& field;
  world::Mat4 toObject;
  ObjectCamera camera;

  [[nodiscard]] world::ObjectId id() const { return object.object.id; }
  [[nodiscard]] float focal() const { return view.camera.focal(); }
  /// Which way the viewer goes, in the object's coordinates; zero if he stands.
  [[nodiscard]] world::Vec3 heading() const;
};

[[nodiscard]] Sight sightOf(const node::VisibleObject& object, const node::View& view, const node::SharedOf& shared,
                            const FieldInfo& field);

/// Whether the answer is that there is no time.
[[nodiscard]] bool isNotNow(const node::Payload& payload);

}  // namespace grove::objects::lightfield
