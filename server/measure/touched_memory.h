#pragma once

#include <cstdint>
#include <functional>
#include <optional>

namespace grove::measure {

/// Returns the bytes of memory that the process touches while `work` runs, on any thread: the pages read or written,
/// times their size, without those of the program and its libraries. It is an upper bound in whole pages, which are 2
/// MiB if the kernel uses huge ones, and includes what other threads do meanwhile. Counting takes milliseconds and
/// touches some pages itself, so subtract the result of an empty `work`. Returns nothing if the kernel cannot report it
/// (Linux with CONFIG_PROC_PAGE_MONITOR can).
[[nodiscard]] std::optional<std::int64_t> touchedBytes(const std::function<void()>& work);

}  // namespace grove::measure
