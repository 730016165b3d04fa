#include "stream/web_server/access/eviction.h"

#include <gtest/gtest.h>

#include <array>

namespace grove::stream {
namespace {

TEST(Eviction, NoCandidates) { EXPECT_FALSE(chooseEvicted({})); }

TEST(Eviction, TakesTheOldest) {
  const std::array<Evictable, 3> sockets{{{"a", 5.0}, {"b", 3.0}, {"c", 4.0}}};
  EXPECT_EQ(chooseEvicted(sockets), 1U);
}

/// Else a newcomer, whose request is still on its way, would go before hundreds that came after.
TEST(Eviction, TakesFromTheLargestOwner) {
  const std::array<Evictable, 4> sockets{{{"newcomer", 1.0}, {"many", 3.0}, {"many", 2.0}, {"many", 4.0}}};
  EXPECT_EQ(chooseEvicted(sockets), 2U);
}

TEST(Eviction, TakesBusySocketsLast) {
  const std::array<Evictable, 4> some{{{"a", 1.0, true}, {"a", 2.0, true}, {"b", 9.0}, {"a", 3.0, true}}};
  EXPECT_EQ(chooseEvicted(some), 2U);
  const std::array<Evictable, 3> all{{{"b", 1.0, true}, {"a", 2.0, true}, {"a", 3.0, true}}};
  EXPECT_EQ(chooseEvicted(all), 1U);
}

/// A proxy's sockets are many guests', not one's.
TEST(Eviction, SocketsWithoutOwnerCountAlone) {
  const std::array<Evictable, 5> sockets{{{"", 1.0}, {"", 2.0}, {"", 3.0}, {"many", 5.0}, {"many", 4.0}}};
  EXPECT_EQ(chooseEvicted(sockets), 4U);
}

}  // namespace
}  // namespace grove::stream
