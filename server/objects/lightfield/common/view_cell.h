#pragma once

#include <cstdint>
#include <optional>

#include "objects/lightfield/format/view_camera.h"

namespace grove::objects::lightfield {

/// Identifies a cell of eyes around an object; unique among the cells of one object.
struct CellId {
  std::int32_t focal = 0;  ///< step of the focal length
  std::int32_t shell = 0;  ///< step of the distance
  std::int32_t layer = 0;  ///< part of the shell
  std::int32_t band = 0;   ///< of elevations, from straight below
  std::int32_t column = 0;
  std::int32_t error = 0;    ///< permitted, in 1 / 64 of a pixel
  std::int32_t version = 0;  ///< of the picture's light field
  bool coarse = false;       ///< a picture of few texels, made when the budget was spent
  friend bool operator==(const CellId&, const CellId&) = default;
};

/// A set of nearby eyes that one picture of an object serves by reprojection: the eyes between two distances from the
/// centre of the object's ball, between two elevations and between two azimuths.
///
/// The error: two points of the ball that coincide for the cell's own eye may stand apart for another eye, and the
/// picture lacks what is visible between them. For every eye in the cell they stand apart by less than the permitted
/// error. The picture's own points are reprojected exactly, apart from rounding.
///
/// Pixels are those in the middle of a frame, 1 / focal of a radian each, independent of the viewing direction.
struct ViewCell {
  CellId id;
  ObjectCamera camera;  ///< of the cell's own eye, for an image of size x size pixels that encloses the ball
  int size = 0;         ///< at least one texel per pixel for every eye in the cell
  float reach = 0.0F;   ///< metres that an eye in the middle can move sideways at least before it leaves the cell
};

/// The cell of an eye (object coordinates) in a frame with this focal length in pixels. Nothing if a picture could not
/// be reused: the eye is in or near the ball, could not move by kMinReach, or needs more than kMaxCellSize pixels. The
/// error is rounded to 1 / 64 of a pixel.
[[nodiscard]] std::optional<ViewCell> viewCell(const ViewGeometry& geometry, world::Vec3 eye, float focal,
                                               float errorPixels);

/// The same cell from its id alone; nothing for an invalid id.
[[nodiscard]] std::optional<ViewCell> viewCell(const ViewGeometry& geometry, const CellId& id);

/// The reprojection error of a picture made from `own`, for `eye` (object coordinates; it may be in another cell), in a
/// frame of this focal length. The result is relative to the permitted error: `errorPixels` of parallax, a picture that
/// is less sharp than needed by an eighth of an octave, because the eye is nearer than `own`, or sharper by two eighths.
/// `sharper`: the picture's step of the focal length less the frame's. Above 1 it is an estimate, and it is infinite if
/// too little of the object is in the picture.
[[nodiscard]] float reprojectionError(const ViewGeometry& geometry, world::Vec3 own, world::Vec3 eye, float focal,
                                      float errorPixels, std::int32_t sharper = 0);

inline constexpr float kMinReach = 0.04F;
inline constexpr int kMaxCellSize = 2048;

}  // namespace grove::objects::lightfield
