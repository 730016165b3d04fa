#pragma once

#include <cstdint>
#include <mutex>
#include <string_view>

/// One line on stderr per event; thread-safe. stdout belongs to a command's result.
namespace grove::log {

void info(std::string_view message) noexcept;
void warning(std::string_view message) noexcept;
void error(std::string_view message) noexcept;

/// For events that may happen thousands of times a second: at most one line per second, with the number of suppressed
/// ones. Any thread.
class Limited {
 public:
  void info(std::string_view message) noexcept;
  void warning(std::string_view message) noexcept;
  void error(std::string_view message) noexcept;

 private:
  void write(void (*line)(std::string_view) noexcept, std::string_view message) noexcept;

  std::mutex mutex_;
  std::int64_t nextMilliseconds_ = 0;
  std::uint64_t leftOut_ = 0;
};

}  // namespace grove::log
