#include "models/gltf/json_nesting.h"

#include <cstddef>

namespace grove::models {

bool nestsDeeper(std::string_view json, int max) noexcept {
  int open = 0;
  bool inString = false;
  for (std::size_t at = 0; at < json.size(); ++at) {
    const char c = json[at];
    if (inString) {
      if (c == '\\') ++at;
      if (c == '"') inString = false;
    } else if (c == '"') {
      inString = true;
    } else if (c == '[' || c == '{') {
      if (++open > max) return true;
    } else if ((c == ']' || c == '}') && --open <= 0) {
      return false;
    }
  }
  return false;
}

}  // namespace grove::models
