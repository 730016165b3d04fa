#pragma once

#include <embree3/rtcore.h>

namespace grove::world {

/// A device of one thread: the same triangles always give the same tree. Throws EnvironmentError, or std::bad_alloc.
[[nodiscard]] RTCDevice newEmbreeDevice();

/// Embree reports what it has no memory for by null, or by an error that one must ask for, and goes on. Both throw
/// std::bad_alloc instead.
[[nodiscard]] void* requireBuffer(void* buffer);
void requireBuilt(RTCDevice device);

}  // namespace grove::world
