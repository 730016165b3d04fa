#include "objects/mesh/kept_light.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <limits>
#include <string>

#include "base/error.h"
#include "objects/mesh/temporary_cache.h"

namespace grove::objects::mesh {
namespace {

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

TEST_F(KeptLight, RoundTripsUnderANameOfItsKey) {
  EXPECT_EQ(file_, cache_.path() / "mesh-light" / "0123456789abcdef.gml");
  EXPECT_EQ(readKeptLight(file_, kKey, std::vector<std::size_t>{3, 0, 5}), light_);
}

TEST_F(KeptLight, SaysWhatIsWrong) {
  EXPECT_EQ(complaint(bytes_), "");
  EXPECT_THAT(complaint(""), HasSubstr("is truncated"));
  EXPECT_THAT(complaint(std::string(bytes_.size(), 'x')), HasSubstr("is no light of meshes"));
  EXPECT_THAT(complaint(bytes_ + "x"), HasSubstr("has bytes after its end"));
  EXPECT_THAT(complaint(bytes_, kKey + 1), HasSubstr("other meshes"));
  EXPECT_THAT(complaint(bytes_, kKey, {3, 5}), HasSubstr("other meshes"));
  EXPECT_THAT(complaint(bytes_, kKey, {5, 0, 3}), HasSubstr("other meshes"));
  std::string newer = bytes_;
  newer[8] = 2;
  EXPECT_THAT(complaint(newer), HasSubstr("another format version"));
  EXPECT_THROW((void)readKeptLight(cache_.path() / "missing", kKey, {}), EnvironmentError);
}

TEST_F(KeptLight, RefusesEveryPartOfIt) {
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

TEST_F(KeptLight, RefusesLightThatIsNoNumberThoughItsChecksumIsRight) {
  Light light = light_;
  light[2][4].w = std::numeric_limits<float>::quiet_NaN();
  writeKeptLight(file_, kKey, light);
  EXPECT_THROW((void)readKeptLight(file_, kKey, std::vector<std::size_t>{3, 0, 5}), KeptLightError);
}

}  // namespace
}  // namespace grove::objects::mesh
