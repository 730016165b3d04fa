#pragma once

#include <cstddef>
#include <new>
#include <string>

namespace grove {

/// Returns "not enough memory", with the limit of the process's address space (ulimit -v) if it has one.
[[nodiscard]] std::string memoryShortage();

/// Throws EnvironmentError if the process cannot get this much more address space. For use before code that crashes
/// without it, such as graphics drivers. Allocates nothing.
void requireAddressSpace(std::size_t bytes);

/// Size of a thread's stack.
[[nodiscard]] std::size_t stackBytes() noexcept;

/// Returns freed blocks of a megabyte and more to the system at once. By default glibc soon keeps blocks of up to 32
/// MB, so a process in which visitors and their pictures come and go keeps growing. Call it at the start.
void returnFreedBlocks() noexcept;

/// If address space is limited, lets threads share their heaps, each of which would take 64 MB of it. Call it at the
/// start, before there are threads.
void spareAddressSpace() noexcept;

/// During its life, the process ends with one line and exit status 1 if `new` finds no memory. For work that loses
/// nothing when it is cut off, on threads that could not report it otherwise. One at a time.
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
