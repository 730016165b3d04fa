#include "stream/web_server/access/forwarded.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace grove::stream {
namespace {

std::vector<AddressRange> ranges(const std::vector<const char*>& texts) {
  std::vector<AddressRange> all;
  for (const char* text : texts) all.push_back(AddressRange::parse(text).value());
  return all;
}

TEST(AddressRange, ContainsAddressesWithItsPrefix) {
  const auto net = AddressRange::parse("10.1.128.0/17").value();
  EXPECT_TRUE(net.contains("10.1.128.0"));
  EXPECT_TRUE(net.contains("10.1.255.255"));
  EXPECT_TRUE(net.contains("::ffff:10.1.200.1")) << "as a listener of both kinds sees it";
  EXPECT_FALSE(net.contains("10.1.127.255"));
  EXPECT_FALSE(net.contains("::10.1.128.0"));
  const auto one = AddressRange::parse("192.0.2.7").value();
  EXPECT_TRUE(one.contains("192.0.2.7"));
  EXPECT_FALSE(one.contains("192.0.2.6"));
  const auto six = AddressRange::parse("2001:db8::/33").value();
  EXPECT_TRUE(six.contains("2001:db8:7fff::1"));
  EXPECT_FALSE(six.contains("2001:db8:8000::1"));
  EXPECT_TRUE(AddressRange::parse("fe80::1").value().contains("fe80::1%eth0"));
  EXPECT_TRUE(AddressRange::parse("0.0.0.0/0").value().contains("203.0.113.1"));
  EXPECT_FALSE(AddressRange::parse("0.0.0.0/0").value().contains("2001:db8::1"));
  EXPECT_TRUE(AddressRange::parse("::/0").value().contains("2001:db8::1"));
  EXPECT_FALSE(AddressRange::parse("::/0").value().contains("no address"));
}

TEST(AddressRange, ParsesOrRefuses) {
  for (const char* bad :
       {"", "/", "10.0.0.0/", "10.0.0.0/33", "10.0.0.0/-1", "10.0.0.0/8x", "10.0.0.0/ 8", "10.0.0/8", "10.0.0.256",
        "::1/129", "::g", "[::1]", "localhost", "10.0.0.1:80", "10.0.0.0/8/8", "fe80::1%eth0", " 10.0.0.1"}) {
    EXPECT_FALSE(AddressRange::parse(bad)) << bad;
  }
}

TEST(Forwarded, UsesTheRightmostUntrustedAddress) {
  const auto proxies = ranges({"127.0.0.1", "10.0.0.0/8", "fd00::/8"});
  const auto behind = [&](std::string_view list) { return visitorBehind("127.0.0.1", list, proxies); };
  EXPECT_EQ(behind("203.0.113.7"), "203.0.113.7");
  EXPECT_EQ(behind("198.51.100.1, 203.0.113.7"), "203.0.113.7") << "anybody can write what stands before";
  EXPECT_EQ(behind("127.0.0.1, 203.0.113.7"), "203.0.113.7");
  EXPECT_EQ(behind("198.51.100.1,203.0.113.7 ,\t10.1.2.3, fd00::5"), "203.0.113.7") << "through three proxies";
  EXPECT_EQ(behind("10.9.9.9, 10.1.2.3"), "10.9.9.9") << "somebody of the proxies' own network";
  EXPECT_EQ(behind("203.0.113.7:51000"), "203.0.113.7");
  EXPECT_EQ(behind("[2001:db8::9]:51000"), "2001:db8::9");
  EXPECT_EQ(behind("[2001:db8::9]"), "2001:db8::9");
  EXPECT_EQ(behind("2001:db8::9"), "2001:db8::9");
  EXPECT_EQ(behind("  203.0.113.7  "), "203.0.113.7");
}

TEST(Forwarded, StopsAtMalformedAddresses) {
  const auto proxies = ranges({"127.0.0.1", "10.0.0.0/8"});
  const auto behind = [&](std::string_view list) { return visitorBehind("127.0.0.1", list, proxies); };
  for (const char* nonsense :
       {"", ",", " ", "unknown", "203.0.113.7,", "203.0.113.7, ", "203.0.113.7, unknown", "203.0.113.7, 256.1.1.1",
        "203.0.113.7, [::1", "203.0.113.7, [::1]x", "203.0.113.7, 1.2.3.4:5:6", "203.0.113.7; 1", "'203.0.113.7'",
        "203.0.113.7, %", "203.0.113.7, []", "203.0.113.7, :", "203.0.113.7 198.51.100.1"}) {
    EXPECT_EQ(behind(nonsense), "127.0.0.1") << nonsense;
  }
  EXPECT_EQ(behind("203.0.113.7, unknown, 10.0.0.5"), "10.0.0.5") << "the last one that is known";
  EXPECT_EQ(behind(std::string_view("203.0.113.7, 1.1.1.1\0x", 22)), "127.0.0.1");
}

TEST(Forwarded, IsIgnoredFromUntrustedPeers) {
  EXPECT_EQ(visitorBehind("198.51.100.1", "203.0.113.7", ranges({"127.0.0.1"})), "198.51.100.1");
  EXPECT_EQ(visitorBehind("127.0.0.1", "203.0.113.7", {}), "127.0.0.1");
}

/// Of whatever length: no answer but an address that stands there or the proxy's, and no time that grows as its square.
TEST(Forwarded, MalformedHeaders) {
  const auto proxies = ranges({"127.0.0.1", "10.0.0.0/8", "::/1"});
  std::mt19937 random(7);
  constexpr std::string_view kLetters = "0123456789abcf.:,[] %/x\t\xFF";
  constexpr std::array<std::string_view, 7> kPieces = {"10.0.0.1", "203.0.113.7",   ", ",     ",",
                                                       "::1",      "[fe80::1%x]:9", "unknown"};
  for (int i = 0; i < 20'000; ++i) {
    std::string list;
    const std::size_t pieces = random() % 12;
    for (std::size_t k = 0; k < pieces; ++k) {
      if (random() % 3 == 0) {
        list += kLetters[random() % kLetters.size()];
      } else {
        list += kPieces[random() % kPieces.size()];
      }
    }
    const std::string visitor = visitorBehind("127.0.0.1", list, proxies);
    EXPECT_TRUE(visitor == "127.0.0.1" || list.find(visitor) != std::string::npos) << list;
    EXPECT_TRUE(parseAddress(visitor)) << list;
  }
  std::string many;
  while (many.size() < 100'000) many += "10.0.0.1, ";
  EXPECT_EQ(visitorBehind("127.0.0.1", "203.0.113.7, " + many + "10.0.0.1", proxies), "203.0.113.7");
  EXPECT_EQ(visitorBehind("127.0.0.1", std::string(100'000, ','), proxies), "127.0.0.1");
  EXPECT_EQ(visitorBehind("127.0.0.1", std::string(100'000, '1'), proxies), "127.0.0.1");
  EXPECT_EQ(visitorBehind("127.0.0.1", std::string(100'000, '['), proxies), "127.0.0.1");
}

TEST(Forwarded, LastEntryIsFromTheNearestProxy) {
  EXPECT_EQ(lastEntry("evil.example, grove.example "), "grove.example");
  EXPECT_EQ(lastEntry("grove.example"), "grove.example");
  EXPECT_EQ(lastEntry(""), "");
  EXPECT_EQ(lastEntry("a,"), "");
  for (const char* secure : {"https", "HTTPS", "wss"}) EXPECT_TRUE(isSecureScheme(secure)) << secure;
  for (const char* plain : {"", "http", "ws", "https,", "httpss"}) EXPECT_FALSE(isSecureScheme(plain)) << plain;
}

}  // namespace
}  // namespace grove::stream
