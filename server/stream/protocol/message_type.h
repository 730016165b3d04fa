#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "stream/protocol/protocol.h"

namespace grove::stream {

enum class MessageType : std::uint8_t {
  kHello = 0x01,
  kInput = 0x02,
  kAck = 0x03,
  kResize = 0x04,
  kOffer = 0x05,
  kLimits = 0x06,
  kBroken = 0x07,
  kPresented = 0x08,
  kPainted = 0x09,
  kCapture = 0x0A,
  kWelcome = 0x81,
  kFrame = 0x82,
  kWaiting = 0x83,
  kPicture = 0x84,
  kStatus = 0x85,
  kRefining = 0x86,
  kCaptured = 0x87,
  kTimes = 0x88,
  kPeople = 0x89,
  kGround = 0x8A,
};

[[nodiscard]] inline Refusal refuseMessage(std::string reason) {
  return {CloseCode::kProtocolError, std::move(reason)};
}
[[nodiscard]] inline Refusal wrongLength(std::string_view message) {
  return refuseMessage(std::string(message) + " has the wrong length");
}
[[nodiscard]] inline Refusal wrongVersion(std::uint8_t version) {
  return {CloseCode::kWrongVersion, "protocol version " + std::to_string(version) + ", here is version " +
                                        std::to_string(kProtocolVersion) + ": reload the page"};
}
[[nodiscard]] inline Refusal reservedBytes(std::string_view message) {
  return refuseMessage("reserved bytes of " + std::string(message) + " are not zero");
}

}  // namespace grove::stream
