#include "objects/herd/frontend/herd_frontend_type.h"

#include <memory>
#include <mutex>
#include <utility>

#include "node/frontend/shared/shared_data_frontend.h"
#include "objects/herd/common/herd_name.h"
#include "objects/herd/frontend/herd_layer.h"

namespace grove::objects::herd {
namespace {

class HerdFrontend final : public node::SharedDataFrontend {
 public:
  HerdFrontend(std::shared_ptr<HerdPainter> painter, const world::Sky& sky) : painter_(std::move(painter)), sky_(sky) {}

 private:
  [[nodiscard]] std::unique_ptr<node::Layer> layerOf(const node::VisibleObject& /*object*/,
                                                     std::shared_ptr<const node::SharedData> data,
                                                     const node::View& view) override {
    return std::make_unique<HerdLayer>(*painter_, std::static_pointer_cast<const HerdSnapshot>(std::move(data)), sky_,
                                       view);
  }

  const std::shared_ptr<HerdPainter> painter_;
  const world::Sky& sky_;
};

class HerdFrontendType final : public node::FrontendType {
 public:
  [[nodiscard]] std::string_view name() const override { return kTypeName; }

  [[nodiscard]] std::unique_ptr<node::FrontendHalf> makeHalf(const node::FrontendTools& tools) const override {
    return std::make_unique<HerdFrontend>(painterOf(tools), tools.sky);
  }

  [[nodiscard]] std::shared_ptr<node::SharedData> unpack(const node::Key& key, node::Version version,
                                                         std::span<const std::byte> bytes,
                                                         const node::SharedData* /*known*/) const override {
    if (!key.empty()) throw node::PackingError("a packed herd: its key is not empty");
    std::shared_ptr<HerdSnapshot> herd = unpackHerd(bytes);
    if (herd->version() != version) throw node::PackingError("a packed herd: it has another tick");
    return herd;
  }

 private:
  /// Returns the painter that all visitors share. It is freed with the last visitor, because it uses the tools.
  [[nodiscard]] std::shared_ptr<HerdPainter> painterOf(const node::FrontendTools& tools) const {
    const std::lock_guard lock(mutex_);
    std::shared_ptr<HerdPainter> painter = painter_.lock();
    if (!painter) painter_ = painter = std::make_shared<HerdPainter>(tools);
    return painter;
  }

  mutable std::mutex mutex_;
  mutable std::weak_ptr<HerdPainter> painter_;
};

}  // namespace

std::unique_ptr<node::FrontendType> frontendType() { return std::make_unique<HerdFrontendType>(); }

}  // namespace grove::objects::herd
