#include "objects/lightfield/common/field_info.h"

#include <limits>

#include "objects/lightfield/common/packed_camera.h"
#include "objects/lightfield/format/light_field.h"

namespace grove::objects::lightfield {
namespace {

constexpr float kMaxMetres = 1.0e5F;
constexpr float kMaxError = 1024.0F;

}  // namespace

node::PackedBytes FieldInfo::pack() const {
  node::PackWriter writer;
  putVec3(writer, parts_.geometry.centre);
  putVec3(writer, parts_.geometry.target);
  writer.put(parts_.geometry.radius).put(parts_.geometry.extent);
  writer.put(parts_.viewSize).put(parts_.number).put(parts_.maxError).put(static_cast<std::uint8_t>(parts_.hasNear));
  return writer.take();
}

std::shared_ptr<FieldInfo> FieldInfo::unpack(std::span<const std::byte> bytes, node::Version version) {
  node::PackReader reader(bytes, "what a light field is");
  Parts parts;
  parts.geometry.centre = takeVec3(reader);
  parts.geometry.target = takeVec3(reader);
  parts.geometry.radius = reader.takeFinite(1.0e-3F, kMaxMetres);
  parts.geometry.extent = reader.takeFinite(1.0e-3F, kMaxMetres);
  if (!seesItsBall(parts.geometry)) reader.fail("has a radius out of range");
  parts.viewSize = reader.takeWithin(kMinSize, kMaxSize);
  parts.number = reader.takeWithin(0, std::numeric_limits<int>::max());
  parts.maxError = reader.takeFinite(0.0F, kMaxError);
  parts.hasNear = reader.takeWithin<std::uint8_t>(0, 1) == 1;
  reader.finish();
  return std::make_shared<FieldInfo>(parts, version);
}

}  // namespace grove::objects::lightfield
