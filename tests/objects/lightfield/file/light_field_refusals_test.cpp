#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <limits>
#include <utility>
#include <vector>

#include "base/checksum.h"
#include "objects/lightfield/file/light_field_file.h"
#include "objects/lightfield/file/light_field_reader.h"
#include "objects/lightfield/file/small_field.h"
#include "objects/lightfield/format/layout.h"

/// Files that are no light field, are damaged, or contradict themselves.
namespace grove::objects::lightfield {
namespace {

using testing::HasSubstr;

class LightFieldRefusals : public testing::Test {
 protected:
  LightFieldRefusals() { writeLightField(makeSmallField(), file_); }

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

  /// The same with a changed section and right checksums.
  template <class F>
  std::string complaintAboutSection(SectionIndex index, F change) {
    std::vector<std::byte> bytes = bytesOf(file_);
    Header header;
    std::memcpy(&header, bytes.data(), sizeof header);
    Section& section = header.sections[index];
    change(bytes.data() + section.offset);
    section.checksum = checksumOf(std::span(bytes).subspan(section.offset, section.bytes));
    header.headerChecksum = 0;
    header.headerChecksum = checksumOf(std::as_bytes(std::span(&header, 1)));
    std::memcpy(bytes.data(), &header, sizeof header);
    return complaint(bytes);
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "small.glf";
  std::filesystem::path changed_ = folder_ / "changed.glf";
};

TEST_F(LightFieldRefusals, ErrorsNameTheReason) {
  std::vector<std::byte> bytes = bytesOf(file_);
  EXPECT_THAT(complaint({}), HasSubstr("is not a light-field file"));
  EXPECT_THAT(complaint(std::vector<std::byte>(5000)), HasSubstr("is not a light-field file"));
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

TEST_F(LightFieldRefusals, ReportsANewerFormat) {
  EXPECT_THAT(complaintAboutHeader([](Header& h) { h.version = 4; }),
              HasSubstr("is of format version 4, made by a newer Grove"));
  EXPECT_THAT(complaintAboutHeader([](Header& h) { h.version = 0; }), HasSubstr("no valid format version"));
}

TEST_F(LightFieldRefusals, ChecksEveryFieldOfTheHeader) {
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
      {[](Header& h) { h.centre[0] = kNan; }, "has a length out of range"},
      {[](Header& h) { h.target[2] = kInfinity; }, "has a length out of range"},
      {[](Header& h) { h.radius = 1.0e9F; }, "has a length out of range"},
      {[](Header& h) { h.radius = 1.7F; }, "radius"},
      {[](Header& h) { h.radius = -3.0F; }, "radius"},
      {[](Header& h) { h.extent = 0.0F; }, "extent"},
      {[](Header& h) { h.extent = -1.0F; }, "extent"},
      {[](Header& h) { h.boundsHigh[1] = -1.0F; }, "bounds"},
      {[](Header& h) { h.boundsLow[1] = kNan; }, "has a length out of range"},
      {[](Header& h) { h.sunAzimuth = kInfinity; }, "has a length out of range"},
      {[](Header& h) { h.voxelCells[0] = 4; }, "voxels of the wrong length"},
      {[](Header& h) { h.voxelCells[0] = 0x80000003U; }, "number of voxels"},
      {[](Header& h) { h.voxelCell = 0.0F; }, "voxels without size"},
      {[](Header& h) { std::memset(h.source, 'x', sizeof h.source); }, "not a line of UTF-8"},
      {[](Header& h) { h.source[0] = '\xC3'; }, "not a line of UTF-8"},
      {[](Header& h) { h.source[0] = '\x1b'; }, "not a line of UTF-8"},
      {[](Header& h) { h.source[127] = 'x'; }, "not a line of UTF-8"},
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

/// Would catch a near model whose faces name vertices or colours that are not there.
TEST_F(LightFieldRefusals, ChecksTheNearModel) {
  using Change = void (*)(NearHeader&, NearCluster*, float*, NearFace*);
  const std::vector<std::pair<Change, const char*>> cases{
      {[](NearHeader& h, NearCluster*, float*, NearFace*) { ++h.clusters; }, "wrong length"},
      {[](NearHeader& h, NearCluster*, float*, NearFace*) { h.vertices = 0xFFFFFFFFU; }, "wrong length"},
      {[](NearHeader& h, NearCluster*, float*, NearFace*) { --h.faces; }, "wrong length"},
      {[](NearHeader& h, NearCluster*, float*, NearFace*) { ++h.colours; }, "wrong length"},
      {[](NearHeader&, NearCluster* c, float*, NearFace*) { c[0].firstVertex = 8; }, "invalid cluster"},
      {[](NearHeader&, NearCluster* c, float*, NearFace*) { c[1].firstVertex = 32; }, "invalid cluster"},
      {[](NearHeader&, NearCluster* c, float*, NearFace*) { c[0].vertices = 257; }, "invalid cluster"},
      {[](NearHeader&, NearCluster* c, float*, NearFace*) { c[0].vertices = 3; }, "invalid cluster"},
      {[](NearHeader&, NearCluster* c, float*, NearFace*) { c[1].faces = 2; }, "invalid cluster"},
      {[](NearHeader&, NearCluster* c, float*, NearFace*) { c[1].firstFace = 0xFFFFFFFFU; }, "invalid cluster"},
      {[](NearHeader&, NearCluster* c, float*, NearFace*) { c[1].firstColour = 3; }, "invalid cluster"},
      {[](NearHeader&, NearCluster* c, float*, NearFace*) { c[1].smooth = 2; }, "invalid cluster"},
      {[](NearHeader&, NearCluster* c, float*, NearFace*) { c[0].low[1] = -2.0e6F; }, "invalid cluster"},
      {[](NearHeader&, NearCluster*, float* p, NearFace*) { p[5] = std::numeric_limits<float>::quiet_NaN(); },
       "vertex out of range"},
      {[](NearHeader&, NearCluster*, float*, NearFace* f) { f[2][1] = 3; }, "invalid cluster"},
      {[](NearHeader&, NearCluster*, float*, NearFace* f) { f[0][3] = 4; }, "invalid cluster"},
  };
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto change = [&](std::byte* section) {
      auto* const clusters = reinterpret_cast<NearCluster*>(section + sizeof(NearHeader));
      auto* const positions = reinterpret_cast<float*>(clusters + 2);
      auto* const faces = reinterpret_cast<NearFace*>(positions + 3 * 2 * kClusterAlignment);
      cases[i].first(*reinterpret_cast<NearHeader*>(section), clusters, positions, faces);
    };
    EXPECT_THAT(complaintAboutSection(kNear, change), HasSubstr(cases[i].second)) << "case " << i;
  }
}

}  // namespace
}  // namespace grove::objects::lightfield
