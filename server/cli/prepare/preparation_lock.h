#pragma once

#include <filesystem>
#include <functional>
#include <stop_token>

namespace grove::cli {

/// Held while something is made for the cache folder, so that of several servers one makes it and the others need not.
class PreparationLock {
 public:
  /// Takes nothing yet. Throws EnvironmentError if the file cannot be written.
  explicit PreparationLock(const std::filesystem::path& file);
  ~PreparationLock();
  PreparationLock(const PreparationLock&) = delete;
  PreparationLock& operator=(const PreparationLock&) = delete;

  /// Takes it if it is free.
  [[nodiscard]] bool take() const noexcept;
  void give() const noexcept;
  /// Looks every 200 ms whether it is free, and calls `waiting` before. False if it was stopped.
  [[nodiscard]] bool wait(const std::function<void()>& waiting, const std::stop_token& stop) const;

 private:
  int file_;
};

}  // namespace grove::cli
