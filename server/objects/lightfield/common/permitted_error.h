#pragma once

#include <limits>

namespace grove::objects::lightfield {

/// What pictures that are not what they should be count as, in times of the permitted error.

/// Of few texels, for want of time: at least so much.
inline constexpr float kCoarseError = 4.0F;

/// Of a former light field: at least so much, so little that it is replaced when there is time.
inline constexpr float kOutdatedError = 1.5F;

/// Of a former light field: a picture with a larger error is no longer mixed into the one that replaces it.
inline constexpr float kMaxFadingError = 4.0F;

/// Of a picture that is missing or does not cover what is seen.
inline constexpr float kNever = std::numeric_limits<float>::infinity();

/// Times the width of the pixels of a coarse picture.
inline constexpr float kCoarse = 4.0F;

}  // namespace grove::objects::lightfield
