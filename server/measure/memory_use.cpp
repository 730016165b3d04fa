#include "measure/memory_use.h"

#include <malloc.h>
#include <unistd.h>

#include <fstream>
#include <limits>
#include <string>

#include "base/error.h"

namespace grove::measure {
namespace {

/// Returns the bytes of a field such as `Rss:` in a file of lines `NAME VALUE kB`.
std::int64_t bytesOf(const std::string& file, const std::string& name) {
  std::ifstream lines(file);
  for (std::string word; lines >> word;) {
    std::int64_t kilobytes = 0;
    if (word == name && lines >> kilobytes) return 1024 * kilobytes;
    lines.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  throw EnvironmentError("does not report " + name, file, "a Linux kernel of 4.14 or newer is needed");
}

MemoryUse memoryOf(const std::string& process) {
  const std::string file = "/proc/" + process + "/smaps_rollup";
  return {bytesOf(file, "Rss:"), bytesOf(file, "Pss:")};
}

}  // namespace

MemoryUse MemoryUse::read() { return memoryOf("self"); }

MemoryUse MemoryUse::of(pid_t process) { return memoryOf(std::to_string(process)); }

std::int64_t availableMemory() { return bytesOf("/proc/meminfo", "MemAvailable:"); }

void returnFreedMemory() { malloc_trim(0); }

std::size_t residentBytes() {
  std::ifstream statm("/proc/self/statm");
  std::size_t allPages = 0;
  std::size_t residentPages = 0;
  if (!(statm >> allPages >> residentPages)) return 0;
  return residentPages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace grove::measure
