#include "measure/process_memory.h"

#include <unistd.h>

#include <fstream>

namespace grove::measure {

std::size_t residentBytes() {
  std::ifstream statm("/proc/self/statm");
  std::size_t allPages = 0;
  std::size_t residentPages = 0;
  if (!(statm >> allPages >> residentPages)) return 0;
  return residentPages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace grove::measure
