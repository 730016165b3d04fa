#include "world/rays/embree_device.h"

#include <new>

#include "base/error.h"

namespace grove::world {

RTCDevice newEmbreeDevice() {
  RTCDevice device = rtcNewDevice("threads=1");
  if (device != nullptr) return device;
  if (rtcGetDeviceError(nullptr) != RTC_ERROR_UNSUPPORTED_CPU) throw std::bad_alloc();
  throw EnvironmentError("no ray-tracing device", "Embree", "check the CPU's SSE2");
}

void* requireBuffer(void* buffer) {
  if (buffer == nullptr) throw std::bad_alloc();
  return buffer;
}

void requireBuilt(RTCDevice device) {
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE) throw std::bad_alloc();
}

}  // namespace grove::world
