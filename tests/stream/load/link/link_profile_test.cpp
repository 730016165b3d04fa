#include "stream/load/link/link_profile.h"

#include <gmock/gmock.h>

namespace grove::stream {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

LinkProfile profileOf(std::string_view text) {
  const ParsedLinkProfile parsed = parseLinkProfile(text);
  if (const auto* fault = std::get_if<std::string>(&parsed)) ADD_FAILURE() << text << ": " << *fault;
  return std::holds_alternative<LinkProfile>(parsed) ? std::get<LinkProfile>(parsed) : LinkProfile{};
}

TEST(LinkProfile, ParsesRateAndRoundTrip) {
  const LinkProfile profile = profileOf("5mbit,80ms");
  ASSERT_EQ(profile.downstream.size(), 1U);
  EXPECT_EQ(profile.downstream.front().bitsPerSecond, 5e6);
  ASSERT_EQ(profile.upstream.size(), 1U) << "upstream gets the same";
  EXPECT_EQ(profile.upstream.front().bitsPerSecond, 5e6);
  EXPECT_EQ(profile.roundTrip, 80ms);
  EXPECT_EQ(profile.jitter, 0ms);
  EXPECT_EQ(profile.stallEvery, 0ms);
}

TEST(LinkProfile, ParsesOptionsInAnyOrder) {
  const LinkProfile profile =
      profileOf("5mbit@0s/500kbit@10s/1.5gbit@12.5s,0ms,seed=7,stall=1s/10s,up=100kbit,jitter=2.5ms");
  ASSERT_EQ(profile.downstream.size(), 3U);
  EXPECT_EQ(profile.downstream[1].from, 10s);
  EXPECT_EQ(profile.downstream[1].bitsPerSecond, 5e5);
  EXPECT_EQ(profile.downstream[2].from, 12500ms);
  EXPECT_EQ(profile.downstream[2].bitsPerSecond, 1.5e9);
  EXPECT_EQ(profile.upstream.front().bitsPerSecond, 1e5);
  EXPECT_EQ(profile.jitter, 2500us);
  EXPECT_EQ(profile.stall, 1s);
  EXPECT_EQ(profile.stallEvery, 10s);
  EXPECT_EQ(profile.seed, 7U);
}

/// Fault: a percentage taken for a share.
TEST(LinkProfile, ParsesLossesInPercent) {
  EXPECT_EQ(profileOf("5mbit,80ms").loss, 0.0);
  EXPECT_DOUBLE_EQ(profileOf("5mbit,80ms,loss=0.5").loss, 0.005);
  EXPECT_DOUBLE_EQ(profileOf("5mbit,80ms,jitter=1ms,loss=20,seed=3").loss, 0.2);
  EXPECT_EQ(profileOf("5mbit,80ms,loss=0").loss, 0.0);
}

TEST(LinkProfile, RefusesMalformedText) {
  for (const char* bad : {"",
                          ",",
                          "5mbit",
                          "5mbit,",
                          "80ms,5mbit",
                          "5,80ms",
                          "5mbit,80",
                          "5mbits,80ms",
                          "5 mbit,80ms",
                          "+5mbit,80ms",
                          "fast,80ms",
                          "0mbit,80ms",
                          "-5mbit,80ms",
                          "999bit,80ms",
                          "0.9kbit,80ms",
                          "10.1gbit,80ms",
                          "1e300gbit,80ms",
                          "1e999mbit,80ms",
                          "nanmbit,80ms",
                          "infmbit,80ms",
                          "5mbit,-1ms",
                          "5mbit,10.1s",
                          "5mbit,nans",
                          "5mbit@1s,80ms",
                          "5mbit@,80ms",
                          "5mbit/,80ms",
                          "5mbit/1mbit,80ms",
                          "5mbit@0s/1mbit@2s/3mbit@2s,80ms",
                          "5mbit@0s/1mbit@-2s,80ms",
                          "5mbit@0s/1mbit@3601s,80ms",
                          "5mbit,80ms,",
                          "5mbit,80ms,,jitter=1ms",
                          "5mbit,80ms,jitter",
                          "5mbit,80ms,jitter=",
                          "5mbit,80ms,jitter=11s",
                          "5mbit,80ms,stall=1s",
                          "5mbit,80ms,stall=0s/1s",
                          "5mbit,80ms,stall=1s/1s",
                          "5mbit,80ms,stall=1ms/2ms",
                          "5mbit,80ms,stall=1s/3601s",
                          "5mbit,80ms,up=",
                          "5mbit,80ms,up=0mbit",
                          "5mbit,80ms,seed=x",
                          "5mbit,80ms,seed=-1",
                          "5mbit,80ms,seed=1.5",
                          "5mbit,80ms,loss",
                          "5mbit,80ms,loss=",
                          "5mbit,80ms,loss=-1",
                          "5mbit,80ms,loss=20.1",
                          "5mbit,80ms,loss=101",
                          "5mbit,80ms,loss=x",
                          "5mbit,80ms,loss=nan",
                          "5mbit,80ms,loss=1%"}) {
    const ParsedLinkProfile parsed = parseLinkProfile(bad);
    ASSERT_TRUE(std::holds_alternative<std::string>(parsed)) << bad;
    EXPECT_THAT(std::get<std::string>(parsed), Not(IsEmpty())) << bad;
    EXPECT_THAT(std::get<std::string>(parsed), Not(HasSubstr("\n"))) << bad;
  }
  std::string many = "1mbit";
  for (int i = 1; i < 2000; ++i) many += "/1mbit@" + std::to_string(i) + "s";
  EXPECT_TRUE(std::holds_alternative<std::string>(parseLinkProfile(many + ",0ms")));
}

TEST(LinkProfile, ReportsTheFirstFaultWithItsText) {
  EXPECT_THAT(std::get<std::string>(parseLinkProfile("fast,slow")), HasSubstr("'fast'"));
  EXPECT_THAT(std::get<std::string>(parseLinkProfile("5mbit,slow")), HasSubstr("'slow'"));
  EXPECT_EQ(std::get<std::string>(parseLinkProfile("5mbit,80ms,loss=101")),
            "a loss is 0 to 20 percent, as in loss=0.5, unlike 'loss=101'");
}

}  // namespace
}  // namespace grove::stream
