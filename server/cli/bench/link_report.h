#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "node/transport/transport_kind.h"

namespace grove::cli {

inline constexpr std::array kTransports = {node::TransportKind::kReference, node::TransportKind::kBytes,
                                           node::TransportKind::kGrpc};

[[nodiscard]] constexpr std::string_view transportName(node::TransportKind kind) noexcept {
  if (kind == node::TransportKind::kGrpc) return "grpc";
  return kind == node::TransportKind::kBytes ? "bytes" : "reference";
}

/// Traffic in Mbit/s per visitor; nothing is transferred by reference.
[[nodiscard]] nlohmann::ordered_json linkJson(const node::LinkTraffic& traffic, double seconds, int users);

}  // namespace grove::cli
