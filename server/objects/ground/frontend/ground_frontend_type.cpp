#include "objects/ground/frontend/ground_frontend_type.h"

#include <utility>

#include "node/frontend/shared/shared_data_frontend.h"
#include "objects/ground/common/ground_data.h"
#include "objects/ground/frontend/ground_picture.h"

namespace grove::objects::ground {
namespace {

class GroundLayer final : public node::Layer {
 public:
  GroundLayer(const node::VisibleObject& object, const node::View& view, std::shared_ptr<const GroundData> data,
              const GroundLight& light, raster::ImagePool& images)
      : data_(std::move(data)), picture_(data_->maps(), light, view.camera, object.rect, view.lights, images) {}

  [[nodiscard]] bool opaque() const override { return true; }
  [[nodiscard]] std::size_t parts() const override { return picture_.parts(); }
  void makePart(std::size_t part) override { picture_.paint(part); }

  void lay(node::FrameBuilder& rows) override {
    const auto image = picture_.image();
    if (image && !rows.clip(image->rect).empty()) rows.lay(*image);
  }

 private:
  const std::shared_ptr<const GroundData> data_;
  GroundPicture picture_;
};

class GroundFrontend final : public node::SharedDataFrontend {
 public:
  explicit GroundFrontend(const node::FrontendTools& tools) : light_(tools.sky), images_(tools.images) {}

  [[nodiscard]] std::optional<float> stillDistance(const node::VisibleObject& /*object*/,
                                                   world::Vec3 /*eye*/) const override {
    return world::kInfiniteDepth;
  }

 private:
  [[nodiscard]] std::unique_ptr<node::Layer> layerOf(const node::VisibleObject& object,
                                                     std::shared_ptr<const node::SharedData> data,
                                                     const node::View& view) override {
    return std::make_unique<GroundLayer>(object, view, std::static_pointer_cast<const GroundData>(std::move(data)),
                                         light_, images_);
  }

  const GroundLight light_;
  raster::ImagePool& images_;
};

class GroundFrontendType final : public node::FrontendType {
 public:
  [[nodiscard]] std::string_view name() const override { return kTypeName; }

  [[nodiscard]] std::unique_ptr<node::FrontendHalf> makeHalf(const node::FrontendTools& tools) const override {
    return std::make_unique<GroundFrontend>(tools);
  }

  [[nodiscard]] std::shared_ptr<node::SharedData> unpack(const node::Key& /*key*/, node::Version /*version*/,
                                                         std::span<const std::byte> bytes,
                                                         const node::SharedData* /*known*/) const override {
    return GroundData::unpack(bytes);
  }
};

}  // namespace

std::unique_ptr<node::FrontendType> frontendType() { return std::make_unique<GroundFrontendType>(); }

}  // namespace grove::objects::ground
