#include "objects/lightfield/frontend/light_field_frontend_type.h"

#include "objects/lightfield/common/cached_view.h"
#include "objects/lightfield/common/field_info.h"
#include "objects/lightfield/frontend/light_field_frontend.h"

namespace grove::objects::lightfield {

std::string_view LightFieldFrontendType::name() const { return kTypeName; }

std::unique_ptr<node::FrontendHalf> LightFieldFrontendType::makeHalf(const node::FrontendTools& tools) const {
  return std::make_unique<LightFieldFrontend>(tools);
}

std::shared_ptr<node::SharedData> LightFieldFrontendType::unpack(const node::Key& key, node::Version version,
                                                                 std::span<const std::byte> bytes,
                                                                 const node::SharedData* /*known*/) const {
  if (key.empty()) return FieldInfo::unpack(bytes, version);
  return CachedView::unpack(bytes);
}

}  // namespace grove::objects::lightfield
