#pragma once

namespace grove::objects::lightfield {

/// Of the pictures that light fields are shown with.
struct LightFieldOptions {
  bool reusesPictures = true;  ///< or every picture is made anew
  float maxError = 16.0F;      ///< pixels of parallax that reprojection may have to mend
};

}  // namespace grove::objects::lightfield
