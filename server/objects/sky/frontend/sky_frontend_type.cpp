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

class SkyFrontendType final : public node::FrontendType {
 public:
  [[nodiscard]] std::string_view name() const override { return kTypeName; }

  [[nodiscard]] std::unique_ptr<node::FrontendHalf> makeHalf(const node::FrontendTools& tools) const override {
    return std::make_unique<SkyFrontend>(tools);
  }

  [[nodiscard]] std::shared_ptr<node::SharedData> unpack(const node::Key& /*key*/, node::Version /*version*/,
                                                         std::span<const std::byte> bytes,
                                                         const node::SharedData* /*known*/) const override {
    return SkyData::unpack(bytes);
  }
};

}  // namespace

std::unique_ptr<node::FrontendType> frontendType() { return std::make_unique<SkyFrontendType>(); }

}  // namespace grove::objects::sky
