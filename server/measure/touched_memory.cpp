#include "measure/touched_memory.h"

#include <sys/mman.h>

#include <cstddef>
#include <fstream>
#include <limits>
#include <string>

namespace grove::measure {
namespace {

/// More pages than Linux would forget one by one.
constexpr std::size_t kForgottenBytes = std::size_t{4} << 20U;

/// A processor marks a page when it looks up where it lies, not when it remembers that. Linux unmarks pages without
/// making processors forget them; it does make them when many pages become unreadable at once.
bool forgetTranslations() {
  void* const pages =
      ::mmap(nullptr, kForgottenBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_POPULATE, -1, 0);
  if (pages == MAP_FAILED) return false;
  const bool done = ::mprotect(pages, kForgottenBytes, PROT_NONE) == 0;
  return ::munmap(pages, kForgottenBytes) == 0 && done;
}

bool unmarkPages() {
  std::ofstream file("/proc/self/clear_refs");
  file << "1" << std::flush;
  return file.good();
}

std::optional<std::int64_t> markedBytes() {
  std::ifstream lines("/proc/self/smaps_rollup");
  for (std::string word; lines >> word;) {
    std::int64_t kilobytes = 0;
    if (word == "Referenced:" && lines >> kilobytes) return 1024 * kilobytes;
    lines.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::int64_t> touchedBytes(const std::function<void()>& work) {
  if (!unmarkPages() || !forgetTranslations()) return std::nullopt;
  work();
  return markedBytes();
}

}  // namespace grove::measure
