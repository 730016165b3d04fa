#include "stream/protocol.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <string_view>

#include "stream/printable.h"
#include "stream/wire.h"

namespace grove::stream {
namespace {

enum class Type : std::uint8_t {
  kHello = 0x01,
  kInput = 0x02,
  kAck = 0x03,
  kResize = 0x04,
  kWelcome = 0x81,
  kFrame = 0x82,
  kWaiting = 0x83,
};

constexpr std::size_t kMostNameBytes = 64;
constexpr std::size_t kMostWorldNameBytes = 255;
constexpr std::size_t kMaxStepBytes = 64;
constexpr std::uint8_t kAllPercent = 100;
constexpr std::uint32_t kSmallestSide = 16;
constexpr std::uint32_t kLargestSide = 16384;
constexpr std::uint8_t kAllKeys =
    world::kForward | world::kBack | world::kLeft | world::kRight | world::kRun | world::kBlow;

constexpr std::uint8_t toByte(Type type) { return static_cast<std::uint8_t>(type); }

Refusal refuse(std::string reason) { return {CloseCode::kProtocolError, std::move(reason)}; }

Refusal wrongLength(std::string_view message) { return refuse(std::string(message) + " has the wrong length"); }

Refusal wrongVersion(std::uint8_t version) {
  return {CloseCode::kWrongVersion, "protocol version " + std::to_string(version) + ", here is version " +
                                        std::to_string(kProtocolVersion) + ": reload the page"};
}

bool isGoodSide(std::uint32_t side) { return side >= kSmallestSide && side <= kLargestSide; }

Refusal badSize(std::uint32_t width, std::uint32_t height) {
  return refuse("a picture of " + std::to_string(width) + " x " + std::to_string(height) + " pixels is out of range");
}

/// The three reserved bytes after a type.
bool takeReserved(WireReader& reader) {
  const auto first = reader.take<std::uint8_t>();
  return reader.take<std::uint16_t>() == 0 && first == 0;
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
  if (nameBytes > kMostNameBytes) return refuse("the name is longer than 64 bytes");
  if (!isGoodSide(hello.width) || !isGoodSide(hello.height)) return badSize(hello.width, hello.height);
  hello.name = printable(reader.restAsText(), kMostNameBytes);
  return hello;
}

ClientMessage parseInput(WireReader reader) {
  world::Input input;
  input.keys = reader.take<std::uint8_t>() & kAllKeys;
  const bool zero = reader.take<std::uint16_t>() == 0;
  input.number = reader.take<std::uint32_t>();
  input.yaw = reader.take<float>();
  input.pitch = reader.take<float>();
  if (reader.exhausted() || !reader.rest().empty()) return wrongLength("Input");
  if (!zero) return refuse("reserved bytes of Input are not zero");
  if (!std::isfinite(input.yaw) || !std::isfinite(input.pitch)) return refuse("the camera's angles are not numbers");
  return input;
}

ClientMessage parseAck(WireReader reader) {
  const bool zero = takeReserved(reader);
  const Ack ack{reader.take<std::uint32_t>()};
  if (reader.exhausted() || !reader.rest().empty()) return wrongLength("Ack");
  if (!zero) return refuse("reserved bytes of Ack are not zero");
  return ack;
}

ClientMessage parseResize(WireReader reader) {
  const bool zero = takeReserved(reader);
  Resize resize;
  resize.width = reader.take<std::uint32_t>();
  resize.height = reader.take<std::uint32_t>();
  if (reader.exhausted() || !reader.rest().empty()) return wrongLength("Resize");
  if (!zero) return refuse("reserved bytes of Resize are not zero");
  if (!isGoodSide(resize.width) || !isGoodSide(resize.height)) return badSize(resize.width, resize.height);
  return resize;
}

ServerMessage parseWelcome(WireReader reader) {
  const auto version = reader.take<std::uint8_t>();
  if (reader.exhausted()) return wrongLength("Welcome");
  if (version != kProtocolVersion) return wrongVersion(version);
  Welcome welcome;
  welcome.framesPerSecond = reader.take<std::uint16_t>();
  welcome.visitor = reader.take<std::uint32_t>();
  const std::uint32_t red = reader.take<std::uint8_t>();
  const std::uint32_t green = reader.take<std::uint8_t>();
  const std::uint32_t blue = reader.take<std::uint8_t>();
  welcome.colour = red | (green << 8U) | (blue << 16U);
  const auto worldBytes = reader.take<std::uint8_t>();
  welcome.yaw = reader.take<float>();
  welcome.pitch = reader.take<float>();
  if (reader.exhausted() || reader.rest().size() != worldBytes) return wrongLength("Welcome");
  if (!std::isfinite(welcome.yaw) || !std::isfinite(welcome.pitch))
    return refuse("the camera's angles are not numbers");
  welcome.world = printable(reader.restAsText(), kMostWorldNameBytes);
  return welcome;
}

ServerMessage parseWaiting(WireReader reader) {
  Waiting waiting;
  waiting.percent = reader.take<std::uint8_t>();
  waiting.place = reader.take<std::uint16_t>();
  const auto stepBytes = reader.take<std::uint32_t>();
  if (reader.exhausted() || reader.rest().size() != stepBytes) return wrongLength("Waiting");
  if (waiting.percent > kAllPercent) return refuse("more than 100 percent");
  if (waiting.place == 0) return refuse("a place before the first");
  if (stepBytes > kMaxStepBytes) return refuse("the step is longer than 64 bytes");
  waiting.step = printable(reader.restAsText(), kMaxStepBytes);
  return waiting;
}

ServerMessage parseFrame(WireReader reader) {
  FrameMessage frame;
  frame.header.codec = reader.take<std::uint8_t>();
  frame.header.width = reader.take<std::uint16_t>();
  frame.header.height = reader.take<std::uint16_t>();
  frame.header.visitors = reader.take<std::uint16_t>();
  frame.header.frame = reader.take<std::uint32_t>();
  frame.header.lastInput = reader.take<std::uint32_t>();
  frame.header.serverMicroseconds = reader.take<std::uint32_t>();
  if (reader.exhausted()) return wrongLength("Frame");
  if (frame.header.codec != kCodecJpeg) return refuse("unknown codec " + std::to_string(frame.header.codec));
  frame.picture = reader.rest();
  return frame;
}

}  // namespace

ClientMessage parseClientMessage(std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return refuse("an empty message");
  if (bytes.size() > kLargestClientMessage) return refuse("a message of more than 256 bytes");
  WireReader reader(bytes);
  const auto type = reader.take<std::uint8_t>();
  switch (static_cast<Type>(type)) {
    case Type::kHello:
      return parseHello(reader);
    case Type::kInput:
      return parseInput(reader);
    case Type::kAck:
      return parseAck(reader);
    case Type::kResize:
      return parseResize(reader);
    default:
      return refuse("unknown message type " + std::to_string(type));
  }
}

ServerMessage parseServerMessage(std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return refuse("an empty message");
  WireReader reader(bytes);
  const auto type = reader.take<std::uint8_t>();
  switch (static_cast<Type>(type)) {
    case Type::kWelcome:
      return parseWelcome(reader);
    case Type::kFrame:
      return parseFrame(reader);
    case Type::kWaiting:
      return parseWaiting(reader);
    default:
      return refuse("unknown message type " + std::to_string(type));
  }
}

std::vector<std::uint8_t> encode(const Welcome& welcome) {
  const std::string world = printable(welcome.world, kMostWorldNameBytes);
  WireWriter writer;
  writer.put(toByte(Type::kWelcome)).put(kProtocolVersion).put(welcome.framesPerSecond).put(welcome.visitor);
  for (const std::uint32_t shift : {0U, 8U, 16U}) writer.put(static_cast<std::uint8_t>(welcome.colour >> shift));
  writer.put(static_cast<std::uint8_t>(world.size())).put(welcome.yaw).put(welcome.pitch).put(world);
  return writer.take();
}

std::vector<std::uint8_t> encode(const Waiting& waiting) {
  const std::string step = printable(waiting.step, kMaxStepBytes);
  WireWriter writer;
  writer.put(toByte(Type::kWaiting)).put(waiting.percent).put(waiting.place);
  writer.put(static_cast<std::uint32_t>(step.size())).put(step);
  return writer.take();
}

void encode(const FrameHeader& header, std::span<std::uint8_t, kFrameHeaderBytes> out) {
  std::size_t at = 0;
  const auto put = [&](auto value) {
    const auto bytes = toWire(value);
    std::copy(bytes.begin(), bytes.end(), out.begin() + static_cast<std::ptrdiff_t>(at));
    at += bytes.size();
  };
  put(toByte(Type::kFrame));
  put(header.codec);
  put(header.width);
  put(header.height);
  put(header.visitors);
  put(header.frame);
  put(header.lastInput);
  put(header.serverMicroseconds);
  assert(at == kFrameHeaderBytes);
}

std::vector<std::uint8_t> encode(const Hello& hello) {
  const std::string name = printable(hello.name, kMostNameBytes);
  WireWriter writer;
  writer.put(toByte(Type::kHello)).put(kProtocolVersion).put(static_cast<std::uint16_t>(name.size()));
  writer.put(hello.width).put(hello.height).put(name);
  return writer.take();
}

std::vector<std::uint8_t> encode(const world::Input& input) {
  WireWriter writer;
  writer.put(toByte(Type::kInput)).put(input.keys).put(std::uint16_t{0});
  writer.put(input.number).put(input.yaw).put(input.pitch);
  return writer.take();
}

std::vector<std::uint8_t> encode(const Ack& ack) {
  WireWriter writer;
  writer.put(toByte(Type::kAck)).put(std::uint8_t{0}).put(std::uint16_t{0}).put(ack.frame);
  return writer.take();
}

std::vector<std::uint8_t> encode(const Resize& resize) {
  WireWriter writer;
  writer.put(toByte(Type::kResize)).put(std::uint8_t{0}).put(std::uint16_t{0}).put(resize.width).put(resize.height);
  return writer.take();
}

}  // namespace grove::stream
