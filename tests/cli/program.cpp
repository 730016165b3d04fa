#include "cli/program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <wordexp.h>

#include <array>
#include <cstdio>

#include "cli/command_line.h"

namespace grove::cli {
namespace {

std::string allOf(std::FILE* file) {
  std::string all;
  std::array<char, 4096> buffer{};
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), file)) all.append(buffer.data(), n);
  return all;
}

Outcome runInShell(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  Outcome outcome;
  outcome.output = allOf(pipe);
  outcome.exit = WEXITSTATUS(pclose(pipe));
  return outcome;
}

/// The child's part of groveHere.
[[noreturn]] void runHere(const std::string& arguments, int output, bool wantErrors) {
  alarm(100);
  const int nowhere = open("/dev/null", O_RDWR);
  dup2(wantErrors ? nowhere : output, STDOUT_FILENO);
  dup2(wantErrors ? output : nowhere, STDERR_FILENO);
  wordexp_t words{};
  if (wordexp(("grove " + arguments).c_str(), &words, WRDE_NOCMD | WRDE_UNDEF) != 0) _exit(127);
  const int code = run(static_cast<int>(words.we_wordc), words.we_wordv);
  std::fflush(nullptr);
  _exit(code);
}

}  // namespace

Outcome grove(const std::string& arguments, bool wantErrors) {
  return runInShell("timeout 100 " GROVE_BINARY " " + arguments + (wantErrors ? " 2>&1 >/dev/null" : " 2>/dev/null"));
}

Outcome groveHere(const std::string& arguments, bool wantErrors) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return {};
  std::fflush(nullptr);  // else the child, too, would print what waits
  const pid_t child = fork();
  if (child == 0) runHere(arguments, ends[1], wantErrors);
  close(ends[1]);
  std::FILE* file = fdopen(ends[0], "r");
  Outcome outcome;
  outcome.output = allOf(file);
  std::fclose(file);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status)) outcome.exit = WEXITSTATUS(status);
  return outcome;
}

Outcome shell(const std::string& script) {
  std::string quoted = "'";
  for (const char letter : script) quoted += letter == '\'' ? "'\\''" : std::string(1, letter);
  return runInShell("timeout 100 bash -c " + quoted + "'");
}

Outcome groveStoppedAfter(double seconds, const std::string& arguments) {
  return runInShell("timeout --preserve-status --signal=INT --kill-after=60 " + std::to_string(seconds) +
                    " " GROVE_BINARY " " + arguments + " 2>/dev/null");
}

}  // namespace grove::cli
