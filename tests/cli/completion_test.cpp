#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "cli/help.h"
#include "cli/program.h"

namespace grove::cli {
namespace {

using testing::ContainerEq;
using testing::IsEmpty;

/// What bash offers behind `grove ARGUMENTS`, the last of which is being typed.
std::set<std::string> offered(const std::string& arguments, const std::string& typed) {
  const Outcome outcome = shell(". " GROVE_BASH_COMPLETION "; COMP_WORDS=(" GROVE_BINARY " " + arguments + " '" +
                                typed + "'); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _grove grove '" + typed +
                                "' \"${COMP_WORDS[COMP_CWORD - 1]}\"; printf '%s\\n' \"${COMPREPLY[@]}\"");
  std::set<std::string> words;
  std::istringstream lines(outcome.output);
  for (std::string line; std::getline(lines, line);) words.insert(line);
  words.erase("");
  return words;
}

TEST(BashCompletion, OffersEveryCommandAndEveryOption) {
  for (const std::string& command : allCommands()) {
    const Help help = helpOf(command);
    EXPECT_THAT(offered(command, ""), ContainerEq(help.commands)) << command;
    std::set<std::string> options;
    for (const auto& [name, option] : help.options) options.insert(name);
    EXPECT_THAT(offered(command, "--"), ContainerEq(options)) << command;
  }
}

TEST(BashCompletion, OffersOptionValues) {
  EXPECT_THAT(offered("serve --gl", ""), ContainerEq(std::set<std::string>{"auto", "egl", "osmesa"}));
  EXPECT_THAT(offered("bake --json --plant", "b"), ContainerEq(std::set<std::string>{"birch"}));
  EXPECT_THAT(offered("bake model.gltf --detail", ""), ContainerEq(std::set<std::string>{"full", "small"}));
}

TEST(BashCompletion, LeavesFilesToTheShell) {
  EXPECT_THAT(offered("serve --scene", ""), IsEmpty());
  EXPECT_THAT(offered("serve --fps", ""), IsEmpty());
  EXPECT_THAT(offered("bake -o", ""), IsEmpty());
  EXPECT_THAT(offered("bake", "mod"), IsEmpty());
}

TEST(BashCompletion, ContinuesAfterValuesAndFlags) {
  EXPECT_THAT(offered("serve --fps 30", "--rais"), ContainerEq(std::set<std::string>{"--raise-quality"}));
  EXPECT_THAT(offered("serve --raise-quality", "--sc"), ContainerEq(std::set<std::string>{"--scene"}));
}

}  // namespace
}  // namespace grove::cli
