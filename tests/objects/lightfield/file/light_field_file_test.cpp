#include "objects/lightfield/file/light_field_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <fstream>

#include "base/error.h"
#include "objects/lightfield/file/light_field_reader.h"
#include "objects/lightfield/file/mapped_file.h"
#include "objects/lightfield/file/small_field.h"
#include "objects/lightfield/format/layout.h"

namespace grove::objects::lightfield {
namespace {

using testing::HasSubstr;

/// Bytes of files that count as this process's memory.
std::size_t fileBytesInMemory() {
  std::ifstream statm("/proc/self/statm");
  std::size_t size = 0;
  std::size_t resident = 0;
  std::size_t shared = 0;
  statm >> size >> resident >> shared;
  return shared * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

/// Fails if a light field whose checksums were read counts as memory as a whole.
TEST(MappedFile, ReleasedPagesCountNoMore) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "large";
  constexpr std::size_t kBytes = std::size_t{32} << 20U;
  std::ofstream(path) << std::string(kBytes, 'g');
  const MappedFile file(path);
  const std::size_t before = fileBytesInMemory();
  const auto isG = [](std::byte value) { return value == std::byte{'g'}; };
  EXPECT_TRUE(std::ranges::all_of(file.bytes(), isG));
  EXPECT_GT(fileBytesInMemory(), before + kBytes / 2);
  file.release();
  EXPECT_LT(fileBytesInMemory(), before + kBytes / 4);
  EXPECT_TRUE(std::ranges::all_of(file.bytes(), isG));
}

template <class T>
void expectSame(std::span<const T> a, std::span<const T> b) {
  EXPECT_TRUE(std::ranges::equal(a, b));
}

void expectSame(const LightField& a, const LightField& b) {
  EXPECT_EQ(a.sphere.subdivision(), b.sphere.subdivision());
  EXPECT_EQ(a.geometry.centre, b.geometry.centre);
  EXPECT_EQ(a.geometry.radius, b.geometry.radius);
  EXPECT_EQ(a.geometry.target, b.geometry.target);
  EXPECT_EQ(a.geometry.extent, b.geometry.extent);
  EXPECT_EQ(a.bounds.low, b.bounds.low);
  EXPECT_EQ(a.bounds.high, b.bounds.high);
  EXPECT_EQ(a.size, b.size);
  EXPECT_EQ(a.levels, b.levels);
  EXPECT_EQ(a.sunAzimuth, b.sunAzimuth);
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  for (std::size_t i = 0; i < a.blocks.size(); ++i) expectSame(a.blocks[i], b.blocks[i]);
  expectSame(a.depth, b.depth);
  ASSERT_EQ(a.colour.size(), b.colour.size());
  for (std::size_t i = 0; i < a.colour.size(); ++i) expectSame(a.colour[i], b.colour[i]);
  EXPECT_EQ(a.voxels.width, b.voxels.width);
  EXPECT_EQ(a.voxels.height, b.voxels.height);
  EXPECT_EQ(a.voxels.depth, b.voxels.depth);
  EXPECT_EQ(a.voxels.cell, b.voxels.cell);
  EXPECT_EQ(a.voxels.low, b.voxels.low);
  expectSame(a.voxels.cells, b.voxels.cells);
  ASSERT_EQ(a.heldOut.size(), b.heldOut.size());
  for (std::size_t i = 0; i < a.heldOut.size(); ++i) {
    EXPECT_EQ(a.heldOut[i].camera.eye, b.heldOut[i].camera.eye);
    EXPECT_EQ(a.heldOut[i].camera.corner, b.heldOut[i].camera.corner);
    EXPECT_EQ(a.heldOut[i].camera.perColumn, b.heldOut[i].camera.perColumn);
    EXPECT_EQ(a.heldOut[i].camera.perRow, b.heldOut[i].camera.perRow);
    EXPECT_EQ(a.heldOut[i].size, b.heldOut[i].size);
    expectSame(a.heldOut[i].colour, b.heldOut[i].colour);
    expectSame(a.heldOut[i].depth, b.heldOut[i].depth);
  }
  ASSERT_EQ(a.near.clusters.size(), b.near.clusters.size());
  expectSame(std::as_bytes(a.near.clusters), std::as_bytes(b.near.clusters));
  for (std::size_t axis = 0; axis < 3; ++axis) expectSame(a.near.positions[axis], b.near.positions[axis]);
  expectSame(a.near.faces, b.near.faces);
  ASSERT_EQ(a.near.colours.size(), b.near.colours.size());
  for (std::size_t k = 0; k < a.near.colours.size(); ++k) expectSame(a.near.colours[k], b.near.colours[k]);
  EXPECT_EQ(a.source, b.source);
  EXPECT_EQ(a.bytes, b.bytes);
}

class LightFieldFile : public testing::Test {
 protected:
  LightFieldFile() { writeLightField(field_, file_); }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "small.glf";
  LightField field_ = makeSmallField();
};

TEST_F(LightFieldFile, RoundTrips) { expectSame(field_, openLightField(file_)); }

TEST_F(LightFieldFile, RoundTripsWithoutANearModel) {
  field_.near = {};
  writeLightField(field_, file_);
  const LightField opened = openLightField(file_);
  EXPECT_TRUE(opened.near.empty());
  EXPECT_TRUE(opened.near.faces.empty());
}

TEST_F(LightFieldFile, KeepsItsMappingAfterTheFileIsReplaced) {
  const LightField opened = openLightField(file_);
  LightField other = field_;
  other.source = "another";
  writeLightField(other, file_);
  expectSame(field_, opened);
  EXPECT_EQ(openLightField(file_).source, "another");
}

/// As `cp` over it does: cut off, then written anew.
TEST_F(LightFieldFile, WritesIntoTheFileDoNoHarm) {
  const LightField opened = openLightField(file_);
  const auto bytes = std::filesystem::file_size(file_);
  std::filesystem::resize_file(file_, 0);
  const std::string garbage(bytes, '\xA5');
  std::ofstream(file_, std::ios::binary) << garbage;
  for (std::size_t i = 0; i < field_.blocks.size(); ++i) expectSame(field_.blocks[i], opened.blocks[i]);
  EXPECT_EQ(opened.depth.back(), 0xA5A5U);
}

TEST_F(LightFieldFile, ReportsTruncationOnce) {
  const LightField opened = openLightField(file_);
  const auto said = [&] {
    testing::internal::CaptureStderr();
    opened.mapped->reportIfCut();
    return testing::internal::GetCapturedStderr();
  };
  std::filesystem::resize_file(file_, 4096);
  EXPECT_EQ(said(), "");
  EXPECT_EQ(opened.colour.back().back(), 0U);
  EXPECT_THAT(said(), HasSubstr(file_.string() + ": was truncated while it was in use"));
  EXPECT_EQ(said(), "");
}

TEST_F(LightFieldFile, RoundTripsWithoutVoxelsAndHeldOutViews) {
  field_.voxels = {};
  field_.heldOut.clear();
  writeLightField(field_, file_);
  const LightField opened = openLightField(file_);
  EXPECT_EQ(opened.voxels.width, 0);
  EXPECT_TRUE(opened.heldOut.empty());
  expectSame(field_.colour[1], opened.colour[1]);
}

TEST_F(LightFieldFile, TruncatesLongSources) {
  field_.source = std::string(126, 'a') + "ä and more";
  writeLightField(field_, file_);
  EXPECT_EQ(openLightField(file_).source, std::string(126, 'a'));
  field_.source = "bell \a, escape \x1b[31m, broken \xC3, ok \xE2\x82\xAC";
  writeLightField(field_, file_);
  EXPECT_EQ(openLightField(file_).source, "bell ?, escape ?[31m, broken ?, ok \xE2\x82\xAC");
}

/// The layout is what FORMAT.md says, byte by byte: a change of it must come with a new version.
TEST_F(LightFieldFile, HeaderHasItsGoldenBytes) {
  const std::vector<std::byte> bytes = bytesOf(file_);
  ASSERT_GE(bytes.size(), 4096U);
  const auto u32 = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8U | std::to_integer<std::uint32_t>(bytes[at + i]);
    return value;
  };
  const auto f32 = [&](std::size_t at) {
    const std::uint32_t bits = u32(at);
    float value = 0.0F;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  };
  EXPECT_EQ(std::memcmp(bytes.data(), "GroveLF\n\3\0\0\0\x08\3\0\0", 16), 0);
  EXPECT_EQ(u32(16), bytes.size());
  EXPECT_EQ(u32(32), 1U);   // subdivision
  EXPECT_EQ(u32(36), 32U);  // size
  EXPECT_EQ(u32(40), 2U);   // levels
  EXPECT_EQ(u32(44), 2U);   // lightings
  EXPECT_EQ(u32(48), field_.depth.size() / kBlockTexels);
  EXPECT_EQ(u32(52), 2U);  // held-out
  EXPECT_EQ(f32(56), 0.1F);
  EXPECT_EQ(f32(68), 3.0F);
  EXPECT_EQ(f32(76), 0.5F);
  EXPECT_EQ(f32(84), 1.25F);
  EXPECT_EQ(f32(88), -0.5F);
  EXPECT_EQ(f32(108), 0.75F);
  EXPECT_EQ(f32(112), 1.5F);
  EXPECT_EQ(u32(116), 3U);
  EXPECT_EQ(f32(128), 0.25F);
  EXPECT_EQ(f32(132), -0.5F);
  EXPECT_EQ(std::memcmp(&bytes[144], "a small B\xC3\xA4umchen\0", 18), 0);
  const std::array<std::uint32_t, 7> lengths{5 * 5 * 4,
                                             static_cast<std::uint32_t>(field_.depth.size_bytes()),
                                             6,
                                             2 * 56 + 10 * 8,
                                             16 + 2 * 48 + 32 * 12 + 3 * 4 + 2 * 2 * 5 * 4,
                                             static_cast<std::uint32_t>(field_.depth.size_bytes() * 2),
                                             static_cast<std::uint32_t>(field_.depth.size_bytes() * 2)};
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    EXPECT_EQ(u32(272 + 24 * i) % 4096, 0U);
    EXPECT_EQ(u32(272 + 24 * i + 8), lengths[i]) << i;
  }
  // XXH3-64 of the voxels, as the library (not its header) computes it.
  EXPECT_EQ(u32(272 + 24 * kVoxels + 16), 0xF4201267U);
  EXPECT_EQ(u32(272 + 24 * kVoxels + 20), 0x68284441U);
}

TEST_F(LightFieldFile, MissingFileIsAnEnvironmentError) {
  EXPECT_THROW((void)openLightField(folder_ / "absent.glf"), EnvironmentError);
  EXPECT_THROW((void)openLightField(folder_.path()), EnvironmentError);
}

TEST_F(LightFieldFile, FailedWriteKeepsTheOldFile) {
  const std::vector<std::byte> before = bytesOf(file_);
  EXPECT_THROW(writeLightField(field_, folder_ / "absent" / "small.glf"), EnvironmentError);

  // A limit on the length of files fails in the midst of a write, as a full disk does.
  const auto oldHandler = signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  const rlimit small{20000, old.rlim_max};
  ASSERT_LT(20000U, before.size());
  setrlimit(RLIMIT_FSIZE, &small);
  std::string complaint;
  try {
    writeLightField(field_, file_);
  } catch (const EnvironmentError& error) {
    complaint = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &old);
  signal(SIGXFSZ, oldHandler);
  EXPECT_THAT(complaint, HasSubstr(file_.string() + ": cannot write: "));
  EXPECT_EQ(bytesOf(file_), before);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1) << "no partial file stays";
}

}  // namespace
}  // namespace grove::objects::lightfield
