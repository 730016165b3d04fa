#include "stream/web_server/pages/content_coding.h"

#include <gtest/gtest.h>

#include <string>

namespace grove::stream {
namespace {

constexpr int kFull = 1000;

TEST(ContentCoding, AcceptsNamedCodings) {
  EXPECT_EQ(codingWeight("gzip, deflate, br", "gzip"), kFull);
  EXPECT_EQ(codingWeight("gzip, deflate, br", "br"), kFull);
  EXPECT_EQ(codingWeight("deflate", "gzip"), 0);
  EXPECT_EQ(codingWeight("GZip", "gzip"), kFull) << "names have no case";
  EXPECT_EQ(codingWeight("x-gzip", "gzip"), kFull) << "its old name";
  EXPECT_EQ(codingWeight("gzipped, agzip, brotli", "gzip"), 0) << "a part of another name";
  EXPECT_EQ(codingWeight("gzipped, agzip, brotli", "br"), 0);
}

TEST(ContentCoding, RespectsWeights) {
  EXPECT_EQ(codingWeight("gzip;q=0.5", "gzip"), 500);
  EXPECT_EQ(codingWeight("gzip \t;\t Q=0.25 ,br", "gzip"), 250);
  EXPECT_EQ(codingWeight("gzip;q=0.001", "gzip"), 1);
  EXPECT_EQ(codingWeight("gzip;q=1.000", "gzip"), kFull);
  EXPECT_EQ(codingWeight("gzip;q=1.", "gzip"), kFull);
  for (const char* refused : {"gzip;q=0", "gzip;q=0.", "gzip;q=0.0", "gzip;q=0.000", "br, gzip;q=0", "gzip;q=0, *"}) {
    EXPECT_EQ(codingWeight(refused, "gzip"), 0) << refused;
  }
}

TEST(ContentCoding, IdentityIsAcceptedUnlessRefused) {
  EXPECT_GT(codingWeight("", "identity"), 0);
  EXPECT_GT(codingWeight("deflate", "identity"), 0);
  EXPECT_LT(codingWeight("gzip;q=0.1", "identity"), codingWeight("gzip;q=0.1", "gzip")) << "but not gladly";
  EXPECT_EQ(codingWeight("identity, gzip;q=0.5", "identity"), kFull);
  EXPECT_EQ(codingWeight("identity;q=0", "identity"), 0);
  EXPECT_EQ(codingWeight("gzip, *;q=0", "identity"), 0);
  EXPECT_EQ(codingWeight("", "gzip"), 0);
}

TEST(ContentCoding, StarMatchesUnnamedCodings) {
  EXPECT_EQ(codingWeight("*", "br"), kFull);
  EXPECT_EQ(codingWeight("*;q=0.5, br", "br"), kFull);
  EXPECT_EQ(codingWeight("br, *;q=0.5", "gzip"), 500);
  EXPECT_EQ(codingWeight("*;q=0", "gzip"), 0);
}

/// Read wrongly, a client would get what it cannot unpack.
TEST(ContentCoding, IgnoresMalformedParts) {
  for (const char* bad : {"gzip;q=2",
                          "gzip;q=1.001",
                          "gzip;q=-1",
                          "gzip;q=0.0001",
                          "gzip;q=",
                          "gzip;q",
                          "gzip;",
                          "gzip;;q=1",
                          "gzip;q=.5",
                          "gzip;q=01",
                          "gzip;q=0,5",
                          "gzip;q=0x1",
                          "gzip;q=1;q=0",
                          "gzip;level=9",
                          "gzip q=1",
                          ";q=1",
                          ",",
                          ",,;,",
                          "=",
                          "gzip\n",
                          "gzi",
                          "g",
                          "\xff\xfe",
                          "gzip;q=nan",
                          "gzip;q=1e0",
                          "gzip;q=0.5.5",
                          "gzip/1",
                          "\"gzip\""}) {
    EXPECT_EQ(codingWeight(bad, "gzip"), 0) << bad;
    EXPECT_GT(codingWeight(bad, "identity"), 0) << bad;
  }
  EXPECT_EQ(codingWeight(",gzip;q=x,, ,gzip;q=0.5,", "gzip"), 500) << "nor do they spoil the others";
  EXPECT_EQ(codingWeight(std::string(100'000, ','), "gzip"), 0);
}

}  // namespace
}  // namespace grove::stream
