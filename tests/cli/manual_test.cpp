#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>

#include "cli/help.h"

namespace grove::cli {
namespace {

using testing::ContainerEq;

/// The part OPTIONS of the man page: for each command its options, and what is written about each.
using Manual = std::map<std::string, std::map<std::string, std::string>>;

std::string withoutEscapes(const std::string& line) {
  return std::regex_replace(std::regex_replace(line, std::regex(R"(\\-)"), "-"), std::regex(R"(\\f[A-Z])"), "");
}

Manual readManual() {
  const std::regex longOption(R"(--[a-z][a-z0-9.-]*[a-z0-9])");
  Manual manual;
  std::ifstream file(GROVE_MANUAL);
  std::string part;
  std::string command;
  std::string* about = nullptr;
  bool isTag = false;
  for (std::string line; std::getline(file, line);) {
    line = withoutEscapes(line);
    if (line.starts_with(".SH ")) part = line.substr(4);
    if (part != "OPTIONS") continue;
    if (line.starts_with(".SS grove")) {
      command = line.size() > 10 ? line.substr(10) : "";
      manual[command];
      about = nullptr;
    } else if (std::smatch found; isTag && std::regex_search(line, found, longOption)) {
      about = &manual[command][found[0]];
    } else if (isTag) {
      about = nullptr;  // a positional argument
    }
    isTag = line == ".TP";
    if (about != nullptr) *about += line + "\n";
  }
  return manual;
}

TEST(ManualPage, HasEveryCommandAndNoOther) {
  std::vector<std::string> reported;
  for (const auto& [command, options] : readManual()) reported.push_back(command);
  EXPECT_THAT(allCommands(), testing::UnorderedElementsAreArray(reported));
}

TEST(ManualPage, HasEveryOptionAndNoOther) {
  Manual manual = readManual();
  for (const std::string& command : allCommands()) {
    std::set<std::string> real;
    for (const auto& [name, option] : helpOf(command).options) real.insert(name);
    EXPECT_EQ(real.count("--help"), 1U) << command;
    if (!command.empty()) real.erase("--help");  // told once
    std::set<std::string> reported;
    for (const auto& [name, about] : manual[command]) reported.insert(name);
    EXPECT_THAT(reported, ContainerEq(real)) << "grove " << command;
  }
}

TEST(ManualPage, ReportsDefaultsAndValuesAsHelpDoes) {
  Manual manual = readManual();
  int defaults = 0;
  int values = 0;
  for (const std::string& command : allCommands()) {
    for (const auto& [name, option] : helpOf(command).options) {
      std::string about = manual[command][name];
      if (!option.standard.empty()) {
        ++defaults;
        EXPECT_THAT(about, testing::HasSubstr("Default: " + option.standard + ".\n")) << command << " " << name;
      }
      for (const std::string& value : option.values) {
        ++values;
        EXPECT_TRUE(std::regex_search(about, std::regex("\\b" + value + "\\b"))) << command << " " << name << value;
      }
    }
  }
  EXPECT_GT(defaults, 20);
  EXPECT_GT(values, 10);
}

}  // namespace
}  // namespace grove::cli
