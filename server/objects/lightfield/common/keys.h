#pragma once

#include "node/messages/shared_key.h"
#include "objects/lightfield/common/view_cell.h"

/// The keys of a light field's data.
namespace grove::objects::lightfield {

/// Key of a cell's shared picture.
[[nodiscard]] node::Key keyOf(const CellId& id);
/// Throws node::PackingError.
[[nodiscard]] CellId cellIdOf(const node::Key& key);

/// Key of a visitor's own picture from a camera other than the frame's.
struct OwnPicture {
  ObjectCamera camera;
  bool mustBeMade = false;  ///< even if the budget is spent
  bool faces = false;       ///< from the object's faces, if it has any, instead of its views
};
[[nodiscard]] node::Key keyOf(const OwnPicture& picture);
/// Throws node::PackingError.
[[nodiscard]] OwnPicture ownPictureOf(const node::Key& key);

/// Key of a picture for the frame's camera that shows the object's triangles; under the empty key it is made from
/// views.
inline constexpr const char* kNearKey = "near";

}  // namespace grove::objects::lightfield
