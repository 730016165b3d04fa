#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace grove::cli {

/// Formats an option's values for help and for the shells' completion: "{auto,egl,osmesa}".
inline std::string oneOf(std::span<const std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) text.append(text.empty() ? "{" : ",").append(name);
  return text + "}";
}

template <class Value>
CLI::Option* choose(CLI::Option* option, const std::map<std::string, Value>& values) {
  std::vector<std::string_view> names;
  names.reserve(values.size());
  for (const auto& [name, value] : values) names.push_back(name);
  return option->transform(CLI::Transformer(values).description(""))->type_name(oneOf(names));
}

}  // namespace grove::cli
