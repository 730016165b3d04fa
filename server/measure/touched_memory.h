#pragma once

#include <cstdint>
#include <functional>
#include <optional>

namespace grove::measure {

/// Bytes of memory that the process touches while `work` runs, on whichever thread: the pages that are read or written,
/// times their size, without those of the program and its libraries. So it is an upper bound, in whole pages, which are
/// 2 MiB where the kernel gave huge ones. What other threads do meanwhile counts too. Counting takes milliseconds and
/// touches some pages itself, so the same of an empty `work` is to be subtracted. Nothing where the kernel cannot tell
/// (Linux with CONFIG_PROC_PAGE_MONITOR can).
[[nodiscard]] std::optional<std::int64_t> touchedBytes(const std::function<void()>& work);

}  // namespace grove::measure
