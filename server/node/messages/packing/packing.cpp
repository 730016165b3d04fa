#include "node/messages/packing/packing.h"

#include <lz4.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "node/messages/packing/plane_kernels.h"

namespace grove::node {
namespace {

/// Marks a plane that is stored uncompressed.
constexpr std::uint32_t kStored = std::numeric_limits<std::uint32_t>::max();

/// Four planes stay in a core's own cache, and need no memory of their own.
constexpr std::size_t kWordsAtOnce = 8192;

}  // namespace

void appendCompressed(PackedBytes& to, std::span<const std::byte> plane) {
  const std::size_t begin = to.size();
  to.resize(begin + sizeof(std::uint32_t) + plane.size());
  std::byte* const data = to.data() + begin + sizeof(std::uint32_t);
  const auto max = static_cast<int>(plane.size());
  const int size =
      LZ4_compress_default(reinterpret_cast<const char*>(plane.data()), reinterpret_cast<char*>(data), max, max);
  std::uint32_t length = kStored;
  if (size > 0) {
    length = static_cast<std::uint32_t>(size);
    to.resize(begin + sizeof(std::uint32_t) + length);
  } else {
    std::ranges::copy(plane, data);
  }
  std::memcpy(to.data() + begin, &length, sizeof length);
}

void takeCompressed(std::span<const std::byte>& from, std::span<std::byte> plane) {
  std::uint32_t length = 0;
  if (from.size() < sizeof length) throw PackingError("a plane is truncated");
  std::memcpy(&length, from.data(), sizeof length);
  from = from.subspan(sizeof length);
  const std::size_t stored = length == kStored ? plane.size() : length;
  if (from.size() < stored) throw PackingError("a plane is truncated");
  if (length == kStored) {
    std::ranges::copy(from.first(stored), plane.begin());
  } else {
    const int size =
        LZ4_decompress_safe(reinterpret_cast<const char*>(from.data()), reinterpret_cast<char*>(plane.data()),
                            static_cast<int>(stored), static_cast<int>(plane.size()));
    if (size < 0 || static_cast<std::size_t>(size) != plane.size()) throw PackingError("a plane is damaged");
  }
  from = from.subspan(stored);
}

void appendPlanes(PackedBytes& to, std::span<const std::uint32_t> words) {
  std::array<std::uint8_t, 4 * kWordsAtOnce> planes;
  for (std::size_t at = 0; at < words.size(); at += kWordsAtOnce) {
    const std::size_t count = std::min(kWordsAtOnce, words.size() - at);
    splitPlanes(words.data() + at, count, planes.data());
    const auto bytes = std::as_bytes(std::span(planes));
    for (std::size_t plane = 0; plane < 4; ++plane) appendCompressed(to, bytes.subspan(plane * count, count));
  }
}

void takePlanes(std::span<const std::byte>& from, std::span<std::uint32_t> words) {
  std::array<std::uint8_t, 4 * kWordsAtOnce> planes;
  for (std::size_t at = 0; at < words.size(); at += kWordsAtOnce) {
    const std::size_t count = std::min(kWordsAtOnce, words.size() - at);
    const auto bytes = std::as_writable_bytes(std::span(planes));
    for (std::size_t plane = 0; plane < 4; ++plane) takeCompressed(from, bytes.subspan(plane * count, count));
    joinPlanes(planes.data(), count, words.data() + at);
  }
}

}  // namespace grove::node
