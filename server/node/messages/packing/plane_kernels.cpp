#include "node/messages/packing/plane_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "node/messages/packing/plane_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace grove::node::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

void splitPlanes(const std::uint32_t* words, std::size_t count, std::uint8_t* planes) {
  const hn::ScalableTag<std::uint8_t> tag;
  const std::size_t lanes = hn::Lanes(tag);
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(words);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    hn::Vec<decltype(tag)> a;
    hn::Vec<decltype(tag)> b;
    hn::Vec<decltype(tag)> c;
    hn::Vec<decltype(tag)> d;
    hn::LoadInterleaved4(tag, bytes + 4 * i, a, b, c, d);
    hn::StoreU(a, tag, planes + i);
    hn::StoreU(b, tag, planes + count + i);
    hn::StoreU(c, tag, planes + 2 * count + i);
    hn::StoreU(d, tag, planes + 3 * count + i);
  }
  for (; i < count; ++i) {
    for (std::size_t byte = 0; byte < 4; ++byte) planes[byte * count + i] = bytes[4 * i + byte];
  }
}

void joinPlanes(const std::uint8_t* planes, std::size_t count, std::uint32_t* words) {
  const hn::ScalableTag<std::uint8_t> tag;
  const std::size_t lanes = hn::Lanes(tag);
  auto* const bytes = reinterpret_cast<std::uint8_t*>(words);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    const auto a = hn::LoadU(tag, planes + i);
    const auto b = hn::LoadU(tag, planes + count + i);
    const auto c = hn::LoadU(tag, planes + 2 * count + i);
    const auto d = hn::LoadU(tag, planes + 3 * count + i);
    hn::StoreInterleaved4(a, b, c, d, tag, bytes + 4 * i);
  }
  for (; i < count; ++i) {
    for (std::size_t byte = 0; byte < 4; ++byte) bytes[4 * i + byte] = planes[byte * count + i];
  }
}

}  // namespace
}  // namespace grove::node::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grove::node {

HWY_EXPORT(splitPlanes);
HWY_EXPORT(joinPlanes);

void splitPlanes(const std::uint32_t* words, std::size_t count, std::uint8_t* planes) {
  HWY_DYNAMIC_DISPATCH(splitPlanes)(words, count, planes);
}

void joinPlanes(const std::uint8_t* planes, std::size_t count, std::uint32_t* words) {
  HWY_DYNAMIC_DISPATCH(joinPlanes)(planes, count, words);
}

}  // namespace grove::node
#endif
