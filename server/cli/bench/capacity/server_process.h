#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace grove::cli {

/// A `grove serve` process on a free port of the loopback interface. It ends with this object or, at the latest, with
/// this process. Not thread-safe.
class ServerProcess {
 public:
  /// Starts `program`, which is `grove`, with further options of `grove serve`. Throws EnvironmentError.
  ServerProcess(const std::string& program, const std::vector<std::string>& options);
  ~ServerProcess();
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;

  /// Waits until the world is ready and returns the port; nothing if the server ends before that.
  [[nodiscard]] std::optional<int> awaitPort();
  /// CPU time of all its threads so far. Throws EnvironmentError if it has ended.
  [[nodiscard]] double cpuSeconds() const;
  /// Resident memory; pages that n processes map count as 1/n. Throws EnvironmentError if it has ended.
  [[nodiscard]] std::int64_t proportionalBytes() const;

 private:
  pid_t process_ = 0;
  int output_ = -1;  ///< the server's stdout
};

}  // namespace grove::cli
