#include "cli/bench/capacity/server_process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string_view>

#include "base/error.h"
#include "measure/memory_use.h"

namespace grove::cli {
namespace {

constexpr std::string_view kListening = "listening on http://127.0.0.1:";

/// Runs in the child: may call only what a signal handler may. A parent that is killed takes the server with it.
[[noreturn]] void becomeServer(const char* program, int output, pid_t parent, char* const* arguments) {
  sigset_t none{};
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
  dup2(output, STDOUT_FILENO);
  execv(program, arguments);
  _exit(127);
}

}  // namespace

ServerProcess::ServerProcess(const std::string& program, const std::vector<std::string>& options) {
  std::vector<std::string> words{"grove", "serve", "--listen", "127.0.0.1:0"};
  words.insert(words.end(), options.begin(), options.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw EnvironmentError("cannot open a pipe", "grove bench amortize", "raise ulimit -n");
  }
  const pid_t parent = getpid();
  process_ = fork();
  if (process_ == 0) becomeServer(program.c_str(), ends[1], parent, arguments.data());
  close(ends[1]);
  output_ = ends[0];
  if (process_ < 0) {
    close(output_);
    throw EnvironmentError("cannot start a process", "grove bench amortize", "raise ulimit -u");
  }
}

ServerProcess::~ServerProcess() {
  kill(process_, SIGTERM);
  waitpid(process_, nullptr, 0);
  close(output_);
}

std::optional<int> ServerProcess::awaitPort() {
  std::string line;
  for (char letter = 0; read(output_, &letter, 1) == 1;) {
    if (letter != '\n') {
      line += letter;
      continue;
    }
    int port = 0;
    if (line.starts_with(kListening) &&
        std::from_chars(line.data() + kListening.size(), line.data() + line.size(), port).ec == std::errc()) {
      return port;
    }
    line.clear();
  }
  return std::nullopt;
}

double ServerProcess::cpuSeconds() const {
  const std::string path = "/proc/" + std::to_string(process_) + "/stat";
  std::ifstream file(path);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  const std::size_t name = text.rfind(')');  // the name may contain blanks
  if (name == std::string::npos) throw EnvironmentError("cannot be read", path, "the server has ended");
  std::istringstream fields(text.substr(name + 1));
  constexpr int kFieldsBefore = 11;  // fields to skip from the state on, see proc(5)
  std::string skipped;
  for (int i = 0; i < kFieldsBefore; ++i) fields >> skipped;
  std::int64_t user = 0;
  std::int64_t system = 0;
  fields >> user >> system;
  return static_cast<double>(user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

std::int64_t ServerProcess::proportionalBytes() const { return measure::MemoryUse::of(process_).proportional; }

}  // namespace grove::cli
