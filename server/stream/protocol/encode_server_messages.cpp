#include <algorithm>
#include <cassert>

#include "stream/protocol/fields.h"
#include "stream/protocol/message_type.h"
#include "stream/protocol/printable.h"
#include "stream/protocol/protocol.h"
#include "stream/protocol/server_text_limits.h"
#include "stream/protocol/wire.h"

namespace grove::stream {
namespace {

void putColour(WireWriter& writer, std::uint32_t colour) {
  for (const std::uint32_t shift : {0U, 8U, 16U}) writer.put(static_cast<std::uint8_t>(colour >> shift));
}

/// Writes a header into a buffer of its size.
void encodeInto(std::span<std::uint8_t> out, WireWriter header) {
  const std::vector<std::uint8_t> bytes = header.take();
  assert(bytes.size() == out.size());
  std::ranges::copy(bytes, out.begin());
}

}  // namespace

std::vector<std::uint8_t> encode(const Welcome& welcome) {
  const std::string world = printable(welcome.world, kMaxWorldNameBytes);
  WireWriter writer;
  writer.put(MessageType::kWelcome).put(kProtocolVersion).put(welcome.framesPerSecond).put(welcome.visitor);
  putColour(writer, welcome.colour);
  writer.put(static_cast<std::uint8_t>(world.size())).put(welcome.yaw).put(welcome.pitch).put(world);
  return writer.take();
}

std::vector<std::uint8_t> encode(const Waiting& waiting) {
  const std::string step = printable(waiting.step, kMaxStepBytes);
  WireWriter writer;
  writer.put(MessageType::kWaiting).put(waiting.percent).put(waiting.place);
  writer.put(static_cast<std::uint32_t>(step.size())).put(step);
  return writer.take();
}

std::vector<std::uint8_t> encode(const Refining& refining) {
  const std::string step = printable(refining.step, kMaxStepBytes);
  WireWriter writer;
  writer.put(MessageType::kRefining).put(refining.percent).put(refining.secondsLeft);
  writer.put(static_cast<std::uint32_t>(step.size())).put(step);
  return writer.take();
}

std::vector<std::uint8_t> encode(const People& people) {
  WireWriter writer;
  writer.put(MessageType::kPeople).put(static_cast<std::uint8_t>(people.othersAreLost));
  writer.put(static_cast<std::uint16_t>(people.people.size()));
  for (const Person& person : people.people) {
    const std::string name = printable(person.name, kMaxPersonNameBytes);
    writer.put(person.visitor);
    putColour(writer, person.colour);
    writer.put(static_cast<std::uint8_t>(name.size())).put(name);
  }
  return writer.take();
}

std::vector<std::uint8_t> encode(const Ground& ground) {
  assert(ground.hills.size() <= world::kMaxHills && ground.obstacles.size() <= kMaxGroundObstacles);
  WireWriter writer;
  writer.put(MessageType::kGround).put(static_cast<std::uint8_t>(ground.hills.size()));
  writer.put(static_cast<std::uint16_t>(ground.obstacles.size())).put(ground.radius);
  for (const world::Hill& hill : ground.hills) fields(hill, into(writer));
  for (const world::Obstacle& obstacle : ground.obstacles) fields(obstacle, into(writer));
  return writer.take();
}

std::vector<std::uint8_t> encode(const Status& status) { return encodeFields(MessageType::kStatus, status); }
std::vector<std::uint8_t> encode(const Times& times) { return encodeFields(MessageType::kTimes, times); }

void encode(const FrameHeader& header, std::span<std::uint8_t, kFrameHeaderBytes> out) {
  WireWriter writer;
  writer.put(MessageType::kFrame);
  fields(header, into(writer));
  encodeInto(out, writer);
}

void encode(const PictureHeader& header, std::span<std::uint8_t> out) {
  assert(header.labels.size() <= kMaxLabels);
  const auto flags =
      static_cast<std::uint8_t>((header.independent ? kIndependentFlag : 0) | (header.space ? kSpaceFlag : 0));
  const auto labels = static_cast<std::uint8_t>(header.labels.size());
  WireWriter writer;
  writer.put(MessageType::kPicture);
  fields(header, flags, labels, into(writer));
  for (const Label& label : header.labels) fields(label, into(writer));
  if (header.space) {
    const auto nearnessBytes = static_cast<std::uint16_t>(header.space->nearness.size());
    assert(nearnessBytes == header.space->nearness.size());
    const auto moving = static_cast<std::uint8_t>(header.space->moving.size());
    fields(*header.space, nearnessBytes, moving, into(writer));
    for (const MovingPart& part : header.space->moving) fields(part, into(writer));
    for (const std::uint8_t byte : header.space->nearness) writer.put(byte);
  }
  encodeInto(out, writer);
}

void encode(const CapturedHeader& header, std::span<std::uint8_t, kCapturedHeaderBytes> out) {
  WireWriter writer;
  writer.put(MessageType::kCaptured);
  fields(header, into(writer));
  encodeInto(out, writer);
}

}  // namespace grove::stream
