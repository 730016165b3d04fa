#include <algorithm>
#include <cmath>

#include "stream/protocol/message_type.h"
#include "stream/protocol/printable.h"
#include "stream/protocol/protocol.h"
#include "stream/protocol/server_text_limits.h"
#include "stream/protocol/wire.h"

namespace grove::stream {
namespace {

constexpr std::uint8_t kAllPercent = 100;

bool areFinite(std::initializer_list<float> values) {
  return std::ranges::all_of(values, [](float value) { return std::isfinite(value); });
}

/// Reads red, green, blue; returns 0x00BBGGRR.
std::uint32_t takeColour(WireReader& reader) {
  const std::uint32_t red = reader.take<std::uint8_t>();
  const std::uint32_t green = reader.take<std::uint8_t>();
  const std::uint32_t blue = reader.take<std::uint8_t>();
  return red | (green << 8U) | (blue << 16U);
}

ServerMessage parseWelcome(WireReader reader) {
  const auto version = reader.take<std::uint8_t>();
  if (reader.exhausted()) return wrongLength("Welcome");
  if (version != kProtocolVersion) return wrongVersion(version);
  Welcome welcome;
  welcome.framesPerSecond = reader.take<std::uint16_t>();
  welcome.visitor = reader.take<std::uint32_t>();
  welcome.colour = takeColour(reader);
  const auto worldBytes = reader.take<std::uint8_t>();
  welcome.yaw = reader.take<float>();
  welcome.pitch = reader.take<float>();
  if (reader.exhausted() || reader.rest().size() != worldBytes) return wrongLength("Welcome");
  if (!areFinite({welcome.yaw, welcome.pitch})) return refuseMessage("the camera's angles are not numbers");
  welcome.world = printable(reader.restAsText(), kMaxWorldNameBytes);
  return welcome;
}

ServerMessage parseWaiting(WireReader reader) {
  Waiting waiting;
  waiting.percent = reader.take<std::uint8_t>();
  waiting.place = reader.take<std::uint16_t>();
  const auto stepBytes = reader.take<std::uint32_t>();
  if (reader.exhausted() || reader.rest().size() != stepBytes) return wrongLength("Waiting");
  if (waiting.percent > kAllPercent) return refuseMessage("more than 100 percent");
  if (waiting.place == 0) return refuseMessage("a place before the first");
  if (stepBytes > kMaxStepBytes) return refuseMessage("the step is longer than 64 bytes");
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
  if (frame.header.codec != kCodecJpeg) return refuseMessage("unknown codec " + std::to_string(frame.header.codec));
  frame.picture = reader.rest();
  return frame;
}

Label takeLabel(WireReader& reader, bool& zero) {
  Label label;
  label.visitor = reader.take<std::uint32_t>();
  label.x = reader.take<std::uint16_t>();
  label.y = reader.take<std::uint16_t>();
  label.opacity = reader.take<std::uint8_t>();
  zero = reader.take<std::uint8_t>() == 0 && zero;
  return label;
}

ServerMessage parsePicture(WireReader reader) {
  PictureMessage picture;
  PictureHeader& header = picture.header;
  header.codec = reader.take<std::uint8_t>();
  const auto flags = reader.take<std::uint8_t>();
  header.border = reader.take<std::uint8_t>();
  header.width = reader.take<std::uint16_t>();
  header.height = reader.take<std::uint16_t>();
  header.visitors = reader.take<std::uint16_t>();
  const auto labels = reader.take<std::uint8_t>();
  header.fire = reader.take<std::uint8_t>();
  bool zero = (flags & ~kIndependentFlag) == 0;
  header.frame = reader.take<std::uint32_t>();
  header.lastInput = reader.take<std::uint32_t>();
  header.serverMicroseconds = reader.take<std::uint32_t>();
  header.yaw = reader.take<float>();
  header.pitch = reader.take<float>();
  header.tanHalfX = reader.take<float>();
  header.tanHalfY = reader.take<float>();
  if (labels > kMaxLabels) return refuseMessage("more labels than a picture has");
  for (int i = 0; i < labels; ++i) header.labels.push_back(takeLabel(reader, zero));
  if (reader.exhausted()) return wrongLength("Picture");
  if (header.codec != kCodecJpeg && header.codec != kCodecH264) {
    return refuseMessage("unknown codec " + std::to_string(header.codec));
  }
  if (!zero) return reservedBytes("Picture");
  const bool isCamera = areFinite({header.yaw, header.pitch, header.tanHalfX, header.tanHalfY}) &&
                        header.tanHalfX > 0.0F && header.tanHalfY > 0.0F;
  if (!isCamera) return refuseMessage("the camera of a picture is invalid");
  header.independent = (flags & kIndependentFlag) != 0;
  picture.picture = reader.rest();
  return picture;
}

ServerMessage parseStatus(WireReader reader) {
  Status status;
  const auto limitedBy = reader.take<std::uint8_t>();
  status.framesPerSecond = reader.take<std::uint8_t>();
  status.quality = reader.take<std::uint8_t>();
  status.width = reader.take<std::uint16_t>();
  status.height = reader.take<std::uint16_t>();
  status.roundTripMilliseconds = reader.take<std::uint16_t>();
  status.visitors = reader.take<std::uint16_t>();
  status.kilobitsPerSecond = reader.take<std::uint32_t>();
  status.lastInput = reader.take<std::uint32_t>();
  if (reader.exhausted() || !reader.rest().empty()) return wrongLength("Status");
  if (limitedBy > static_cast<std::uint8_t>(LimitedBy::kBrowser)) return refuseMessage("unknown limit");
  if (status.quality > kAllPercent) return refuseMessage("more than 100 percent");
  status.limitedBy = static_cast<LimitedBy>(limitedBy);
  return status;
}

ServerMessage parseRefining(WireReader reader) {
  Refining refining;
  refining.percent = reader.take<std::uint8_t>();
  refining.secondsLeft = reader.take<std::uint16_t>();
  const auto stepBytes = reader.take<std::uint32_t>();
  if (reader.exhausted() || reader.rest().size() != stepBytes) return wrongLength("Refining");
  if (refining.percent > kAllPercent) return refuseMessage("more than 100 percent");
  if (stepBytes > kMaxStepBytes) return refuseMessage("the step is longer than 64 bytes");
  refining.step = printable(reader.restAsText(), kMaxStepBytes);
  return refining;
}

ServerMessage parseCaptured(WireReader reader) {
  CapturedMessage captured;
  captured.header.codec = reader.take<std::uint8_t>();
  captured.header.width = reader.take<std::uint16_t>();
  captured.header.height = reader.take<std::uint16_t>();
  const bool zero = reader.take<std::uint16_t>() == 0;
  captured.header.number = reader.take<std::uint32_t>();
  if (reader.exhausted()) return wrongLength("Captured");
  if (captured.header.codec != kCodecJpeg) {
    return refuseMessage("unknown codec " + std::to_string(captured.header.codec));
  }
  if (!zero) return reservedBytes("Captured");
  captured.picture = reader.rest();
  return captured;
}

ServerMessage parseTimes(WireReader reader) {
  const bool zero = reader.take<std::uint8_t>() == 0;
  Times times;
  times.queuedTenthsOfMilliseconds = reader.take<std::uint16_t>();
  times.drawnTenthsOfMilliseconds = reader.take<std::uint16_t>();
  times.encodedTenthsOfMilliseconds = reader.take<std::uint16_t>();
  times.socketTenthsOfMilliseconds = reader.take<std::uint16_t>();
  times.lineTenthsOfMilliseconds = reader.take<std::uint16_t>();
  if (reader.exhausted() || !reader.rest().empty()) return wrongLength("Times");
  if (!zero) return reservedBytes("Times");
  return times;
}

ServerMessage parsePeople(WireReader reader) {
  const auto flags = reader.take<std::uint8_t>();
  People people;
  people.othersAreLost = flags != 0;
  const auto count = reader.take<std::uint16_t>();
  for (int i = 0; i < count && !reader.exhausted(); ++i) {
    Person person;
    person.visitor = reader.take<std::uint32_t>();
    person.colour = takeColour(reader);
    const auto nameBytes = reader.take<std::uint8_t>();
    if (nameBytes > kMaxPersonNameBytes) return refuseMessage("a name is longer than 64 bytes");
    person.name = printable(reader.takeText(nameBytes), kMaxPersonNameBytes);
    people.people.push_back(std::move(person));
  }
  if (reader.exhausted() || !reader.rest().empty()) return wrongLength("People");
  if (flags > 1) return reservedBytes("People");
  return people;
}

}  // namespace

ServerMessage parseServerMessage(std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return refuseMessage("an empty message");
  WireReader reader(bytes);
  const auto type = reader.take<std::uint8_t>();
  switch (static_cast<MessageType>(type)) {
    case MessageType::kWelcome:
      return parseWelcome(reader);
    case MessageType::kFrame:
      return parseFrame(reader);
    case MessageType::kWaiting:
      return parseWaiting(reader);
    case MessageType::kPicture:
      return parsePicture(reader);
    case MessageType::kStatus:
      return parseStatus(reader);
    case MessageType::kRefining:
      return parseRefining(reader);
    case MessageType::kCaptured:
      return parseCaptured(reader);
    case MessageType::kTimes:
      return parseTimes(reader);
    case MessageType::kPeople:
      return parsePeople(reader);
    default:
      return refuseMessage("unknown message type " + std::to_string(type));
  }
}

}  // namespace grove::stream
