#pragma once

#include "node/frontend/frontend_half.h"
#include "objects/lightfield/common/field_info.h"

namespace grove::objects::lightfield {

/// One frame's view of one light field. Keeps references to its arguments.
struct Sight {
  const node::VisibleObject& object;
  const node::View& view;
  const node::SharedOf& shared;
  const FieldInfo::Parts& field;
  world::Mat4 toObject;
  ObjectCamera camera;

  [[nodiscard]] world::ObjectId id() const { return object.object.id; }
  [[nodiscard]] float focal() const { return view.camera.focal(); }
  /// The viewer's direction of movement in object coordinates; zero while standing.
  [[nodiscard]] world::Vec3 heading() const;
};

[[nodiscard]] Sight sightOf(const node::VisibleObject& object, const node::View& view, const node::SharedOf& shared,
                            const FieldInfo& field);

/// Whether the reply means that the budget is spent.
[[nodiscard]] bool isNotNow(const node::Payload& payload);

}  // namespace grove::objects::lightfield
