#include "base/name_list.h"

#include <algorithm>
#include <cstddef>

namespace grove {

std::string nameList(const std::vector<std::string>& names) {
  constexpr std::size_t kMaxNames = 8;
  constexpr std::size_t kMaxBytes = 64;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), kMaxNames); ++i) {
    list += (i == 0 ? "" : ", ") + names[i].substr(0, kMaxBytes);
  }
  std::ranges::replace_if(
      list, [](unsigned char c) { return c < 0x20 || c == 0x7F; }, '?');
  if (names.size() > kMaxNames) list += " and " + std::to_string(names.size() - kMaxNames) + " more";
  return list;
}

}  // namespace grove
