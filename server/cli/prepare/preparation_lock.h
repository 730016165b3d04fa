#pragma once

#include <filesystem>
#include <functional>
#include <stop_token>

namespace grove::cli {

/// A lock file, held while something is made for the cache folder, so that only one of several servers makes it.
class PreparationLock {
 public:
  /// Opens the file without locking it. Throws EnvironmentError if it cannot be written.
  explicit PreparationLock(const std::filesystem::path& file);
  ~PreparationLock();
  PreparationLock(const PreparationLock&) = delete;
  PreparationLock& operator=(const PreparationLock&) = delete;

  /// Takes the lock if it is free.
  [[nodiscard]] bool take() const noexcept;
  void give() const noexcept;
  /// Waits for the lock: checks every 200 ms, and calls `waiting` before each check. Returns false if it was stopped.
  [[nodiscard]] bool wait(const std::function<void()>& waiting, const std::stop_token& stop) const;

 private:
  int file_;
};

}  // namespace grove::cli
