#pragma once

#include <cstddef>

namespace grove::objects::lightfield {

/// Of the pictures of far objects that visitors share.
struct ViewCacheOptions {
  std::size_t mostBytes = std::size_t{256} << 20U;  ///< 0: every picture is made anew
  float mostError = 16.0F;                          ///< pixels of parallax that reprojection may have to mend
};

}  // namespace grove::objects::lightfield
