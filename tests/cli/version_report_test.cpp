#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <vector>

#include "base/version.h"
#include "cli/program.h"

namespace grove::cli {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;
using testing::StartsWith;

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(VersionReport, PrintsOneFactPerLine) {
  const Outcome outcome = grove("--version", false);
  EXPECT_EQ(outcome.exit, 0);
  const auto lines = linesOf(outcome.output);
  ASSERT_EQ(lines.size(), 4U) << outcome.output;
  EXPECT_EQ(lines[0], "grove " + std::string(version()));
  EXPECT_THAT(lines[0], MatchesRegex("grove [0-9]+\\.[0-9]+\\.[0-9]+"));
  EXPECT_THAT(lines[1], MatchesRegex("SIMD: [a-z0-9_]+( \\(this processor also has [a-z0-9_, ]+\\))?"));
  EXPECT_THAT(lines[2], MatchesRegex("GL: .+, GL [0-9.]+, by .+, [0-9.]+.*"));
  EXPECT_THAT(lines[3], MatchesRegex("codecs: (h264 \\((Grove|OpenH264) [0-9.]+\\), )+jpeg \\(libjpeg-turbo [0-9.]+\\)"));
}

TEST(VersionReport, ReportsTheForcedSimdTarget) {
  const std::string min = linesOf(grove("--version", false).output).at(1);
  const std::string name = min.substr(min.find_last_of(", ") + 1);
  const std::string target = name.substr(0, name.find(')'));
  const Outcome forced = shell("GROVE_SIMD=" + target + " " GROVE_BINARY " --version");
  EXPECT_THAT(linesOf(forced.output).at(1), StartsWith("SIMD: " + target));

  const Outcome unknown = shell("GROVE_SIMD=abacus " GROVE_BINARY " --version 2>&1");
  EXPECT_EQ(unknown.exit, 1);
  EXPECT_EQ(linesOf(unknown.output).size(), 1U) << unknown.output;
  EXPECT_THAT(unknown.output, HasSubstr("abacus"));
}

}  // namespace
}  // namespace grove::cli
