#include <cmath>

#include "stream/protocol/fields.h"
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
constexpr std::uint8_t kNearnessFlag = 4;

bool isGoodSide(std::uint32_t side) { return side >= kSmallestSide && side <= kLargestSide; }

Refusal badSize(std::uint32_t width, std::uint32_t height) {
  return refuseMessage("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                       " pixels is out of range");
}

/// Reads a message that may have any values.
template <class Message>
ClientMessage parseAny(WireReader reader, std::string_view name) {
  Message message;
  if (auto refusal = parseFields(reader, name, message)) return *std::move(refusal);
  return message;
}

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
  if (auto refusal = parseFields(reader, "Input", input)) return *std::move(refusal);
  if (!std::isfinite(input.yaw) || !std::isfinite(input.pitch)) {
    return refuseMessage("the camera's angles are not numbers");
  }
  input.keys &= kAllKeys;
  return input;
}

ClientMessage parseResize(WireReader reader) {
  Resize resize;
  if (auto refusal = parseFields(reader, "Resize", resize)) return *std::move(refusal);
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
  into(reader)(limits.framesPerSecond, Reserved<1>(), limits.kilobitsPerSecond, limits.lines, Reserved<2>());
  if (!reader.whole()) return wrongLength("Limits");
  if (!reader.zeros() || (flags & ~(kHiddenFlag | kBorderFlag | kNearnessFlag)) != 0) return reservedBytes("Limits");
  limits.hidden = (flags & kHiddenFlag) != 0;
  limits.border = (flags & kBorderFlag) != 0;
  limits.nearness = (flags & kNearnessFlag) != 0;
  return limits;
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
      return parseAny<Ack>(reader, "Ack");
    case MessageType::kResize:
      return parseResize(reader);
    case MessageType::kOffer:
      return parseOffer(reader);
    case MessageType::kLimits:
      return parseLimits(reader);
    case MessageType::kBroken:
      return parseAny<Broken>(reader, "Broken");
    case MessageType::kPresented:
      return parseAny<Presented>(reader, "Presented");
    case MessageType::kPainted:
      return parseAny<Painted>(reader, "Painted");
    case MessageType::kCapture:
      return parseAny<Capture>(reader, "Capture");
    default:
      return refuseMessage("unknown message type " + std::to_string(type));
  }
}

std::vector<std::uint8_t> encode(const Hello& hello) {
  const std::string name = printable(hello.name, kMaxNameBytes);
  WireWriter writer;
  writer.put(MessageType::kHello).put(kProtocolVersion).put(static_cast<std::uint16_t>(name.size()));
  writer.put(hello.width).put(hello.height).put(name);
  return writer.take();
}

std::vector<std::uint8_t> encode(const Offer& offer) {
  WireWriter writer;
  writer.put(MessageType::kOffer).put(static_cast<std::uint8_t>(offer.codecs.size()));
  for (const std::uint8_t codec : offer.codecs) writer.put(codec);
  return writer.take();
}

std::vector<std::uint8_t> encode(const Limits& limits) {
  const auto flags = static_cast<std::uint8_t>((limits.hidden ? kHiddenFlag : 0) | (limits.border ? kBorderFlag : 0) |
                                               (limits.nearness ? kNearnessFlag : 0));
  WireWriter writer;
  writer.put(MessageType::kLimits).put(flags).put(limits.framesPerSecond).put(Reserved<1>());
  writer.put(limits.kilobitsPerSecond).put(limits.lines).put(Reserved<2>());
  return writer.take();
}

std::vector<std::uint8_t> encode(const world::Input& input) { return encodeFields(MessageType::kInput, input); }
std::vector<std::uint8_t> encode(const Ack& ack) { return encodeFields(MessageType::kAck, ack); }
std::vector<std::uint8_t> encode(const Resize& resize) { return encodeFields(MessageType::kResize, resize); }
std::vector<std::uint8_t> encode(const Broken& broken) { return encodeFields(MessageType::kBroken, broken); }
std::vector<std::uint8_t> encode(const Presented& presented) {
  return encodeFields(MessageType::kPresented, presented);
}
std::vector<std::uint8_t> encode(const Painted& painted) { return encodeFields(MessageType::kPainted, painted); }
std::vector<std::uint8_t> encode(const Capture& capture) { return encodeFields(MessageType::kCapture, capture); }

}  // namespace grove::stream
