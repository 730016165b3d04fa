#include "node/transport/grpc/calls/call_failure.h"

#include <string_view>

namespace grove::node {
namespace {

bool has(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

/// Returns the text after the last colon. Before it, gRPC names addresses and its own components.
std::string lastPartOf(const std::string& text) {
  const std::size_t colon = text.rfind(": ");
  return colon == std::string::npos ? text : text.substr(colon + 2);
}

/// OpenSSL's reason follows "SSL routines::".
std::string handshakeReason(const std::string& text) {
  const std::size_t colons = text.rfind("::");
  const std::string reason = colons == std::string::npos ? lastPartOf(text) : text.substr(colons + 2);
  return reason == "wrong version number" ? "it does not speak TLS" : "the TLS handshake fails: " + reason;
}

}  // namespace

CallFailure failureOf(const grpc::Status& status, bool wasOpen, bool isSecure) {
  using Kind = CallFailure::Kind;
  const std::string& text = status.error_message();
  if (status.error_code() == grpc::StatusCode::UNAUTHENTICATED) return {Kind::kRefused, text};
  if (status.error_code() == grpc::StatusCode::DEADLINE_EXCEEDED) return {Kind::kSilent, text};
  if (!has(text, "failed to connect")) return {Kind::kNoAnswer, text};
  if (isSecure && has(text, "Tls handshake failed")) return {Kind::kUntrusted, handshakeReason(text)};
  const std::string reason = lastPartOf(text);
  const bool isClosed = reason == "Socket closed" || reason == "Connection reset by peer";
  if (!isSecure && !wasOpen && isClosed) {
    return {Kind::kMayWantTls, "it closes the connection at once (does it require TLS?)"};
  }
  return {Kind::kNoAnswer, reason};
}

}  // namespace grove::node
