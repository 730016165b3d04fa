#include "cli/help.h"

#include <regex>
#include <sstream>

#include "cli/program.h"

namespace grove::cli {
namespace {

HelpOption parseOption(const std::string& description) {
  HelpOption option;
  std::smatch found;
  if (std::regex_search(description, found, std::regex(R"(^ \S+?.*?=\[?([^\s\]]+))"))) option.standard = found[1];
  if (std::regex_search(description, found, std::regex(R"(^ \{([^}]*)\})"))) {
    std::istringstream values(found[1]);
    for (std::string value; std::getline(values, value, ',');) option.values.insert(value);
  }
  return option;
}

}  // namespace

Help helpOf(const std::string& command) {
  const std::regex optionLine(R"(^  (?:-[a-zA-Z],)?(--[a-z][a-z0-9.-]*)(.*))");
  const std::regex commandLine(R"(^  ([a-z]+) .*)");
  Help help;
  bool ofCommands = false;
  std::istringstream lines(groveHere(command + " --help", false).output);
  for (std::string line; std::getline(lines, line);) {
    std::smatch found;
    if (line == "Subcommands:") ofCommands = true;
    if (ofCommands && std::regex_match(line, found, commandLine)) help.commands.insert(found[1]);
    if (std::regex_match(line, found, optionLine)) help.options[found[1]] = parseOption(found[2]);
  }
  return help;
}

std::vector<std::string> allCommands() {
  std::vector<std::string> all = {""};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string above = all[i];
    for (const std::string& name : helpOf(above).commands) {
      all.push_back(above);
      all.back().append(above.empty() ? "" : " ").append(name);
    }
  }
  return all;
}

}  // namespace grove::cli
