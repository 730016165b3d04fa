#pragma once

#include <embree3/rtcore.h>

namespace grove::world {

/// Creates a device with one thread: the same triangles always give the same tree. Throws EnvironmentError, or
/// std::bad_alloc.
[[nodiscard]] RTCDevice newEmbreeDevice();

/// Embree reports a lack of memory by null or by a device error, and continues. Both functions throw std::bad_alloc
/// instead.
[[nodiscard]] void* requireBuffer(void* buffer);
void requireBuilt(RTCDevice device);

}  // namespace grove::world
