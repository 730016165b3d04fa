#include "base/log.h"

#include <cstdio>
#include <ctime>

namespace grove::log {
namespace {

void write(const char* level, std::string_view message) noexcept {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char clock[16];
  std::strftime(clock, sizeof clock, "%H:%M:%S", &local);
  std::fprintf(stderr, "%s %-7s %.*s\n", clock, level, static_cast<int>(message.size()), message.data());
}

}  // namespace

void info(std::string_view message) noexcept { write("info", message); }
void warning(std::string_view message) noexcept { write("warning", message); }
void error(std::string_view message) noexcept { write("error", message); }

}  // namespace grove::log
