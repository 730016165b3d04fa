#include "measure/touched_memory.h"

#include <sys/mman.h>

#include <cstddef>
#include <fstream>
#include <sstream>
#include <string>

namespace grove::measure {
namespace {

/// More pages than Linux would flush one by one from the TLB.
constexpr std::size_t kForgottenBytes = std::size_t{4} << 20U;

/// A processor marks a page as accessed when it translates its address, but not when the translation is in the TLB.
/// Linux clears marks without flushing the TLB; it does flush it when many pages become unreadable at once.
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

/// Returns whether a mapping's marks come from this process only; `words` follow its addresses. Pages of the program
/// and of its libraries (private mappings of files) also carry the marks of every other process that runs them.
bool isOwn(std::istringstream& words) {
  std::string permissions;
  std::string offset;
  std::string device;
  std::uint64_t inode = 0;
  words >> permissions >> offset >> device >> inode;
  return inode == 0 || permissions.ends_with('s');
}

std::optional<std::int64_t> markedBytes() {
  std::ifstream lines("/proc/self/smaps");
  std::optional<std::int64_t> bytes;
  bool own = false;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name;
    words >> name;
    std::int64_t kilobytes = 0;
    if (!name.ends_with(':')) {
      own = isOwn(words);
    } else if (name == "Referenced:" && own && words >> kilobytes) {
      bytes = bytes.value_or(0) + 1024 * kilobytes;
    }
  }
  return bytes;
}

}  // namespace

std::optional<std::int64_t> touchedBytes(const std::function<void()>& work) {
  if (!unmarkPages() || !forgetTranslations()) return std::nullopt;
  work();
  return markedBytes();
}

}  // namespace grove::measure
