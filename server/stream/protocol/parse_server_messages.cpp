#include <algorithm>
#include <cmath>

#include "stream/protocol/fields.h"
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

/// Reads the end of a message, the name of a step that is `percent` done.
std::optional<Refusal> parseStep(WireReader reader, std::string_view message, std::uint8_t percent, std::string& step) {
  const auto stepBytes = reader.take<std::uint32_t>();
  if (reader.exhausted() || reader.rest().size() != stepBytes) return wrongLength(message);
  if (percent > kAllPercent) return refuseMessage("more than 100 percent");
  if (stepBytes > kMaxStepBytes) return refuseMessage("the step is longer than 64 bytes");
  step = printable(reader.restAsText(), kMaxStepBytes);
  return std::nullopt;
}

ServerMessage parseWaiting(WireReader reader) {
  Waiting waiting;
  into(reader)(waiting.percent, waiting.place);
  if (auto refusal = parseStep(reader, "Waiting", waiting.percent, waiting.step)) return *std::move(refusal);
  if (waiting.place == 0) return refuseMessage("a place before the first");
  return waiting;
}

ServerMessage parseRefining(WireReader reader) {
  Refining refining;
  into(reader)(refining.percent, refining.secondsLeft);
  if (auto refusal = parseStep(reader, "Refining", refining.percent, refining.step)) return *std::move(refusal);
  return refining;
}

Refusal unknownCodec(std::uint8_t codec) { return refuseMessage("unknown codec " + std::to_string(codec)); }

ServerMessage parseFrame(WireReader reader) {
  FrameMessage frame;
  fields(frame.header, into(reader));
  if (reader.exhausted()) return wrongLength("Frame");
  if (frame.header.codec != kCodecJpeg) return unknownCodec(frame.header.codec);
  frame.picture = reader.rest();
  return frame;
}

/// Returns nothing if it is cut short.
std::optional<Space> takeSpace(WireReader& reader) {
  Space space;
  std::uint16_t nearnessBytes = 0;
  std::uint8_t moving = 0;
  fields(space, nearnessBytes, moving, into(reader));
  for (int i = 0; i < moving && !reader.exhausted(); ++i) fields(space.moving.emplace_back(), into(reader));
  const std::span<const std::uint8_t> nearness = reader.takeBytes(nearnessBytes);
  if (reader.exhausted()) return std::nullopt;
  space.nearness.assign(nearness.begin(), nearness.end());
  return space;
}

bool isValid(const MovingPart& part) {
  return part.left < part.right && part.top < part.bottom && part.nearestCentimetres > 0 &&
         part.nearestCentimetres <= part.farthestCentimetres && areFinite({part.velocity.x, part.velocity.y});
}

bool isValid(const Space& space) {
  const bool areParts = space.moving.size() <= kMaxMovingParts &&
                        std::ranges::all_of(space.moving, [](const MovingPart& part) { return isValid(part); });
  return areParts && areFinite({space.eye.x, space.eye.y, space.eye.z, space.visitor.x, space.visitor.y,
                                space.visitor.z, space.velocity.x, space.velocity.y});
}

ServerMessage parsePicture(WireReader reader) {
  PictureMessage picture;
  PictureHeader& header = picture.header;
  std::uint8_t flags = 0;
  std::uint8_t labels = 0;
  fields(header, flags, labels, into(reader));
  if (labels > kMaxLabels) return refuseMessage("more labels than a picture has");
  for (int i = 0; i < labels; ++i) fields(header.labels.emplace_back(), into(reader));
  if ((flags & kSpaceFlag) != 0) header.space = takeSpace(reader);
  if (reader.exhausted() || reader.rest().empty()) return wrongLength("Picture");
  if (header.codec < kCodecJpeg || header.codec > kCodecJpegPatches) return unknownCodec(header.codec);
  if (!reader.zeros() || (flags & ~(kIndependentFlag | kSpaceFlag)) != 0) return reservedBytes("Picture");
  const bool isCamera = areFinite({header.yaw, header.pitch, header.tanHalfX, header.tanHalfY}) &&
                        header.tanHalfX > 0.0F && header.tanHalfY > 0.0F;
  if (!isCamera || (header.space && !isValid(*header.space)))
    return refuseMessage("the camera of a picture is invalid");
  header.independent = (flags & kIndependentFlag) != 0;
  picture.picture = reader.rest();
  return picture;
}

ServerMessage parseStatus(WireReader reader) {
  Status status;
  if (auto refusal = parseFields(reader, "Status", status)) return *std::move(refusal);
  if (status.limitedBy > LimitedBy::kBrowser) return refuseMessage("unknown limit");
  if (status.quality > kAllPercent) return refuseMessage("more than 100 percent");
  return status;
}

ServerMessage parseCaptured(WireReader reader) {
  CapturedMessage captured;
  fields(captured.header, into(reader));
  if (reader.exhausted()) return wrongLength("Captured");
  if (captured.header.codec != kCodecJpeg) return unknownCodec(captured.header.codec);
  if (!reader.zeros()) return reservedBytes("Captured");
  captured.picture = reader.rest();
  return captured;
}

ServerMessage parseTimes(WireReader reader) {
  Times times;
  if (auto refusal = parseFields(reader, "Times", times)) return *std::move(refusal);
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
  if (!reader.whole()) return wrongLength("People");
  if (flags > 1) return reservedBytes("People");
  return people;
}

ServerMessage parseGround(WireReader reader) {
  Ground ground;
  const auto hills = reader.take<std::uint8_t>();
  const auto obstacles = reader.take<std::uint16_t>();
  ground.radius = reader.take<float>();
  if (hills > world::kMaxHills) return refuseMessage("more hills than a scene has");
  if (obstacles > kMaxGroundObstacles) return refuseMessage("more than 4096 obstacles");
  for (int i = 0; i < hills; ++i) fields(ground.hills.emplace_back(), into(reader));
  for (int i = 0; i < obstacles && !reader.exhausted(); ++i) fields(ground.obstacles.emplace_back(), into(reader));
  if (!reader.whole()) return wrongLength("Ground");
  const bool isFinite =
      std::ranges::all_of(
          ground.hills,
          [](const world::Hill& hill) {
            return areFinite({hill.centre.x, hill.centre.y, hill.radius, hill.height}) && hill.radius > 0.0F;
          }) &&
      std::ranges::all_of(ground.obstacles, [](const world::Obstacle& obstacle) {
        return areFinite({obstacle.centre.x, obstacle.centre.y, obstacle.radius}) && obstacle.radius > 0.0F;
      });
  if (!isFinite || !std::isfinite(ground.radius) || ground.radius <= 0.0F)
    return refuseMessage("the ground is invalid");
  return ground;
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
    case MessageType::kGround:
      return parseGround(reader);
    default:
      return refuseMessage("unknown message type " + std::to_string(type));
  }
}

}  // namespace grove::stream
