#include "objects/fluid/common/snapshot_packing.h"

#include <lz4.h>

#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include "objects/fluid/common/snapshot_planes.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace grove::objects::fluid {
namespace {

static_assert(std::endian::native == std::endian::little, "headers are copied as they are");

constexpr std::array<char, 4> kMagic{'G', 'F', 'S', 'P'};
constexpr std::uint16_t kVersion = 1;

struct Header {
  std::array<char, 4> magic = kMagic;
  std::uint16_t version = kVersion;
  std::uint16_t zero = 0;
  std::uint64_t checksum = 0;
  double time = 0.0;
  std::uint64_t tick = 0;
  std::uint32_t count = 0;
  SnapshotRange range;
};
static_assert(sizeof(Header) == 64);

constexpr std::size_t kUnchecked = 16;  // bytes before those that the checksum covers

std::uint64_t checksumOf(std::span<const std::byte> bytes) {
  const auto checked = bytes.subspan(kUnchecked);
  return XXH64(checked.data(), checked.size(), 0);
}

[[noreturn]] void refuse(const std::string& reason) { throw node::PackingError("packed smoke: " + reason); }

/// Appends planes and finds them again.
struct PlaneWriter {
  std::vector<std::byte>& bytes;
  std::vector<char> compressed;

  void add(std::span<const std::uint8_t> plane) {
    // An LZ4 block that is no shorter than the plane is not worth its name.
    compressed.resize(plane.size());
    const int size = LZ4_compress_fast(std::bit_cast<const char*>(plane.data()), compressed.data(),
                                       static_cast<int>(plane.size()), static_cast<int>(compressed.size()), 1);
    const auto length = static_cast<std::uint32_t>(size);
    append(&length, sizeof length);
    if (size > 0) {
      append(compressed.data(), static_cast<std::size_t>(size));
    } else {
      append(plane.data(), plane.size());
    }
  }

 private:
  void append(const void* data, std::size_t size) {
    const auto* from = static_cast<const std::byte*>(data);
    bytes.insert(bytes.end(), from, from + size);
  }
};

struct PlaneReader {
  std::span<const std::byte> bytes;

  /// The next plane of `count` bytes, decompressed into `room` if it has to be.
  const std::uint8_t* next(std::size_t count, std::vector<std::uint8_t>& room) {
    std::uint32_t length = 0;
    std::memcpy(&length, take(sizeof length).data(), sizeof length);
    if (length == 0) return std::bit_cast<const std::uint8_t*>(take(count).data());
    room.resize(count);
    const auto block = take(length);
    const int size = LZ4_decompress_safe(std::bit_cast<const char*>(block.data()), std::bit_cast<char*>(room.data()),
                                         static_cast<int>(block.size()), static_cast<int>(room.size()));
    if (size < 0 || static_cast<std::size_t>(size) != room.size()) refuse("a plane is damaged");
    return room.data();
  }

 private:
  std::span<const std::byte> take(std::size_t size) {
    if (size > bytes.size()) refuse("it ends too early");
    const auto taken = bytes.first(size);
    bytes = bytes.subspan(size);
    return taken;
  }
};

/// Finite, and so small that numbers in it stay finite.
bool sane(const SnapshotRange& range) {
  constexpr float kMost = 1e9F;
  bool good = range.fastest >= 0.0F && range.fastest <= kMost;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    good = good && std::abs(range.low[axis]) <= kMost && range.size[axis] >= 0.0F && range.size[axis] <= kMost;
  }
  return good;
}

}  // namespace

node::PackedBytes packSnapshot(const FluidSnapshot& snapshot) {
  const std::size_t count = snapshot.count();
  assert(count <= kMostPackedParticles);
  Header header;
  header.time = snapshot.time;
  header.tick = snapshot.tick;
  header.count = static_cast<std::uint32_t>(count);
  header.range = rangeOf(snapshot);

  std::vector<std::byte> bytes;
  bytes.reserve(sizeof header + kPlanes * (sizeof(std::uint32_t) + count));
  bytes.resize(sizeof header);
  std::vector<std::uint8_t> planes(kPlanes * count);
  toPlanes(snapshot, header.range, planes);
  PlaneWriter writer{bytes, {}};
  for (std::size_t plane = 0; plane < kPlanes; ++plane) writer.add({planes.data() + plane * count, count});

  std::memcpy(bytes.data(), &header, sizeof header);
  header.checksum = checksumOf(bytes);
  std::memcpy(bytes.data(), &header, sizeof header);
  return bytes;
}

std::shared_ptr<FluidSnapshot> unpackSnapshot(std::span<const std::byte> bytes) {
  Header header;
  if (bytes.size() < sizeof header) refuse("it ends too early");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.magic != kMagic) refuse("not packed smoke");
  if (header.version != kVersion) refuse("version " + std::to_string(header.version) + " is unknown");
  if (header.zero != 0 || header.checksum != checksumOf(bytes)) refuse("it is damaged");
  if (header.count > kMostPackedParticles) refuse("too many particles");
  if (std::isnan(header.time) || !sane(header.range)) refuse("its numbers make no sense");

  const std::size_t count = header.count;
  auto snapshot = std::make_shared<FluidSnapshot>(header.tick);
  snapshot->time = header.time;
  PlaneReader reader{bytes.subspan(sizeof header)};
  std::array<std::vector<std::uint8_t>, kPlanes> rooms;
  std::array<const std::uint8_t*, kPlanes> planes{};
  for (std::size_t plane = 0; plane < kPlanes; ++plane) planes[plane] = reader.next(count, rooms[plane]);
  if (!reader.bytes.empty()) refuse("it is too long");
  snapshot->resize(count);
  fromPlanes(planes, count, header.range, *snapshot);
  return snapshot;
}

node::PackedBytes FluidSnapshot::pack() const { return packSnapshot(*this); }

}  // namespace grove::objects::fluid
