#include "cli/bench/warp/film.h"

#include <gmock/gmock.h>

#include <cstddef>
#include <fstream>
#include <iterator>
#include <vector>

#include "base/error.h"
#include "cli/prepare/temporary_folder.h"

namespace grove::cli {
namespace {

using testing::StartsWith;

constexpr std::uint32_t kWhite = 0xFFFFFFFFU;
constexpr std::uint32_t kBlack = 0xFF000000U;

// Faults: a header that players refuse; views that change sides, or are cut; frames of another length.
TEST(Film, ShowsTwoViewsSideBySide) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "film.y4m").string();
  const std::vector<std::uint32_t> white(std::size_t{16} * 8, kWhite);
  std::vector<std::uint32_t> striped(white.size(), kBlack);
  for (std::size_t i = 0; i < striped.size(); i += 2) striped[i] = kWhite;
  {
    Film film(file, {16, 8});
    film.add(white, striped);
    film.add(striped, white);
  }
  std::ifstream in(file, std::ios::binary);
  const std::string all(std::istreambuf_iterator<char>(in), {});
  const std::string header = "YUV4MPEG2 W16 H4 F60:1 Ip A1:1 C420jpeg XCOLORRANGE=FULL\n";
  ASSERT_THAT(all, StartsWith(header + "FRAME\n"));
  constexpr std::size_t kFrame = 6 + 16 * 4 * 3 / 2;
  ASSERT_EQ(all.size(), header.size() + 2 * kFrame);
  const auto luma = [&](std::size_t frame, std::size_t x) {
    return static_cast<unsigned char>(all[header.size() + frame * kFrame + 6 + x]);
  };
  EXPECT_EQ(luma(0, 0), 255);
  EXPECT_EQ(luma(0, 7), 255);
  EXPECT_NEAR(luma(0, 8), 128, 1) << "the mean of four pixels";
  EXPECT_NEAR(luma(1, 0), 128, 1);
  EXPECT_EQ(luma(1, 15), 255);
}

// Fault: a film that nobody gets, and no word about it.
TEST(Film, SaysWhenItCannotBeWritten) { EXPECT_THROW(Film("/nowhere/film.y4m", {16, 8}), EnvironmentError); }

}  // namespace
}  // namespace grove::cli
