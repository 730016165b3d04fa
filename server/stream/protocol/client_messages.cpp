#include <algorithm>
#include <cmath>

#include "stream/protocol/message_type.h"
#include "stream/protocol/printable.h"
#include "stream/protocol/protocol.h"
#include "stream/protocol/wire.h"

// Messages from page to server.
namespace grove::stream {
namespace {

constexpr std::size_t kMaxNameBytes = 64;
constexpr std::uint32_t kSmallestSide = 16;
constexpr std::uint32_t kLargestSide = 16384;
constexpr std::uint8_t kAllKeys =
    world::kForward | world::kBack | world::kLeft | world::kRight | world::kRun | world::kBlow;
constexpr std::uint8_t kHiddenFlag = 1;
constexpr std::uint8_t kBorderFlag = 2;

bool isGoodSide(std::uint32_t side) { return side >= kSmallestSide && side <= kLargestSide; }

Refusal badSize(std::uint32_t width, std::uint32_t height) {
  return refuseMessage("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                       " pixels is out of range");
}

/// Reads the three reserved bytes after a type; returns whether they are zero.
bool takeReserved(WireReader& reader) {
  const auto first = reader.take<std::uint8_t>();
  return reader.take<std::uint16_t>() == 0 && first == 0;
}

bool isWhole(const WireReader& reader) { return !reader.exhausted() && reader.rest().empty(); }

ClientMessage parseHello(WireReader reader) {
  const auto version = reader.take<std::uint8_t>();
  if (reader.exhausted()) return wrongLength("Hello");
  if (version != kProtocolVersion) return wrongVersion(version);
  const auto nameBytes = reader.take<std::uint16_t>();
  Hello hello;
  hello.width = reader.take<std::uint32_t>();
  hello.height = reader.take<std::uint32_t>();
  if (reader.exhausted() || reader.rest().size() != nameBytes) return wrongLength("Hello");
  if (nameBytes > kMaxNameBytes) return refuseMessage("the name is longer than 64 bytes");
  if (!isGoodSide(hello.width) || !isGoodSide(hello.height)) return badSize(hello.width, hello.height);
  hello.name = printable(reader.restAsText(), kMaxNameBytes);
  return hello;
}

ClientMessage parseInput(WireReader reader) {
  world::Input input;
  input.keys = reader.take<std::uint8_t>() & kAllKeys;
  const bool zero = reader.take<std::uint16_t>() == 0;
  input.number = reader.take<std::uint32_t>();
  input.yaw = reader.take<float>();
  input.pitch = reader.take<float>();
  if (!isWhole(reader)) return wrongLength("Input");
  if (!zero) return reservedBytes("Input");
  if (!std::isfinite(input.yaw) || !std::isfinite(input.pitch)) {
    return refuseMessage("the camera's angles are not numbers");
  }
  return input;
}

ClientMessage parseAck(WireReader reader) {
  const bool zero = takeReserved(reader);
  const Ack ack{reader.take<std::uint32_t>()};
  if (!isWhole(reader)) return wrongLength("Ack");
  if (!zero) return reservedBytes("Ack");
  return ack;
}

ClientMessage parseResize(WireReader reader) {
  const bool zero = takeReserved(reader);
  Resize resize;
  resize.width = reader.take<std::uint32_t>();
  resize.height = reader.take<std::uint32_t>();
  if (!isWhole(reader)) return wrongLength("Resize");
  if (!zero) return reservedBytes("Resize");
  if (!isGoodSide(resize.width) || !isGoodSide(resize.height)) return badSize(resize.width, resize.height);
  return resize;
}

ClientMessage parseOffer(WireReader reader) {
  const auto count = reader.take<std::uint8_t>();
  if (reader.exhausted() || reader.rest().size() != count) return wrongLength("Offer");
  if (count == 0 || count > kMaxCodecs) return refuseMessage("an offer of " + std::to_string(count) + " codecs");
  return Offer{{reader.rest().begin(), reader.rest().end()}};
}

ClientMessage parseLimits(WireReader reader) {
  const auto flags = reader.take<std::uint8_t>();
  Limits limits;
  limits.framesPerSecond = reader.take<std::uint8_t>();
  bool zero = reader.take<std::uint8_t>() == 0;
  limits.kilobitsPerSecond = reader.take<std::uint32_t>();
  limits.lines = reader.take<std::uint16_t>();
  zero = reader.take<std::uint16_t>() == 0 && zero && (flags & ~(kHiddenFlag | kBorderFlag)) == 0;
  if (!isWhole(reader)) return wrongLength("Limits");
  if (!zero) return reservedBytes("Limits");
  limits.hidden = (flags & kHiddenFlag) != 0;
  limits.border = (flags & kBorderFlag) != 0;
  return limits;
}

ClientMessage parseBroken(WireReader reader) {
  const bool zero = takeReserved(reader);
  const Broken broken{reader.take<std::uint32_t>()};
  if (!isWhole(reader)) return wrongLength("Broken");
  if (!zero) return reservedBytes("Broken");
  return broken;
}

ClientMessage parsePresented(WireReader reader) {
  const bool zero = reader.take<std::uint8_t>() == 0;
  Presented presented;
  presented.heldTenthsOfMilliseconds = reader.take<std::uint16_t>();
  presented.frame = reader.take<std::uint32_t>();
  presented.arrivedMicroseconds = reader.take<std::uint32_t>();
  if (!isWhole(reader)) return wrongLength("Presented");
  if (!zero) return reservedBytes("Presented");
  return presented;
}

ClientMessage parsePainted(WireReader reader) {
  const bool zero = reader.take<std::uint8_t>() == 0;
  Painted painted;
  painted.heldTenthsOfMilliseconds = reader.take<std::uint16_t>();
  painted.frame = reader.take<std::uint32_t>();
  painted.arrivedMicroseconds = reader.take<std::uint32_t>();
  painted.decodeTenthsOfMilliseconds = reader.take<std::uint16_t>();
  painted.paintTenthsOfMilliseconds = reader.take<std::uint16_t>();
  if (!isWhole(reader)) return wrongLength("Painted");
  if (!zero) return reservedBytes("Painted");
  return painted;
}

ClientMessage parseCapture(WireReader reader) {
  const bool zero = takeReserved(reader);
  const Capture capture{reader.take<std::uint32_t>()};
  if (!isWhole(reader)) return wrongLength("Capture");
  if (!zero) return reservedBytes("Capture");
  return capture;
}

}  // namespace

ClientMessage parseClientMessage(std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return refuseMessage("an empty message");
  if (bytes.size() > kLargestClientMessage) return refuseMessage("a message of more than 256 bytes");
  WireReader reader(bytes);
  const auto type = reader.take<std::uint8_t>();
  switch (static_cast<MessageType>(type)) {
    case MessageType::kHello:
      return parseHello(reader);
    case MessageType::kInput:
      return parseInput(reader);
    case MessageType::kAck:
      return parseAck(reader);
    case MessageType::kResize:
      return parseResize(reader);
    case MessageType::kOffer:
      return parseOffer(reader);
    case MessageType::kLimits:
      return parseLimits(reader);
    case MessageType::kBroken:
      return parseBroken(reader);
    case MessageType::kPresented:
      return parsePresented(reader);
    case MessageType::kPainted:
      return parsePainted(reader);
    case MessageType::kCapture:
      return parseCapture(reader);
    default:
      return refuseMessage("unknown message type " + std::to_string(type));
  }
}

std::vector<std::uint8_t> encode(const Hello& hello) {
  const std::string name = printable(hello.name, kMaxNameBytes);
  WireWriter writer;
  writer.put(toByte(MessageType::kHello)).put(kProtocolVersion).put(static_cast<std::uint16_t>(name.size()));
  writer.put(hello.width).put(hello.height).put(name);
  return writer.take();
}

std::vector<std::uint8_t> encode(const world::Input& input) {
  WireWriter writer;
  writer.put(toByte(MessageType::kInput)).put(input.keys).put(std::uint16_t{0});
  writer.put(input.number).put(input.yaw).put(input.pitch);
  return writer.take();
}

std::vector<std::uint8_t> encode(const Ack& ack) {
  WireWriter writer;
  writer.put(toByte(MessageType::kAck)).put(std::uint8_t{0}).put(std::uint16_t{0}).put(ack.frame);
  return writer.take();
}

std::vector<std::uint8_t> encode(const Resize& resize) {
  WireWriter writer;
  writer.put(toByte(MessageType::kResize)).put(std::uint8_t{0}).put(std::uint16_t{0});
  writer.put(resize.width).put(resize.height);
  return writer.take();
}

std::vector<std::uint8_t> encode(const Offer& offer) {
  WireWriter writer;
  writer.put(toByte(MessageType::kOffer)).put(static_cast<std::uint8_t>(offer.codecs.size()));
  for (const std::uint8_t codec : offer.codecs) writer.put(codec);
  return writer.take();
}

std::vector<std::uint8_t> encode(const Limits& limits) {
  const auto flags = static_cast<std::uint8_t>((limits.hidden ? kHiddenFlag : 0) | (limits.border ? kBorderFlag : 0));
  WireWriter writer;
  writer.put(toByte(MessageType::kLimits)).put(flags).put(limits.framesPerSecond).put(std::uint8_t{0});
  writer.put(limits.kilobitsPerSecond).put(limits.lines).put(std::uint16_t{0});
  return writer.take();
}

std::vector<std::uint8_t> encode(const Broken& broken) {
  WireWriter writer;
  writer.put(toByte(MessageType::kBroken)).put(std::uint8_t{0}).put(std::uint16_t{0}).put(broken.frame);
  return writer.take();
}

std::vector<std::uint8_t> encode(const Presented& presented) {
  WireWriter writer;
  writer.put(toByte(MessageType::kPresented)).put(std::uint8_t{0}).put(presented.heldTenthsOfMilliseconds);
  writer.put(presented.frame).put(presented.arrivedMicroseconds);
  return writer.take();
}

std::vector<std::uint8_t> encode(const Painted& painted) {
  WireWriter writer;
  writer.put(toByte(MessageType::kPainted)).put(std::uint8_t{0}).put(painted.heldTenthsOfMilliseconds);
  writer.put(painted.frame).put(painted.arrivedMicroseconds);
  writer.put(painted.decodeTenthsOfMilliseconds).put(painted.paintTenthsOfMilliseconds);
  return writer.take();
}

std::vector<std::uint8_t> encode(const Capture& capture) {
  WireWriter writer;
  writer.put(toByte(MessageType::kCapture)).put(std::uint8_t{0}).put(std::uint16_t{0}).put(capture.number);
  return writer.take();
}

}  // namespace grove::stream
