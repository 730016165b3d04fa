#include "base/mapped_range_guard.h"

#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <mutex>

namespace grove {

struct MappedRangeGuard::Slot {
  std::atomic<std::uintptr_t> begin{0};  ///< 0: free
  std::atomic<std::uintptr_t> end{0};    ///< 0: in transition
  std::atomic<bool> cut{false};
};

namespace {

using Slot = MappedRangeGuard::Slot;
static_assert(std::atomic<std::uintptr_t>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

// Static, because a signal handler gets no argument of its own: one table for the whole process.
constinit std::array<Slot, 1024> slots;
constinit std::mutex filling;
constinit bool installed = false;
// Written before the handler is installed, then only read.
struct sigaction previous {};
std::uintptr_t pageBytes = 0;

/// Replaces a range that can no longer be read by zeros. Uses only what is safe in a signal handler.
bool mend(std::uintptr_t address) noexcept {
  for (Slot& slot : slots) {
    const std::uintptr_t begin = slot.begin.load();
    const std::uintptr_t end = slot.end.load();
    // Compares a second time: the end could belong to another range that took the slot in between.
    if (begin == 0 || address < begin || address >= end || slot.begin.load() != begin) continue;
    // The rest lies beyond the file's end, too. One mapping for all of it, because their number is limited.
    const std::uintptr_t from = address - (address - begin) % pageBytes;
    void* const place = reinterpret_cast<void*>(from);  // NOLINT(performance-no-int-to-ptr): it is an address
    if (mmap(place, end - from, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0) == MAP_FAILED) return false;
    slot.cut.store(true);
    return true;
  }
  return false;
}

void onBusError(int signal, siginfo_t* info, void* context) noexcept {
  const int error = errno;
  const bool fault = info->si_code > 0;  // else another process sent it
  if (fault && mend(reinterpret_cast<std::uintptr_t>(info->si_addr))) {
    errno = error;
    return;
  }
  if ((previous.sa_flags & SA_SIGINFO) != 0) {
    previous.sa_sigaction(signal, info, context);
    return;
  }
  if (previous.sa_handler != SIG_DFL && previous.sa_handler != SIG_IGN) {
    previous.sa_handler(signal);
    return;
  }
  if (!fault && previous.sa_handler == SIG_IGN) return;
  // If it faults again when this returns, the process ends with a core dump that shows the place.
  std::signal(signal, SIG_DFL);
  if (!fault) raise(signal);
}

/// Never uninstalled: a handler that was installed later may call ours.
void install() noexcept {
  pageBytes = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  sigaction(SIGBUS, nullptr, &previous);
  struct sigaction ours {};
  ours.sa_sigaction = onBusError;
  ours.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_RESTART;
  sigaction(SIGBUS, &ours, nullptr);
}

}  // namespace

MappedRangeGuard::MappedRangeGuard(std::span<const std::byte> bytes) noexcept {
  const std::lock_guard lock(filling);
  if (!installed) install();
  installed = true;
  for (Slot& slot : slots) {
    if (slot.begin.load() != 0) continue;
    slot_ = &slot;
    slot.cut.store(false);
    slot.begin.store(reinterpret_cast<std::uintptr_t>(bytes.data()));
    slot.end.store(slot.begin.load() + bytes.size());
    return;
  }
}

MappedRangeGuard::~MappedRangeGuard() {
  if (slot_ == nullptr) return;
  slot_->end.store(0);
  slot_->begin.store(0);
}

bool MappedRangeGuard::cut() const noexcept { return slot_ != nullptr && slot_->cut.load(std::memory_order_relaxed); }

}  // namespace grove
