#include "objects/fluid/common/snapshot_packing.h"

#include <zstd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "objects/fluid/common/snapshot_differences.h"
#include "objects/fluid/common/snapshot_steps.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace grove::objects::fluid {
namespace {

static_assert(std::endian::native == std::endian::little, "headers are copied as they are");

constexpr std::array<char, 4> kMagic{'G', 'F', 'S', 'P'};
constexpr std::uint16_t kVersion = 2;

struct Header {
  std::array<char, 4> magic = kMagic;
  std::uint16_t version = kVersion;
  std::uint16_t zero = 0;
  std::uint64_t checksum = 0;
  double time = 0.0;
  std::uint64_t tick = 0;
  std::uint64_t baseTick = 0;
  std::uint32_t baseCount = 0;
  std::uint32_t count = 0;
  std::uint32_t survivors = 0;
  std::array<std::int32_t, 3> low{};
};
static_assert(sizeof(Header) == 64);

constexpr std::size_t kUnchecked = 16;  // bytes before the checksummed part

/// An older base is useless.
constexpr std::uint64_t kMaxTicks = 256;

std::uint64_t checksumOf(std::span<const std::byte> bytes) {
  const auto checked = bytes.subspan(kUnchecked);
  return XXH64(checked.data(), checked.size(), 0);
}

[[noreturn]] void refuse(const std::string& reason) { throw node::PackingError("packed smoke: " + reason); }

/// Differences are nearly random, but some are much more frequent: only entropy coding pays.
constexpr int kLevel = 1;

struct FreeCompression {
  void operator()(ZSTD_CCtx* context) const noexcept { ZSTD_freeCCtx(context); }
};

/// One frame. Each plane begins a block, because the frequent bytes differ from plane to plane.
void appendCompressed(node::PackedBytes& bytes, std::span<const std::uint8_t> mask,
                      std::span<const std::uint8_t> planes, std::size_t planeSize) {
  const std::unique_ptr<ZSTD_CCtx, FreeCompression> context(ZSTD_createCCtx());
  if (!context) throw std::bad_alloc();
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, kLevel);
  const std::size_t begin = bytes.size();
  constexpr std::size_t kPerBlock = 32;
  bytes.resize(begin + ZSTD_compressBound(mask.size() + planes.size()) + kPerBlock * (2 * SnapshotSteps::kFields + 2));
  ZSTD_outBuffer out{bytes.data() + begin, bytes.size() - begin, 0};
  const auto put = [&](std::span<const std::uint8_t> part, ZSTD_EndDirective end) {
    ZSTD_inBuffer in{part.data(), part.size(), 0};
    const std::size_t left = ZSTD_compressStream2(context.get(), &out, &in, end);
    if (left != 0) throw std::runtime_error("zstd cannot pack smoke");
  };
  put(mask, ZSTD_e_flush);
  for (std::size_t at = 0; at < planes.size(); at += planeSize) put(planes.subspan(at, planeSize), ZSTD_e_flush);
  put({}, ZSTD_e_end);
  bytes.resize(begin + out.pos);
}

std::vector<std::uint8_t> decompressed(std::span<const std::byte> bytes, std::size_t size) {
  // Smallest size of a block in a frame, and the most bytes that it holds.
  constexpr std::size_t kMinBlock = 3;
  constexpr std::size_t kMaxBlock = 128 << 10;
  if (size > bytes.size() / kMinBlock * kMaxBlock) refuse("it is damaged");
  std::vector<std::uint8_t> planes(size);
  const std::size_t length = ZSTD_decompress(planes.data(), planes.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(length) != 0 || length != size) refuse("it is damaged");
  return planes;
}

std::size_t maskBytes(std::size_t particles) { return (particles + 7) / 8; }

void putMask(const std::vector<std::uint8_t>& lives, std::uint8_t* mask) {
  for (std::size_t i = 0; i < lives.size(); ++i) {
    mask[i / 8] = static_cast<std::uint8_t>(mask[i / 8] | lives[i] << i % 8);
  }
}

Survivors takeMask(std::span<const std::uint8_t> mask, std::size_t particles) {
  Survivors survivors{std::vector<std::uint8_t>(particles), 0};
  for (std::size_t i = 0; i < particles; ++i) {
    survivors.lives[i] = mask[i / 8] >> i % 8 & 1;
    survivors.count += survivors.lives[i];
  }
  return survivors;
}

