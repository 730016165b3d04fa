#pragma once

namespace grove::objects::figure {

inline constexpr const char* kTypeName = "figure";

}  // namespace grove::objects::figure
