#include "base/address_space.h"

#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string_view>

#include "base/error.h"
#include "base/log.h"

namespace grove {
namespace {

constexpr const char* kWhat = "not enough memory";

/// In kB, as ulimit reports it.
std::optional<unsigned long long> limit() noexcept {
  rlimit space{};
  if (getrlimit(RLIMIT_AS, &space) != 0 || space.rlim_cur == RLIM_INFINITY) return std::nullopt;
  return space.rlim_cur >> 10U;
}

/// Writes into `text`, because there may be no memory for a string.
std::string_view describe(std::array<char, 128>& text) noexcept {
  const auto max = limit();
  const int length =
      max ? std::snprintf(text.data(), text.size(), "%s: raise the limit (ulimit -v), which is %llu kB", kWhat, *max)
          : std::snprintf(text.data(), text.size(), "%s: this machine has none left for this process", kWhat);
  return {text.data(), static_cast<std::size_t>(length)};
}

void end() {
  std::array<char, 128> text{};
  log::error(describe(text));
  std::_Exit(EXIT_FAILURE);
}

}  // namespace

std::string memoryShortage() {
  std::array<char, 128> text{};
  return std::string(describe(text));
}

void requireAddressSpace(std::size_t bytes) {
  // The kernel counts this range although it can hold no data.
  void* const room = mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (room == MAP_FAILED) {
    throw EnvironmentError("the next step needs " + std::to_string(bytes >> 20U) + " MB of address space", kWhat,
                           limit() ? "raise the limit (ulimit -v), which is " + std::to_string(*limit()) + " kB"
                                   : "free some, or use a larger machine");
  }
  munmap(room, bytes);
}

std::size_t stackBytes() noexcept {
  rlimit stack{};
  const bool known = getrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur != RLIM_INFINITY;
  return known ? stack.rlim_cur : std::size_t{8} << 20U;
}

void returnFreedBlocks() noexcept { mallopt(M_MMAP_THRESHOLD, 1 << 20); }

void spareAddressSpace() noexcept {
  if (limit()) mallopt(M_ARENA_MAX, 2);
}

EndOnMemoryShortage::EndOnMemoryShortage() noexcept : former_(std::set_new_handler(end)) {}
EndOnMemoryShortage::~EndOnMemoryShortage() { std::set_new_handler(former_); }

}  // namespace grove
