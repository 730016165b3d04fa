#pragma once

#include <cstddef>
#include <new>
#include <string>

namespace grove {

/// "not enough memory", with the limit of the process's address space (ulimit -v) if it has one.
[[nodiscard]] std::string memoryShortage();

/// Throws EnvironmentError if the process cannot take so many more bytes of address space: for what comes before code
/// that crashes without them, as graphics drivers do. Takes none.
void requireAddressSpace(std::size_t bytes);

/// What a thread's stack takes.
[[nodiscard]] std::size_t stackBytes() noexcept;

/// Lets freed blocks of a megabyte and more go back to the system at once. By default glibc soon keeps blocks of up to
/// 32 MB, and a process where many come and go, as visitors with their pictures do, grows with every round of them. At
/// the start.
void returnFreedBlocks() noexcept;

/// Where address space is limited, lets threads share their heaps, each of which would take 64 MB of it however little
/// it holds. At the start, before there are threads.
void spareAddressSpace() noexcept;

/// While it lives, the process ends with one line, and exit status 1, where there is no memory for a `new`: for work
/// that loses nothing when it is cut off, on threads that could not report it otherwise. One at a time.
class EndOnMemoryShortage {
 public:
  EndOnMemoryShortage() noexcept;
  ~EndOnMemoryShortage();
  EndOnMemoryShortage(const EndOnMemoryShortage&) = delete;
  EndOnMemoryShortage& operator=(const EndOnMemoryShortage&) = delete;

 private:
  const std::new_handler former_;
};

}  // namespace grove
