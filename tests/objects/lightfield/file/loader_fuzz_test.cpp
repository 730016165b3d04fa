#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <random>
#include <set>
#include <string>

#include "base/checksum.h"
#include "objects/lightfield/file/light_field_file.h"
#include "objects/lightfield/file/light_field_reader.h"
#include "objects/lightfield/file/small_field.h"
#include "objects/lightfield/format/layout.h"

/// Thousands of broken files, the same ones in every run. Half of them get right checksums again, so that what stands
/// behind the checksums is reached. Each is read from memory of exactly its length: the address sanitizer sees a step
/// beyond it.
namespace grove::objects::lightfield {
namespace {

using Random = std::mt19937;
using Bytes = std::vector<std::byte>;

std::size_t below(Random& random, std::size_t limit) { return limit == 0 ? 0 : random() % limit; }

Header headerOf(const Bytes& bytes) {
  Header header;
  std::memcpy(&header, bytes.data(), sizeof header);
  return header;
}

void mendChecksums(Bytes& bytes) {
  if (bytes.size() < sizeof(Header)) return;
  Header header = headerOf(bytes);
  header.fileBytes = bytes.size();
  for (Section& section : header.sections) {
    if (section.offset > bytes.size() || section.bytes > bytes.size() - section.offset) continue;
    if (section.offset == 0) continue;
    section.checksum = checksumOf(std::span(bytes).subspan(section.offset, section.bytes));
  }
  header.headerChecksum = 0;
  header.headerChecksum = checksumOf(std::as_bytes(std::span(&header, 1)));
  std::memcpy(bytes.data(), &header, sizeof header);
}

/// Numbers that break arithmetic.
std::uint32_t nasty(Random& random) {
  constexpr std::array<std::uint32_t, 16> kNasty{0,          1,          2,          3,         15,         16,
                                                 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0xFFFFFFF, 0x7F800000, 0x7FC00000,
                                                 0xFF800000, 0x00000001, 4096,       0x10000};
  return random() % 3 == 0 ? static_cast<std::uint32_t>(random()) : kNasty[below(random, kNasty.size())];
}

void putWord(Bytes& bytes, std::size_t at, std::uint32_t word) {
  if (at + sizeof word <= bytes.size()) std::memcpy(bytes.data() + at, &word, sizeof word);
}

/// A place in the header, the directory, the voxels or the held-out views, where a change means something.
std::size_t tellingPlace(const Bytes& bytes, Random& random) {
  if (bytes.size() < sizeof(Header)) return below(random, bytes.size());
  const Header header = headerOf(bytes);
  const std::array<SectionIndex, 3> telling{kDirectory, kVoxels, kHeldOut};
  const std::size_t which = below(random, 6);
  if (which >= telling.size()) return below(random, sizeof(Header));
  const Section& section = header.sections[telling[which]];
  return static_cast<std::size_t>(section.offset) + below(random, static_cast<std::size_t>(section.bytes));
}

void mutate(Bytes& bytes, Random& random) {
  const std::size_t place = tellingPlace(bytes, random);
  switch (random() % 8) {
    case 0:
      if (place < bytes.size()) bytes[place] ^= static_cast<std::byte>(1U << random() % 8);
      break;
    case 1:
      if (place < bytes.size()) bytes[place] = static_cast<std::byte>(random());
      break;
    case 2:
      bytes.resize(below(random, bytes.size() + 1));
      break;
    case 3:
      bytes.resize(bytes.size() + below(random, 5000), static_cast<std::byte>(random()));
      break;
    case 4: {  // move a section, or change its length
      const std::size_t at = offsetof(Header, sections) + below(random, 20) * sizeof(Section) + below(random, 4) * 4;
      putWord(bytes, at, random() % 2 == 0 ? static_cast<std::uint32_t>(below(random, 40)) * 4096U : nasty(random));
      break;
    }
    default:
      putWord(bytes, place / 4 * 4, nasty(random));
  }
}

/// Goes through all that a reader may reach, as one would who trusts the field.
std::uint64_t touch(const LightField& field) {
  std::uint64_t sum = std::accumulate(field.source.begin(), field.source.end(), std::uint64_t{0});
  for (int level = 0; level < field.levels; ++level) {
    const auto across = static_cast<std::size_t>(field.blocksAcross(level));
    const auto views = static_cast<std::size_t>(field.sphere.views());
    for (std::size_t entry = 0; entry < views * across * across; ++entry) {
      const std::uint32_t block = field.blocks[static_cast<std::size_t>(level)][entry];
      if (block == kNoBlock) continue;
      for (std::size_t texel = 0; texel < kBlockTexels; ++texel) {
        const std::size_t at = std::size_t{block} * kBlockTexels + texel;
        sum += field.depth.data()[at];
        for (const auto& lit : field.colour) sum += lit.data()[at];
      }
    }
  }
  const VoxelGrid& v = field.voxels;
  for (int z = 0; z < v.depth; ++z) {
    for (int y = 0; y < v.height; ++y) {
      for (int x = 0; x < v.width; ++x) sum += v.cells.data()[(z * v.height + y) * v.width + x];
    }
  }
  for (const HeldOutView& view : field.heldOut) {
    for (int i = 0; i < view.size * view.size; ++i)
      sum += view.colour.data()[i] + (view.depth.data()[i] > 1.0F ? 1 : 0);
  }
  for (int view = 0; view < field.sphere.views(); ++view) {
    const ViewCamera camera = viewCamera(field.geometry, field.sphere.direction(view));
    EXPECT_TRUE(std::isfinite(camera.focal) && std::isfinite(glm::length(camera.eye)) && camera.nearDepth >= 0.0F);
  }
  return sum;
}

TEST(LoaderFuzz, BreaksNothing) {
  const TemporaryFolder folder;
  writeLightField(makeSmallField(), folder / "small.glf");
  const Bytes good = bytesOf(folder / "small.glf");
  Random random(20240611);
  int loaded = 0;
  int refused = 0;
  std::set<std::string> reasons;
  std::uint64_t sum = 0;
  for (int i = 0; i < 20000; ++i) {
    Bytes bytes = good;
    const std::size_t changes = 1 + below(random, 3);
    for (std::size_t k = 0; k < changes; ++k) mutate(bytes, random);
    if (random() % 8 != 0) mendChecksums(bytes);
    bytes.shrink_to_fit();
    try {
      sum += touch(readLightField(bytes, "fuzzed", nullptr));
      ++loaded;
    } catch (const LightFieldError& error) {
      reasons.insert(error.what());
      ++refused;
    }
  }
  // The numbers say that the fuzzer reaches what it is for: files that pass all checks, and nearly all complaints.
  EXPECT_GT(loaded, 1000);
  EXPECT_GT(refused, 5000);
  EXPECT_GE(reasons.size(), 25U);
  EXPECT_NE(sum, 0U);
}

TEST(LoaderFuzz, EveryTruncationIsRefused) {
  const TemporaryFolder folder;
  writeLightField(makeSmallField(), folder / "small.glf");
  const Bytes good = bytesOf(folder / "small.glf");
  for (std::size_t length = 0; length < good.size(); length += length < 1000 ? 1 : 97) {
    Bytes bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length));
    EXPECT_THROW((void)readLightField(bytes, "cut", nullptr), LightFieldError) << length;
    mendChecksums(bytes);
    EXPECT_THROW((void)readLightField(bytes, "cut", nullptr), LightFieldError) << length;
  }
}

}  // namespace
}  // namespace grove::objects::lightfield
