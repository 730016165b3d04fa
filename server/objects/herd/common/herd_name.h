#pragma once

namespace grove::objects::herd {

inline constexpr const char* kTypeName = "herd";

}  // namespace grove::objects::herd
