#pragma once

#include <sys/types.h>

#include <functional>
#include <optional>
#include <stop_token>
#include <string>

#include "cli/bench/amortize/interruption.h"

namespace grove::cli {

/// A copy of this process (fork) that does one task of a bench and sends its result. Only a process without other
/// threads may make one. The copy ends with this object or, at the latest, with this process.
class TaskProcess {
 public:
  /// The task's link to the process that has started it.
  class Parent {
   public:
    explicit Parent(int link) : link_(link) {}
    /// Reports that the task is prepared, and waits for proceed(). Returns false if the task must end.
    [[nodiscard]] bool arrive() const;

   private:
    const int link_;
  };
  /// Returns the result, or nothing after a stop request. What it throws is rethrown where the result is awaited.
  using Task = std::function<std::optional<std::string>(const Parent& parent, const std::stop_token& stop)>;

  /// Starts the task. Throws EnvironmentError.
  explicit TaskProcess(const Task& task);
  ~TaskProcess();
  TaskProcess(const TaskProcess&) = delete;
  TaskProcess& operator=(const TaskProcess&) = delete;

  /// Waits for Parent::arrive(); returns false after a signal. Throws std::runtime_error with what the task has thrown.
  [[nodiscard]] bool awaitArrival(Interruption& interruption);
  void proceed() const;
  /// Returns nothing after a signal. Throws as awaitArrival().
  [[nodiscard]] std::optional<std::string> awaitResult(Interruption& interruption);

 private:
  [[noreturn]] static void become(int link, pid_t parent, const Task& task);
  /// Returns the text of the next message.
  [[nodiscard]] std::optional<std::string> await(Interruption& interruption) const;

  pid_t process_ = 0;
  int link_ = -1;
};

}  // namespace grove::cli
