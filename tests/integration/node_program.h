#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <string>
#include <vector>

namespace grove::integration {

/// `grove node` as a process of its own, which listens when this is made.
class NodeProgram {
 public:
  NodeProgram(const std::string& scene, const std::string& objects, int port = 0,
              const std::vector<std::string>& more = {}) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) return;
    std::vector<std::string> words{"grove",     "node",  "--scene",  scene,
                                   "--objects", objects, "--listen", "127.0.0.1:" + std::to_string(port)};
    words.insert(words.end(), more.begin(), more.end());
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    process_ = fork();
    if (process_ == 0) {
      dup2(ends[1], STDOUT_FILENO);
      execv(GROVE_BINARY, arguments.data());
      _exit(127);
    }
    close(ends[1]);
    std::FILE* const output = fdopen(ends[0], "r");
    std::array<char, 256> line{};
    if (std::fgets(line.data(), line.size(), output) != nullptr) {
      std::sscanf(line.data(), "listening on 127.0.0.1:%d", &port_);  // NOLINT(cert-err34-c): 0 is what a failure gives
    }
    std::fclose(output);
  }
  ~NodeProgram() {
    if (process_ > 0) end(SIGKILL);
  }
  NodeProgram(const NodeProgram&) = delete;
  NodeProgram& operator=(const NodeProgram&) = delete;

  /// 0: it does not listen.
  [[nodiscard]] int port() const noexcept { return port_; }
  [[nodiscard]] std::string address() const { return "127.0.0.1:" + std::to_string(port_); }

  /// Its exit status; -1 if it was killed.
  int end(int signal) {
    kill(process_, signal);
    int status = 0;
    waitpid(process_, &status, 0);
    process_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t process_ = 0;
  int port_ = 0;
};

}  // namespace grove::integration
