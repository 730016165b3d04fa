#include "objects/lightfield/file/light_field_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstring>
#include <fstream>

#include "base/checksum.h"
#include "base/error.h"
#include "objects/lightfield/file/light_field_reader.h"
#include "objects/lightfield/file/mapped_file.h"
#include "objects/lightfield/file/small_field.h"
#include "objects/lightfield/format/layout.h"

namespace grove::objects::lightfield {
namespace {

using testing::HasSubstr;

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
  EXPECT_EQ(a.source, b.source);
  EXPECT_EQ(a.bytes, b.bytes);
}

class LightFieldFile : public testing::Test {
 protected:
  LightFieldFile() { writeLightField(field_, file_); }

  /// What opening a changed copy says.
  std::string complaint(const std::vector<std::byte>& bytes) {
    std::ofstream(changed_, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    try {
      (void)openLightField(changed_);
    } catch (const LightFieldError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with(changed_.string() + ": "));
      return error.what();
    }
    return "";
  }

  /// The same with a changed header whose checksum is right.
  template <class F>
  std::string complaintAboutHeader(F change) {
    std::vector<std::byte> bytes = bytesOf(file_);
    Header header;
    std::memcpy(&header, bytes.data(), sizeof header);
    change(header);
    header.headerChecksum = 0;
    header.headerChecksum = checksumOf(std::as_bytes(std::span(&header, 1)));
    std::memcpy(bytes.data(), &header, sizeof header);
    return complaint(bytes);
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "small.glf";
  std::filesystem::path changed_ = folder_ / "changed.glf";
  LightField field_ = makeSmallField();
};

TEST_F(LightFieldFile, RoundTrips) { expectSame(field_, openLightField(file_)); }

TEST_F(LightFieldFile, KeepsItsMappingAfterTheFileIsReplaced) {
  const LightField opened = openLightField(file_);
  LightField other = field_;
  other.source = "another";
  writeLightField(other, file_);
  expectSame(field_, opened);
  EXPECT_EQ(openLightField(file_).source, "another");
}

/// As `cp` over it does: cut off, then written anew.
TEST_F(LightFieldFile, WhoWritesIntoTheFileChangesWhatIsSeenAndNothingElse) {
  const LightField opened = openLightField(file_);
  const auto bytes = std::filesystem::file_size(file_);
  std::filesystem::resize_file(file_, 0);
  const std::string garbage(bytes, '\xA5');
  std::ofstream(file_, std::ios::binary) << garbage;
  for (std::size_t i = 0; i < field_.blocks.size(); ++i) expectSame(field_.blocks[i], opened.blocks[i]);
  EXPECT_EQ(opened.depth.back(), 0xA5A5U);
}

TEST_F(LightFieldFile, SaysOnceThatItBecameShorter) {
  const LightField opened = openLightField(file_);
  const auto said = [&] {
    testing::internal::CaptureStderr();
    opened.mapped->reportIfCut();
    return testing::internal::GetCapturedStderr();
  };
  std::filesystem::resize_file(file_, 4096);
  EXPECT_EQ(said(), "");
  EXPECT_EQ(opened.colour.back().back(), 0U);
  EXPECT_THAT(said(), HasSubstr(file_.string() + ": became shorter while it was served"));
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

TEST_F(LightFieldFile, CutsAndMendsTheSource) {
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
  EXPECT_EQ(std::memcmp(bytes.data(), "GroveLF\n\1\0\0\0\xF0\2\0\0", 16), 0);
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
  const std::array<std::uint32_t, 6> lengths{5 * 5 * 4,
                                             static_cast<std::uint32_t>(field_.depth.size_bytes()),
                                             6,
                                             2 * 56 + 10 * 8,
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

TEST_F(LightFieldFile, SaysWhatIsWrong) {
  std::vector<std::byte> bytes = bytesOf(file_);
  EXPECT_THAT(complaint({}), HasSubstr("is no light-field file"));
  EXPECT_THAT(complaint(std::vector<std::byte>(5000)), HasSubstr("is no light-field file"));
  EXPECT_THAT(complaint({bytes.begin(), bytes.begin() + 10}), HasSubstr("is truncated"));
  EXPECT_THAT(complaint({bytes.begin(), bytes.begin() + 100}), HasSubstr("is truncated"));
  EXPECT_THAT(complaint({bytes.begin(), bytes.end() - 1}), HasSubstr("is truncated"));
  std::vector<std::byte> longer = bytes;
  longer.push_back({});
  EXPECT_THAT(complaint(longer), HasSubstr("bytes after its end"));
  std::vector<std::byte> damaged = bytes;
  damaged[60] ^= std::byte{1};
  EXPECT_THAT(complaint(damaged), HasSubstr("damaged header"));
  damaged = bytes;
  damaged.back() ^= std::byte{1};
  EXPECT_THAT(complaint(damaged), HasSubstr("damaged section"));
}

TEST_F(LightFieldFile, SaysThatAFileIsFromTheFuture) {
  EXPECT_THAT(complaintAboutHeader([](Header& h) { h.version = 2; }),
              HasSubstr("is of format version 2, made by a newer Grove"));
  EXPECT_THAT(complaintAboutHeader([](Header& h) { h.version = 0; }), HasSubstr("no valid format version"));
}

TEST_F(LightFieldFile, ChecksEveryFieldOfTheHeader) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr std::uint64_t kHuge = ~std::uint64_t{0};
  using Change = void (*)(Header&);
  const std::vector<std::pair<Change, const char*>> cases{
      {[](Header& h) { h.headerBytes = 8; }, "header of the wrong length"},
      {[](Header& h) { h.fileBytes = 4096; }, "bytes after its end"},
      {[](Header& h) { h.fileBytes = kHuge; }, "truncated"},
      {[](Header& h) { h.subdivision = 0; }, "subdivision"},
      {[](Header& h) { h.subdivision = 129; }, "subdivision"},
      {[](Header& h) { h.subdivision = 2; }, "directory of the wrong length"},
      {[](Header& h) { h.size = 16; }, "size out of range"},
      {[](Header& h) { h.size = 48; }, "size out of range"},
      {[](Header& h) { h.size = 2048; }, "size out of range"},
      {[](Header& h) { h.size = 64; }, "directory of the wrong length"},
      {[](Header& h) { h.levels = 0; }, "levels"},
      {[](Header& h) { h.levels = 3; }, "levels"},
      {[](Header& h) { h.levels = 1; }, "directory of the wrong length"},
      {[](Header& h) { h.levels = 0xFFFFFFFFU; }, "levels"},
      {[](Header& h) { h.lightings = 0; }, "lightings"},
      {[](Header& h) { h.lightings = 17; }, "lightings"},
      {[](Header& h) { h.lightings = 1; }, "more sections than lightings"},
      {[](Header& h) { h.lightings = 3; }, "overlap|damaged section|colour of the wrong length"},
      {[](Header& h) { --h.blocks; }, "depth of the wrong length"},
      {[](Header& h) { h.blocks = 0xFFFFFFFFU; }, "depth of the wrong length"},
      {[](Header& h) { h.heldOut = 1; }, "held-out views of the wrong length"},
      {[](Header& h) { h.heldOut = 0xFFFFFFFFU; }, "held-out views of the wrong length"},
      {[](Header& h) { h.centre[0] = kNan; }, "no sane number"},
      {[](Header& h) { h.target[2] = kInfinity; }, "no sane number"},
      {[](Header& h) { h.radius = 1.0e9F; }, "no sane number"},
      {[](Header& h) { h.radius = 1.7F; }, "radius"},
      {[](Header& h) { h.radius = -3.0F; }, "radius"},
      {[](Header& h) { h.extent = 0.0F; }, "extent"},
      {[](Header& h) { h.extent = -1.0F; }, "extent"},
      {[](Header& h) { h.boundsHigh[1] = -1.0F; }, "bounds"},
      {[](Header& h) { h.boundsLow[1] = kNan; }, "no sane number"},
      {[](Header& h) { h.sunAzimuth = kInfinity; }, "no sane number"},
      {[](Header& h) { h.voxelCells[0] = 4; }, "voxels of the wrong length"},
      {[](Header& h) { h.voxelCells[0] = 0x80000003U; }, "number of voxels"},
      {[](Header& h) { h.voxelCell = 0.0F; }, "voxels without size"},
      {[](Header& h) { std::memset(h.source, 'x', sizeof h.source); }, "no line of UTF-8"},
      {[](Header& h) { h.source[0] = '\xC3'; }, "no line of UTF-8"},
      {[](Header& h) { h.source[0] = '\x1b'; }, "no line of UTF-8"},
      {[](Header& h) { h.source[127] = 'x'; }, "no line of UTF-8"},
      {[](Header& h) { ++h.sections[kDepth].offset; }, "not aligned"},
      {[](Header& h) { h.sections[kDepth].offset = 0; }, "overlap"},
      {[](Header& h) { h.sections[kDepth].offset = h.sections[kColour].offset; }, "overlap"},
      {[](Header& h) { h.sections[kDepth].offset = kHuge & ~std::uint64_t{4095}; }, "outside the file"},
      {[](Header& h) { h.sections[kDepth].bytes = kHuge; }, "outside the file"},
      {[](Header& h) { h.sections[kDirectory].bytes -= 4; }, "damaged section"},
      {[](Header& h) { ++h.sections[kVoxels].checksum; }, "damaged section"},
      {[](Header& h) { h.sections[kColour + 5].bytes = 1; }, "more sections than lightings"},
  };
  for (std::size_t i = 0; i < cases.size(); ++i)
    EXPECT_THAT(complaintAboutHeader(cases[i].first), testing::ContainsRegex(cases[i].second)) << "case " << i;
}

TEST_F(LightFieldFile, NoFileIsTheEnvironmentsFault) {
  EXPECT_THROW((void)openLightField(folder_ / "absent.glf"), EnvironmentError);
  EXPECT_THROW((void)openLightField(folder_.path()), EnvironmentError);
}

TEST_F(LightFieldFile, AFailedWriteLeavesTheOldFile) {
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
