#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

#include "node/transport/transport_kind.h"

namespace grove::cli {

[[nodiscard]] constexpr std::string_view transportName(node::TransportKind kind) noexcept {
  return kind == node::TransportKind::kBytes ? "bytes" : "reference";
}

/// What travelled in so many seconds, in Mbit/s for each visitor; by reference, nothing does.
[[nodiscard]] nlohmann::ordered_json linkJson(const node::LinkTraffic& traffic, double seconds, int users);

}  // namespace grove::cli
