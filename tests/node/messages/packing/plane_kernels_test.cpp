#include "node/messages/packing/plane_kernels.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "each_target.h"

namespace grove::node {
namespace {

TEST(PlaneKernels, SplitAndJoinAnyNumberOfWords) {
  std::mt19937 random(5);
  tests::onEachTarget([&] {
    for (std::size_t count = 0; count < 300; ++count) {
      std::vector<std::uint32_t> words(count);
      for (std::uint32_t& word : words) word = random();
      std::vector<std::uint8_t> planes(4 * count);
      splitPlanes(words.data(), count, planes.data());
      for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t byte = 0; byte < 4; ++byte) {
          ASSERT_EQ(planes[byte * count + i], words[i] >> 8 * byte & 0xFFU) << count << " words";
        }
      }
      std::vector<std::uint32_t> again(count);
      joinPlanes(planes.data(), count, again.data());
      ASSERT_EQ(again, words);
    }
  });
}

}  // namespace
}  // namespace grove::node