std::array<std::int32_t, 3> lowestPlace(const SnapshotSteps& steps) {
  std::array<std::int32_t, 3> low{};
  for (std::size_t axis = 0; axis < 3 && steps.count() > 0; ++axis) {
    low[axis] = std::ranges::min(steps.fields[SnapshotSteps::kPosition + axis]);
  }
  return low;
}

Header takeHeader(std::span<const std::byte> bytes) {
  Header header;
  if (bytes.size() < sizeof header) refuse("it ends too early");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.magic != kMagic) refuse("not packed smoke");
  if (header.version != kVersion) refuse("version " + std::to_string(header.version) + " is unknown");
  if (header.zero != 0 || header.checksum != checksumOf(bytes)) refuse("it is damaged");
  if (header.count > kMaxPackedParticles || header.survivors > header.count) refuse("too many particles");
  constexpr std::int32_t kFar = 1 << 24;
  const bool isNear = std::ranges::all_of(header.low, [](std::int32_t low) { return low >= -kFar && low <= kFar; });
  if (std::isnan(header.time) || !isNear) refuse("its numbers are invalid");
  return header;
}

/// Throws unless `known` is the base that the header names.
SnapshotSteps baseOf(const Header& header, const FluidSnapshot* known) {
  if (header.baseCount == 0) return {};
  if (known == nullptr || known->tick != header.baseTick || known->count() != header.baseCount) {
    refuse("its base is missing");
  }
  if (header.tick <= header.baseTick || header.tick - header.baseTick > kMaxTicks) refuse("its ticks are invalid");
  return stepsOf(*known);
}

}  // namespace

node::PackedBytes packSnapshot(const FluidSnapshot& snapshot, const FluidSnapshot* base) {
  assert(snapshot.count() <= kMaxPackedParticles);
  if (base != nullptr && (base->tick >= snapshot.tick || snapshot.tick - base->tick > kMaxTicks)) base = nullptr;
  const SnapshotSteps steps = stepsOf(snapshot);
  const SnapshotSteps before = base == nullptr ? SnapshotSteps{} : stepsOf(*base);
  const auto ticks = base == nullptr ? 1 : static_cast<std::int32_t>(snapshot.tick - base->tick);
  const Survivors survivors = findSurvivors(before, steps, ticks);
  Header header;
  header.time = snapshot.time;
  header.tick = snapshot.tick;
  header.baseTick = base == nullptr ? 0 : base->tick;
  header.baseCount = static_cast<std::uint32_t>(before.count());
  header.count = static_cast<std::uint32_t>(steps.count());
  header.survivors = static_cast<std::uint32_t>(survivors.count);
  header.low = lowestPlace(steps);

  const std::size_t mask = maskBytes(before.count());
  std::vector<std::uint8_t> planes(mask + 2 * SnapshotSteps::kFields * steps.count());
  putMask(survivors.lives, planes.data());
  toDifferences({before, survivors, ticks, header.low}, steps, std::span(planes).subspan(mask));
  node::PackedBytes bytes(sizeof header);
  appendCompressed(bytes, std::span(planes).first(mask), std::span(planes).subspan(mask), steps.count());
  std::memcpy(bytes.data(), &header, sizeof header);
  header.checksum = checksumOf(bytes);
  std::memcpy(bytes.data(), &header, sizeof header);
  return bytes;
}

std::shared_ptr<FluidSnapshot> unpackSnapshot(std::span<const std::byte> bytes, const FluidSnapshot* known) {
  const Header header = takeHeader(bytes);
  const SnapshotSteps base = baseOf(header, known);
  const std::size_t mask = maskBytes(base.count());
  const std::vector<std::uint8_t> planes =
      decompressed(bytes.subspan(sizeof header), mask + 2 * SnapshotSteps::kFields * header.count);
  const Survivors survivors = takeMask(std::span(planes).first(mask), base.count());
  if (survivors.count != header.survivors) refuse("its particles are invalid");
  SnapshotSteps steps;
  steps.resize(header.count);
  const auto ticks = base.count() == 0 ? 1 : static_cast<std::int32_t>(header.tick - header.baseTick);
  fromDifferences({base, survivors, ticks, header.low}, std::span(planes).subspan(mask), steps);
  auto snapshot = std::make_shared<FluidSnapshot>(header.tick);
  snapshot->time = header.time;
  restore(steps, *snapshot);
  return snapshot;
}

node::PackedBytes FluidSnapshot::pack() const { return packSnapshot(*this); }

}  // namespace grove::objects::fluid
