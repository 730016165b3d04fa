#include "objects/lightfield/frontend/light_field_frontend_type.h"

#include "objects/lightfield/common/cached_view.h"
#include "objects/lightfield/common/field_info.h"
#include "objects/lightfield/frontend/light_field_frontend.h"

namespace grove::objects::lightfield {
namespace {

class LightFieldFrontendType final : public node::FrontendType {
 public:
  [[nodiscard]] std::string_view name() const override { return kTypeName; }

  [[nodiscard]] std::unique_ptr<node::FrontendHalf> makeHalf(const node::FrontendTools& tools) const override {
    return std::make_unique<LightFieldFrontend>(tools, recent_);
  }

  [[nodiscard]] std::shared_ptr<node::SharedData> unpack(const node::Key& key, node::Version version,
                                                         std::span<const std::byte> bytes,
                                                         const node::SharedData* /*known*/) const override {
    if (key.empty()) return FieldInfo::unpack(bytes, version);
    return CachedView::unpack(bytes);
  }

 private:
  const std::shared_ptr<RecentCells> recent_ = std::make_shared<RecentCells>();
};

}  // namespace

std::unique_ptr<node::FrontendType> frontendType() { return std::make_unique<LightFieldFrontendType>(); }

}  // namespace grove::objects::lightfield
