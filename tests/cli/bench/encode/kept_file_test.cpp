#include "cli/bench/encode/kept_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include "base/error.h"

namespace grove::cli {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

std::filesystem::path filmPath() {
  return std::filesystem::temp_directory_path() / ("grove_film_" + std::to_string(getpid()) + ".y4m");
}

std::shared_ptr<raster::YuvImage> numberedFrame(int width, int height, std::uint8_t first) {
  raster::ImagePool images;
  auto frame = raster::acquireYuv(images, {0, 0, width, height});
  std::ranges::generate(frame->bytes, [&] { return first++; });
  return frame;
}

// Fault: other programs read shifted frames, or take the range for a narrow one.
TEST(KeptFilm, HoldsEachFrameBehindItsMark) {
  const auto path = filmPath();
  KeptFilm film(path, {4, 2});
  film.add(*numberedFrame(4, 2, 'a'));
  film.add(*numberedFrame(4, 2, 'A'));
  EXPECT_FALSE(std::filesystem::exists(path)) << "not before it is complete";
  film.commit();
  std::ifstream file(path, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  std::filesystem::remove(path);
  EXPECT_EQ(text,
            "YUV4MPEG2 W4 H2 F30:1 Ip A1:1 C420jpeg XCOLORRANGE=FULL\n"
            "FRAME\nabcdefghijkl"
            "FRAME\nABCDEFGHIJKL");
}

TEST(KeptFilm, NamesTheFileThatCannotBeWritten) {
  EXPECT_THAT(
      [] {
        KeptFilm("no/such/folder/frames.y4m", {4, 2});
      },
      ThrowsMessage<EnvironmentError>(HasSubstr("no/such/folder/frames.y4m")));
}

}  // namespace
}  // namespace grove::cli
