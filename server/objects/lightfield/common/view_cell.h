#pragma once

#include <cstdint>
#include <optional>

#include "objects/lightfield/format/view_camera.h"

namespace grove::objects::lightfield {

/// Names one cell of eyes around an object; means something only among cells of one object.
struct CellId {
  std::int32_t focal = 0;  ///< step of the focal length
  std::int32_t shell = 0;  ///< step of the distance
  std::int32_t layer = 0;  ///< part of the shell
  std::int32_t band = 0;   ///< of elevations, from straight below
  std::int32_t column = 0;
  std::int32_t error = 0;    ///< permitted, in 1 / 64 of a pixel
  std::int32_t version = 0;  ///< of the light field that the picture is made of
  bool coarse = false;       ///< a picture of few texels, for want of time
  friend bool operator==(const CellId&, const CellId&) = default;
};

/// A set of neighbouring eyes that one picture of an object serves, reprojected by its depth: those between two
/// distances from the middle of the object's ball, between two elevations and between two azimuths.
///
/// The error: two points of the ball that hide one another from the cell's own eye may stand apart for another eye, and
/// what shows between them then is not in the picture. For every eye in the cell they stand apart by less than the
/// permitted error. What is in the picture is put where it belongs, with no error but rounding.
///
/// Pixels are those in the middle of a frame, 1 / focal of a radian each, whichever way the visitor looks.
struct ViewCell {
  CellId id;
  ObjectCamera camera;  ///< of the cell's own eye, for an image of size x size pixels that encloses the ball
  int size = 0;         ///< at least one texel to a pixel for every eye in the cell
  float reach = 0.0F;   ///< metres that an eye in the midst can at least go aside before it leaves
};

/// The cell of an eye (object coordinates) in a frame with this focal length in pixels. Nothing if a picture would not
/// be used again: if the eye is in or near the ball, could not move by kMinReach, or needs more than kMaxCellSize
/// pixels. The error is rounded to 1 / 64 of a pixel.
[[nodiscard]] std::optional<ViewCell> viewCell(const ViewGeometry& geometry, world::Vec3 eye, float focal,
                                               float errorPixels);

/// The same cell by its id alone; nothing if no eye has such a cell.
[[nodiscard]] std::optional<ViewCell> viewCell(const ViewGeometry& geometry, const CellId& id);

/// The reprojection error of a picture that was made from `own`, for `eye` (object coordinates), which need be in no
/// cell of it, in a frame of this focal length: in times of what is permitted, which is an error of `errorPixels`, and
/// to be an eighth of an octave nearer than `own` (the picture is then so much less sharp) or two farther. Beyond 1 it
/// is an estimate, and infinite where too little of the object is in the picture.
[[nodiscard]] float reprojectionError(const ViewGeometry& geometry, world::Vec3 own, world::Vec3 eye, float focal,
                                      float errorPixels);

inline constexpr float kMinReach = 0.04F;
inline constexpr int kMaxCellSize = 2048;

}  // namespace grove::objects::lightfield
