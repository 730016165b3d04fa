#include "world/scenes/toml_nesting.h"

#include <algorithm>
#include <string>

namespace grove::world {
namespace {

/// The end of the string that begins with a quote. An unclosed string ends with its line, or with the text if it may
/// span lines: the parser rejects it.
std::size_t endOfString(std::string_view text, std::size_t begin) {
  const char quote = text[begin];
  const std::string three(3, quote);
  const bool manyLines = text.substr(begin, 3) == three;
  for (std::size_t at = begin + (manyLines ? 3 : 1); at < text.size(); ++at) {
    if (text[at] == '\\' && quote == '"') {
      ++at;
    } else if (!manyLines && text[at] == quote) {
      return at + 1;
    } else if (!manyLines && text[at] == '\n') {
      return at;
    } else if (manyLines && text.substr(at, 3) == three) {
      // Up to two quotes before the closing ones belong to the string.
      const std::size_t end = text.find_first_not_of(quote, at);
      return std::min({end, at + 5, text.size()});
    }
  }
  return text.size();
}

/// The end of the comment, string or character at a place.
std::size_t endOfPiece(std::string_view text, std::size_t begin) {
  if (text[begin] == '#') return std::min(text.find('\n', begin), text.size());
  if (text[begin] == '"' || text[begin] == '\'') return endOfString(text, begin);
  return begin + 1;
}

bool isOneOf(char c, std::string_view all) { return all.find(c) != std::string_view::npos; }

}  // namespace

std::optional<std::size_t> lineNestedDeeper(std::string_view text, int max) {
  std::size_t line = 1;
  int open = 0;
  int dots = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = endOfPiece(text, begin);
    const char first = text[begin];
    if (isOneOf(first, "[{")) ++open;
    if (isOneOf(first, "]}")) open = std::max(open - 1, 0);
    if (isOneOf(first, "[{]}=,\n")) dots = 0;
    if (first == '.') ++dots;
    if (open > max || dots > max) return line;
    const std::string_view piece = text.substr(begin, end - begin);
    line += static_cast<std::size_t>(std::ranges::count(piece, '\n'));
    begin = end;
  }
  return std::nullopt;
}

}  // namespace grove::world
