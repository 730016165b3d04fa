#include "cli/program.h"

#include <sys/wait.h>

#include <array>
#include <cstdio>

namespace grove::cli {
namespace {

Outcome run(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  Outcome outcome;
  std::array<char, 4096> buffer{};
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    outcome.output.append(buffer.data(), n);
  outcome.exit = WEXITSTATUS(pclose(pipe));
  return outcome;
}

}  // namespace

Outcome grove(const std::string& arguments, bool wantErrors) {
  return run("timeout 60 " GROVE_BINARY " " + arguments + (wantErrors ? " 2>&1 >/dev/null" : " 2>/dev/null"));
}

Outcome shell(const std::string& script) {
  std::string quoted = "'";
  for (const char letter : script) quoted += letter == '\'' ? "'\\''" : std::string(1, letter);
  return run("timeout 60 bash -c " + quoted + "'");
}

Outcome groveStoppedAfter(double seconds, const std::string& arguments) {
  return run("timeout --preserve-status --signal=INT --kill-after=60 " + std::to_string(seconds) +
             " " GROVE_BINARY " " + arguments + " 2>/dev/null");
}

}  // namespace grove::cli
