#include "objects/mesh/backend/lighting/kept_light.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "base/error.h"
#include "objects/mesh/backend/lighting/temporary_cache.h"

namespace grove::objects::mesh {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using Light = std::vector<std::vector<world::Vec4>>;

constexpr std::uint64_t kKey = 0x0123456789ABCDEFULL;

class KeptLight : public testing::Test {
 protected:
  KeptLight() {
    writeKeptLight(file_, kKey, light_);
    std::ifstream in(file_, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(in), {});
  }

  /// What reading changed bytes says.
  std::string complaint(const std::string& bytes, std::uint64_t key = kKey,
                        const std::vector<std::size_t>& vertices = {3, 0, 5}) {
    const std::filesystem::path changed = cache_.path() / "changed";
    std::ofstream(changed, std::ios::binary) << bytes;
    try {
      (void)readKeptLight(changed, key, vertices);
    } catch (const KeptLightError& e) {
      EXPECT_TRUE(std::string(e.what()).starts_with(changed.string() + ": "));
      return e.what();
    }
    return "";
  }

  const TemporaryCache cache_;
  const std::filesystem::path file_ = keptLightFile(kKey);
  const Light light_{std::vector<world::Vec4>(3, {1.0F, 0.5F, 0.25F, 0.125F}),
                     {},
                     std::vector<world::Vec4>(5, {0.0F, 0.1F, 0.2F, 0.3F})};
  std::string bytes_;
};

TEST_F(KeptLight, RoundTripsUnderItsKey) {
  EXPECT_EQ(file_, cache_.path() / "mesh-light" / "0123456789abcdef.gml");
  EXPECT_EQ(readKeptLight(file_, kKey, std::vector<std::size_t>{3, 0, 5}), light_);
}

TEST_F(KeptLight, ErrorsNameTheReason) {
  EXPECT_EQ(complaint(bytes_), "");
  EXPECT_THAT(complaint(""), HasSubstr("is truncated"));
  EXPECT_THAT(complaint(std::string(bytes_.size(), 'x')), HasSubstr("is not a file of mesh light"));
  EXPECT_THAT(complaint(bytes_ + "x"), HasSubstr("has bytes after its end"));
  EXPECT_THAT(complaint(bytes_, kKey + 1), HasSubstr("other meshes"));
  EXPECT_THAT(complaint(bytes_, kKey, {3, 5}), HasSubstr("other meshes"));
  EXPECT_THAT(complaint(bytes_, kKey, {5, 0, 3}), HasSubstr("other meshes"));
  std::string newer = bytes_;
  newer[8] = 2;
  EXPECT_THAT(complaint(newer), HasSubstr("another format version"));
  EXPECT_THROW((void)readKeptLight(cache_.path() / "missing", kKey, {}), EnvironmentError);
}

TEST_F(KeptLight, RefusesEveryTruncation) {
  for (std::size_t bytes = 0; bytes < bytes_.size(); ++bytes) {
    EXPECT_THAT(complaint(bytes_.substr(0, bytes)), HasSubstr("is truncated")) << bytes;
  }
}

TEST_F(KeptLight, RefusesEveryChangedByte) {
  for (std::size_t at = 0; at < bytes_.size(); ++at) {
    std::string changed = bytes_;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    EXPECT_NE(complaint(changed), "") << at;
  }
}

TEST_F(KeptLight, RefusesNotANumberWithAValidChecksum) {
  Light light = light_;
  light[2][4].w = std::numeric_limits<float>::quiet_NaN();
  writeKeptLight(file_, kKey, light);
  EXPECT_THROW((void)readKeptLight(file_, kKey, std::vector<std::size_t>{3, 0, 5}), KeptLightError);
}

/// What each move of an object leaves behind, and each end while light is written.
class FormerLight : public KeptLight {
 protected:
  std::filesystem::path make(const std::string& name, std::chrono::minutes age) {
    std::filesystem::path file = file_.parent_path() / name;
    std::filesystem::copy_file(file_, file);
    std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now() - age);
    return file;
  }
};

TEST_F(FormerLight, RemovesAllButTheLastUsed) {
  std::vector<std::filesystem::path> files;
  for (int i = 1; i <= 9; ++i) files.push_back(make("former" + std::to_string(i) + ".gml", 5min * i));
  const std::filesystem::path other = make("other", 1000h);
  EXPECT_EQ(readKeptLight(files.back(), kKey, std::vector<std::size_t>{3, 0, 5}), light_) << "and is used by that";
  writeKeptLight(keptLightFile(kKey + 1), kKey + 1, light_);
  std::vector<bool> kept;
  kept.reserve(files.size());
  for (const auto& file : files) kept.push_back(std::filesystem::exists(file));
  // With the one just written and the fixture's there are eight.
  EXPECT_EQ(kept, (std::vector<bool>{true, true, true, true, true, false, false, false, true}));
  EXPECT_TRUE(std::filesystem::exists(file_));
  EXPECT_TRUE(std::filesystem::exists(keptLightFile(kKey + 1)));
  EXPECT_TRUE(std::filesystem::exists(other));
}

TEST_F(FormerLight, RemovesUnfinishedFiles) {
  const std::filesystem::path old = make("0123.gml.partial-abc123", 61min);
  const std::filesystem::path young = make("0123.gml.partial-def456", 50min);
  writeKeptLight(file_, kKey, light_);
  EXPECT_FALSE(std::filesystem::exists(old));
  EXPECT_TRUE(std::filesystem::exists(young)) << "somebody may be writing it";
}

TEST_F(FormerLight, ToleratesUndeletableFiles) {
  const std::filesystem::path folder = file_.parent_path() / "0123.gml.partial-folder";
  std::filesystem::create_directories(folder / "within");
  std::filesystem::last_write_time(folder, std::filesystem::file_time_type::clock::now() - 100h);
  EXPECT_NO_THROW(writeKeptLight(file_, kKey, light_));
  EXPECT_TRUE(std::filesystem::exists(folder / "within"));
}

}  // namespace
}  // namespace grove::objects::mesh
