#include "base/plain_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <fstream>
#include <limits>

#include "base/error.h"

namespace grove {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class PlainFileTest : public testing::Test {
 protected:
  PlainFileTest() {
    std::string name = (std::filesystem::temp_directory_path() / "grove_plain_XXXXXX").string();
    folder_ = mkdtemp(name.data());
    std::ofstream(folder_ / "five") << "01234";
  }
  ~PlainFileTest() override { std::filesystem::remove_all(folder_); }

  /// What opening it says.
  static std::string complaint(const std::filesystem::path& file, std::uint64_t maxBytes = 100) {
    try {
      const PlainFile opened(file, "name another", maxBytes);
    } catch (const EnvironmentError& e) {
      return e.what();
    }
    return "";
  }

  std::filesystem::path folder_;
};

TEST_F(PlainFileTest, ReadsInPiecesToTheEnd) {
  PlainFile file(folder_ / "five", "", 5);
  EXPECT_EQ(file.bytes(), 5U);
  std::array<char, 2> two{};
  EXPECT_EQ(file.read(two), 2U);
  EXPECT_EQ(two[1], '1');
  EXPECT_EQ(file.readAll(), "234");
  EXPECT_EQ(file.read(two), 0U);
}

TEST_F(PlainFileTest, RefusesPipesAndDevices) {
  ASSERT_EQ(mkfifo((folder_ / "fifo").c_str(), 0600), 0);
  for (const std::filesystem::path& file : {std::filesystem::path("/dev/zero"), folder_, folder_ / "fifo"}) {
    EXPECT_THAT(complaint(file),
                AllOf(StartsWith(file.string() + ": "), HasSubstr("is not a regular file"), HasSubstr("name another")));
  }
}

TEST_F(PlainFileTest, RefusesMissingAndOversizedFiles) {
  EXPECT_THAT(complaint(folder_ / "six"), AllOf(HasSubstr("No such file"), HasSubstr("name another")));
  EXPECT_EQ(complaint(folder_ / "five", 5), "");
  EXPECT_THAT(complaint(folder_ / "five", 4), AllOf(HasSubstr("has 5 bytes"), HasSubstr("maximum is 4")));
}

}  // namespace
}  // namespace grove
