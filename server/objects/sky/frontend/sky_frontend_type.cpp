#include "objects/sky/frontend/sky_frontend_type.h"

#include <utility>

#include "node/frontend/shared/shared_data_frontend.h"
#include "objects/sky/common/sky_data.h"
#include "objects/sky/frontend/sky_image.h"

namespace grove::objects::sky {
namespace {

class SkyLayer final : public node::Layer {
 public:
  SkyLayer(const node::VisibleObject& object, const node::View& view, std::shared_ptr<const SkyData> data,
           const node::FrontendTools& tools)
      : rect_(object.rect), camera_(view.camera), data_(std::move(data)), sun_(tools.sky.sun), images_(tools.images) {}

  [[nodiscard]] bool opaque() const override { return true; }

  void lay(node::FrameBuilder& rows) override {
    if (const auto image = skyImage(data_->maps(), sun_, camera_, rows.clip(rect_), images_)) rows.lay(*image);
  }

 private:
  const world::Rect rect_;
  const world::Camera& camera_;
  const std::shared_ptr<const SkyData> data_;
  const world::Vec3 sun_;
  raster::ImagePool& images_;
};

class SkyFrontend final : public node::SharedDataFrontend {
 public:
  explicit SkyFrontend(const node::FrontendTools& tools) : tools_(tools) {}

  [[nodiscard]] std::optional<float> stillDistance(const node::VisibleObject& /*object*/,
                                                   world::Vec3 /*eye*/) const override {
    return world::kInfiniteDepth;
  }

 private:
  [[nodiscard]] std::unique_ptr<node::Layer> layerOf(const node::VisibleObject& object,
                                                     std::shared_ptr<const node::SharedData> data,
                                                     const node::View& view) override {
    return std::make_unique<SkyLayer>(object, view, std::static_pointer_cast<const SkyData>(std::move(data)), tools_);
  }

  const node::FrontendTools tools_;
};

}  // namespace

std::string_view SkyFrontendType::name() const { return kTypeName; }

std::unique_ptr<node::FrontendHalf> SkyFrontendType::makeHalf(const node::FrontendTools& tools) const {
  return std::make_unique<SkyFrontend>(tools);
}

std::shared_ptr<node::SharedData> SkyFrontendType::unpack(const node::Key& /*key*/, node::Version /*version*/,
                                                          std::span<const std::byte> bytes,
                                                          const node::SharedData* /*known*/) const {
  return SkyData::unpack(bytes);
}

}  // namespace grove::objects::sky
