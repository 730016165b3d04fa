#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
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

/// An option from `low` to `high`, whose help shows its default.
template <class Number>
CLI::Option* addNumber(CLI::App& app, const char* name, Number& value, std::type_identity_t<Number> low,
                       std::type_identity_t<Number> high, const char* help) {
  return app.add_option(name, value, help)->check(CLI::Range(low, high))->capture_default_str();
}

}  // namespace grove::cli
