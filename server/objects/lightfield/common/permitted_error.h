#pragma once

#include <limits>

namespace grove::objects::lightfield {

/// Errors of imperfect pictures relative to the permitted error.

/// Minimum error of a coarse picture, made with few texels because the budget was spent.
inline constexpr float kCoarseError = 4.0F;

/// Minimum error of a picture of a former light field; small, so that it is replaced when the budget permits.
inline constexpr float kOutdatedError = 1.5F;

/// Largest error of a picture of a former light field for which it is still cross-faded with its replacement.
inline constexpr float kMaxFadingError = 4.0F;

/// Error of a picture that is missing or does not cover the visible part.
inline constexpr float kNever = std::numeric_limits<float>::infinity();

/// Pixel width of a coarse picture relative to a fine one.
inline constexpr float kCoarse = 4.0F;

}  // namespace grove::objects::lightfield
