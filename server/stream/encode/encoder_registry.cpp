#include "stream/encode/encoder_registry.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "stream/protocol/protocol.h"

namespace grove::stream {

void EncoderRegistry::add(EncoderKind kind) { kinds_.insert(kinds_.begin(), std::move(kind)); }

const EncoderKind& EncoderRegistry::choose(std::span<const std::uint8_t> offer) const {
  const auto of = [&](std::uint8_t codec) { return std::ranges::find(kinds_, codec, &EncoderKind::codec); };
  for (const std::uint8_t codec : offer) {
    if (const auto found = of(codec); found != kinds_.end()) return *found;
  }
  const auto jpeg = of(kCodecJpeg);
  assert(jpeg != kinds_.end());
  return *jpeg;
}

}  // namespace grove::stream
