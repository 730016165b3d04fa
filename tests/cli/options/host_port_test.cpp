#include "cli/options/host_port.h"

#include <gtest/gtest.h>

namespace grove::cli {
namespace {

TEST(HostPort, ParsesNamesAndAddresses) {
  EXPECT_EQ(parseHostPort("127.0.0.1:8080")->port, 8080);
  EXPECT_EQ(parseHostPort("localhost:0")->host, "localhost");
  EXPECT_EQ(parseHostPort("[::1]:80")->host, "::1");
  EXPECT_EQ(parseHostPort("0.0.0.0:65535")->port, 65535);
}

TEST(HostPort, RefusesMalformedText) {
  for (const char* text :
       {"", ":", "8080", ":8080", "host:", "host:x", "host:-1", "host:65536", "host:80x", "::1:80"}) {
    EXPECT_FALSE(parseHostPort(text).has_value()) << text;
  }
}

}  // namespace
}  // namespace grove::cli
