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
  NodeProgram(const std::string& scene, const std::string& objects, int port = 0) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) return;
    const std::string listen = "127.0.0.1:" + std::to_string(port);
    process_ = fork();
    if (process_ == 0) {
      dup2(ends[1], STDOUT_FILENO);
      execl(GROVE_BINARY, "grove", "node", "--scene", scene.c_str(), "--objects", objects.c_str(), "--listen",
            listen.c_str(), nullptr);
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
