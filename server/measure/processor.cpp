#include "measure/processor.h"

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <thread>

namespace grove::measure {

std::string processorName() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return {};
}

std::string machineName() {
  const unsigned cores = std::max(1U, std::thread::hardware_concurrency());
  return processorName() + ", " + std::to_string(cores) + (cores == 1 ? " core" : " cores");
}

}  // namespace grove::measure
