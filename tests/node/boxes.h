#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "node/object_type.h"
#include "node/registry.h"

/// The smallest real object type: a box that answers with one flat colour at the distance of its middle. Shows what an
/// object type of one's own needs, and lets the nodes be tested without GL.
namespace grove::node::testing {

class BoxModel final : public world::Model {
 public:
  BoxModel(float size, std::uint32_t colour) : size_(size), colour_(colour) {}
  [[nodiscard]] world::Bounds bounds() const override { return {world::Vec3(-size_ / 2), world::Vec3(size_ / 2)}; }
  [[nodiscard]] std::uint32_t colour() const { return colour_; }

 private:
  float size_;
  std::uint32_t colour_;
};

/// What the test can turn while requests come in.
struct BoxControls {
  std::atomic<bool> fail{false};
  std::atomic<int> answered{0};
};

class BoxBackend final : public BackendHalf {
 public:
  BoxBackend(const BackendServices& services, std::shared_ptr<BoxControls> controls)
      : services_(services), controls_(std::move(controls)) {}
  [[nodiscard]] NodeKind kind() const override { return NodeKind::kRendering; }
  [[nodiscard]] pipeline::Executor& executor() override { return services_.workers; }
  [[nodiscard]] int concurrency() const override { return services_.workers.width(); }

  void answer(std::span<const Request> requests, std::span<Payload> payloads) override {
    if (controls_->fail) throw std::runtime_error("the box is broken");
    for (std::size_t i = 0; i < requests.size(); ++i) {
      const VisibleObject& visible = requests[i].visible();
      const auto image = services_.images.acquire(visible.rect);
      const auto& model = static_cast<const BoxModel&>(*visible.object.model);
      std::fill(image->colour.begin(), image->colour.end(), model.colour());
      std::fill(image->depth.begin(), image->depth.end(),
                requests[i].view().camera.project(visible.object.bounds.centre()).z);
      payloads[i] = std::shared_ptr<const raster::Image>(image);
      ++controls_->answered;
    }
  }

 private:
  BackendServices services_;
  std::shared_ptr<BoxControls> controls_;
};

class BoxType final : public ObjectType {
 public:
  explicit BoxType(std::shared_ptr<BoxControls> controls) : controls_(std::move(controls)) {}
  [[nodiscard]] std::string_view name() const override { return "box"; }
  [[nodiscard]] std::shared_ptr<const world::Model> model(const world::Parameters& parameters) const override {
    const auto size = static_cast<float>(parameters.number("size", 1.0, 0.01, 100.0));
    const int red = parameters.integer("red", 255, 0, 255);
    return std::make_shared<BoxModel>(size, 0xFF000000U | static_cast<std::uint32_t>(red));
  }
  [[nodiscard]] std::unique_ptr<BackendHalf> makeBackend(const BackendServices& services,
                                                         world::TypeIndex) const override {
    return std::make_unique<BoxBackend>(services, controls_);
  }

 private:
  std::shared_ptr<BoxControls> controls_;
};

}  // namespace grove::node::testing
