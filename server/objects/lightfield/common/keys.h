#pragma once

#include "node/messages/shared_key.h"
#include "objects/lightfield/common/view_cell.h"

/// The keys under which a light field answers.
namespace grove::objects::lightfield {

/// Of the shared picture of a cell.
[[nodiscard]] node::Key keyOf(const CellId& id);
/// Throws node::PackingError.
[[nodiscard]] CellId cellIdOf(const node::Key& key);

/// Of a visitor's own picture from a camera that is not his frame's.
struct OwnPicture {
  ObjectCamera camera;
  bool mustBeMade = false;  ///< even if there is no time left for it
};
[[nodiscard]] node::Key keyOf(const OwnPicture& picture);
/// Throws node::PackingError.
[[nodiscard]] OwnPicture ownPictureOf(const node::Key& key);

}  // namespace grove::objects::lightfield
