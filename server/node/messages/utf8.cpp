#include "node/messages/utf8.h"

#include <utf8.h>

#include <iterator>

namespace grove::node {

bool isUtf8(std::string_view text) noexcept { return utf8::find_invalid(text) == std::string_view::npos; }

std::string asUtf8(std::string_view text, std::size_t maxBytes) {
  std::string valid;
  utf8::replace_invalid(text.begin(), text.end(), std::back_inserter(valid), U'?');
  if (valid.size() <= maxBytes) return valid;
  valid.resize(maxBytes);
  valid.erase(utf8::find_invalid(valid.begin(), valid.end()), valid.end());
  return valid;
}

}  // namespace grove::node
