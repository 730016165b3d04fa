#include "base/name_list.h"

#include <algorithm>
#include <cstddef>

namespace grove {

std::string nameList(const std::vector<std::string>& names) {
  constexpr std::size_t kMostNames = 8;
  constexpr std::size_t kMostBytes = 64;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNames); ++i) {
    list += (i == 0 ? "" : ", ") + names[i].substr(0, kMostBytes);
  }
  std::ranges::replace_if(
      list, [](unsigned char c) { return c < 0x20 || c == 0x7F; }, '?');
  if (names.size() > kMostNames) list += " and " + std::to_string(names.size() - kMostNames) + " more";
  return list;
}

}  // namespace grove
