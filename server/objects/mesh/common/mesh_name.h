#pragma once

namespace grove::objects::mesh {

inline constexpr const char* kTypeName = "mesh";

}  // namespace grove::objects::mesh
