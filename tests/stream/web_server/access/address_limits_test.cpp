#include "stream/web_server/access/address_limits.h"

#include <gtest/gtest.h>

#include <vector>

namespace grove::stream {
namespace {

constexpr AddressAllowance kAllowance{.sockets = 3, .visitors = 2, .socketsPerSecond = 2.0, .burst = 5.0};

TEST(AddressLimits, CountsOpenSockets) {
  AddressLimits limits(kAllowance);
  std::vector<AddressLimits::Ticket> tickets;
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(limits.allows("192.0.2.1", 10.0 * i));
    tickets.push_back(limits.socket("192.0.2.1"));
  }
  EXPECT_FALSE(limits.allows("192.0.2.1", 50.0));
  EXPECT_TRUE(limits.allows("192.0.2.2", 50.0));
  tickets.pop_back();
  EXPECT_TRUE(limits.allows("192.0.2.1", 60.0));
}

TEST(AddressLimits, LimitsNewSocketsPerSecond) {
  AddressLimits limits(kAllowance);
  int welcome = 0;
  for (int i = 0; i < 1000; ++i) welcome += limits.allows("192.0.2.1", 100.0 + 0.001 * i) ? 1 : 0;
  EXPECT_EQ(welcome, 5) << "the burst; who goes on trying gets no more";
  EXPECT_TRUE(limits.allows("192.0.2.1", 103.0)) << "who stops for a while is welcome again";
}

TEST(AddressLimits, CountsVisitors) {
  AddressLimits limits(kAllowance);
  auto one = limits.visitor("192.0.2.1");
  const auto two = limits.visitor("192.0.2.1");
  EXPECT_TRUE(one && two);
  EXPECT_FALSE(limits.visitor("192.0.2.1"));
  EXPECT_TRUE(limits.visitor("192.0.2.2"));
  one.reset();
  EXPECT_TRUE(limits.visitor("192.0.2.1"));
}

TEST(AddressLimits, GroupsIpv6AddressesByNetwork) {
  EXPECT_EQ(guestOf("2001:db8:1:2::1"), guestOf("2001:db8:1:2:ffff:ffff:ffff:ffff"));
  EXPECT_NE(guestOf("2001:db8:1:2::1"), guestOf("2001:db8:1:3::1"));
  EXPECT_EQ(guestOf("::ffff:192.0.2.1"), "192.0.2.1");
  EXPECT_EQ(guestOf("fe80::1%eth0"), guestOf("fe80::2"));
  for (const char* own : {"127.0.0.1", "::1", "::ffff:127.0.0.1"}) EXPECT_EQ(guestOf(own), "") << own;
}

TEST(AddressLimits, LoopbackIsUnlimited) {
  AddressLimits limits(kAllowance);
  std::vector<AddressLimits::Ticket> tickets;
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(limits.allows("127.0.0.1", 1.0));
    tickets.push_back(limits.socket("127.0.0.1"));
    tickets.push_back(limits.visitor("127.0.0.1"));
    ASSERT_TRUE(tickets.back());
  }
}

TEST(AddressLimits, TicketsMayOutliveTheLimits) {
  AddressLimits::Ticket ticket;
  {
    AddressLimits limits(kAllowance);
    ticket = limits.socket("192.0.2.1");
    limits.sweep(1.0);
  }
  ticket.reset();
}

}  // namespace
}  // namespace grove::stream
