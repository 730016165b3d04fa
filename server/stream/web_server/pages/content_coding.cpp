#include "stream/web_server/pages/content_coding.h"

#include <algorithm>
#include <optional>

namespace grove::stream {
namespace {

constexpr int kFullWeight = 1000;
/// For identity when the header does not mention it.
constexpr int kLeastWeight = 1;

char lowered(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool isSameToken(std::string_view token, std::string_view lowerCase) {
  return std::ranges::equal(token, lowerCase, [](char a, char b) { return lowered(a) == b; });
}

std::string_view withoutSpaces(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Removes and returns the text before the first separator.
std::string_view takeUntil(char separator, std::string_view& text) {
  const std::string_view taken = text.substr(0, text.find(separator));
  text.remove_prefix(std::min(text.size(), taken.size() + 1));
  return withoutSpaces(taken);
}

/// Parses "q=" and 0 to 1 with at most three decimals (RFC 9110, 12.4.2), into thousandths.
std::optional<int> parseWeight(std::string_view text) {
  if (text.size() < 3 || text.size() > 7 || lowered(text[0]) != 'q' || text[1] != '=') return std::nullopt;
  text.remove_prefix(2);
  if ((text[0] != '0' && text[0] != '1') || (text.size() > 1 && text[1] != '.')) return std::nullopt;
  int weight = (text[0] - '0') * kFullWeight;
  int unit = kFullWeight / 10;
  for (const char digit : text.substr(std::min<std::size_t>(text.size(), 2))) {
    if (digit < '0' || digit > '9') return std::nullopt;
    weight += (digit - '0') * unit;
    unit /= 10;
  }
  return weight <= kFullWeight ? std::optional(weight) : std::nullopt;
}

}  // namespace

int codingWeight(std::string_view acceptEncoding, std::string_view coding) noexcept {
  std::optional<int> ofAnyOther;
  while (!acceptEncoding.empty()) {
    std::string_view parameter = takeUntil(',', acceptEncoding);
    const bool hasWeight = parameter.find(';') != std::string_view::npos;
    const std::string_view name = takeUntil(';', parameter);
    const std::optional<int> weight = hasWeight ? parseWeight(withoutSpaces(parameter)) : kFullWeight;
    if (!weight) continue;
    if (isSameToken(name, coding) || (coding == "gzip" && isSameToken(name, "x-gzip"))) return *weight;
    if (name == "*" && !ofAnyOther) ofAnyOther = weight;
  }
  return ofAnyOther.value_or(coding == "identity" ? kLeastWeight : 0);
}

}  // namespace grove::stream
