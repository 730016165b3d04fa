#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace grove::cli {

/// One option of a command: its default and the values that it can have, where help tells.
struct HelpOption {
  std::string standard;
  std::set<std::string> values;
};

/// What `grove COMMAND --help` tells; options by their long names.
struct Help {
  std::map<std::string, HelpOption> options;
  std::set<std::string> commands;
};

/// `command` is empty or as in "bench fluid".
Help helpOf(const std::string& command);

/// "", "serve", "bench fluid" and all the others.
std::vector<std::string> allCommands();

}  // namespace grove::cli
