#pragma once

#include <algorithm>
#include <atomic>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "node/object_types.h"

/// The smallest real object type: a box that shows one flat colour at the distance of its middle. Shows what an object
/// type of one's own needs, and lets the nodes be tested without GL. Its backend half answers in both ways, with
/// pictures and with shared data; its frontend half asks for one of the two.
namespace grove::node::testing {

class BoxModel final : public world::Model {
 public:
  BoxModel(float size, std::uint32_t colour, float obstacle) : size_(size), colour_(colour), obstacle_(obstacle) {}
  [[nodiscard]] world::Bounds bounds() const override { return {world::Vec3(-size_ / 2), world::Vec3(size_ / 2)}; }
  [[nodiscard]] std::optional<float> obstacleRadius() const override { return obstacle_; }
  [[nodiscard]] std::uint32_t colour() const { return colour_; }

 private:
  float size_;
  std::uint32_t colour_;
  float obstacle_;
};

/// What a box shows, for every visitor; four bytes when packed.
class BoxColour final : public SharedData {
 public:
  BoxColour(Version version, std::uint32_t colour, double cadence = 0.0)
      : SharedData(version, cadence), colour_(colour) {}
  [[nodiscard]] std::uint32_t colour() const { return colour_; }

 private:
  [[nodiscard]] std::size_t ownBytes() const noexcept override { return sizeof(BoxColour); }
  [[nodiscard]] PackedBytes pack() const override {
    PackedBytes bytes(sizeof colour_);
    std::memcpy(bytes.data(), &colour_, sizeof colour_);
    return bytes;
  }
  const std::uint32_t colour_;
};

/// How all boxes of a scene look, `[types.box]`.
struct BoxOptions final : TypeOptions {
  std::uint32_t green = 0;
};

/// What the test can turn while requests come in.
struct BoxControls {
  std::atomic<bool> fail{false};
  std::atomic<int> answered{0};
  std::atomic<Version> version{1};  ///< of the colours; each higher one is redder by one
  std::atomic<Version> known{0};    ///< in the request that was answered last
  std::atomic<double> cadence{0.0};
  std::atomic<bool> hold{false};  ///< who is to answer waits
  std::atomic<int> held{0};       ///< so many do
  std::atomic<int> quality{0};
  std::atomic<SessionId> forgotten{0};  ///< the last one
  /// Of the backend that was made last.
  std::function<void(const Announcement&)> announce;
  const WorldMirror* world = nullptr;
};

class BoxBackend final : public BackendHalf {
 public:
  BoxBackend(const BackendServices& services, world::TypeIndex self, std::shared_ptr<BoxControls> controls)
      : services_(services), green_(services.scene.optionsOf<BoxOptions>("box").green), controls_(std::move(controls)) {
    for (const world::ModelledObject& object : services.scene.objects) {
      if (object.type == self) objects_[object.id] = object;
    }
    controls_->announce = services.announce;
    controls_->world = &services.world;
  }
  [[nodiscard]] NodeKind kind() const override { return NodeKind::kRendering; }
  [[nodiscard]] pipeline::Executor& executor() override { return services_.workers; }
  [[nodiscard]] int concurrency() const override { return services_.workers.width(); }
  void setQuality(int step) override { controls_->quality = step; }
  void forget(SessionId session) override { controls_->forgotten = session; }

  void answer(std::span<const Request> requests, std::span<Payload> payloads) override {
    ++controls_->held;
    controls_->hold.wait(true);
    --controls_->held;
    if (controls_->fail) throw std::runtime_error("the box is broken");
    for (std::size_t i = 0; i < requests.size(); ++i) {
      const world::ModelledObject& object = objects_.at(requests[i].object);
      const Version version = controls_->version;
      const std::uint32_t colour = static_cast<const BoxModel&>(*object.model).colour() + (green_ << 8U) + version - 1;
      if (requests[i].shared) {
        payloads[i] = std::make_shared<const BoxColour>(version, colour, controls_->cadence);
      } else {
        payloads[i] = picture(requests[i], object, colour);
      }
      controls_->known = requests[i].known;
      ++controls_->answered;
    }
  }

 private:
  std::shared_ptr<const raster::Image> picture(const Request& request, const world::Object& object,
                                               std::uint32_t colour) {
    const auto image = services_.images.acquire(request.rect);
    std::ranges::fill(image->colour, colour);
    std::ranges::fill(image->depth, request.view->camera.project(object.bounds.centre()).z);
    return image;
  }

  const BackendServices services_;
  const std::uint32_t green_;
  std::map<world::ObjectId, world::ModelledObject> objects_;
  const std::shared_ptr<BoxControls> controls_;
};

class BoxBackendType final : public BackendType {
 public:
  explicit BoxBackendType(std::shared_ptr<BoxControls> controls) : controls_(std::move(controls)) {}
  [[nodiscard]] std::string_view name() const override { return "box"; }
  [[nodiscard]] std::shared_ptr<const world::Model> model(const world::Parameters& parameters) const override {
    const auto size = static_cast<float>(parameters.number("size", 1.0, 0.01, 100.0));
    const int red = parameters.integer("red", 255, 0, 255);
    const auto obstacle = static_cast<float>(parameters.number("obstacle", 0.0, 0.0, 100.0));
    // Grey, which is the same in every form that a picture takes.
    return std::make_shared<BoxModel>(size, 0xFF000000U | static_cast<std::uint32_t>(red) * 0x010101U, obstacle);
  }
  [[nodiscard]] std::shared_ptr<const TypeOptions> options(const world::Parameters& parameters) const override {
    auto options = std::make_shared<BoxOptions>();
    options->green = static_cast<std::uint32_t>(parameters.integer("green", 0, 0, 255));
    return options;
  }
  [[nodiscard]] std::unique_ptr<BackendHalf> makeHalf(const BackendServices& services,
                                                      world::TypeIndex self) const override {
    return std::make_unique<BoxBackend>(services, self, controls_);
  }

 private:
  const std::shared_ptr<BoxControls> controls_;
};

/// One colour at one depth all over the box's place on the screen.
class BoxLayer final : public Layer {
 public:
  BoxLayer(const world::Rect& rect, std::uint32_t colour, float depth) : rect_(rect), colour_(colour), depth_(depth) {}
  [[nodiscard]] bool opaque() const override { return true; }
  void lay(FrameBuilder& rows) override {
    const world::Rect rect = rows.clip(rect_);
    const auto pixels = static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height());
    const std::vector<std::uint32_t> colours(pixels, colour_);
    const std::vector<float> depths(pixels, depth_);
    rows.lay(rect, colours.data(), depths.data(), rect.width());
  }

 private:
  const world::Rect rect_;
  const std::uint32_t colour_;
  const float depth_;
};

/// Asks for the shared colour instead of a picture.
class SharedBoxFrontend final : public FrontendHalf {
 public:
  [[nodiscard]] Plan plan(const VisibleObject&, const View&, const SharedOf& shared, const Reply* reply) override {
    if (reply != nullptr) return reply->payload;
    if (auto colour = shared.find({})) return Payload(std::move(colour));
    return Ask{.shared = true, .key = {}, .rect = {}};
  }
  [[nodiscard]] std::unique_ptr<Layer> layer(const VisibleObject& object, const Payload& payload,
                                             const View& view) override {
    const auto& shared = std::get<std::shared_ptr<const SharedData>>(payload);
    return std::make_unique<BoxLayer>(object.rect, static_cast<const BoxColour&>(*shared).colour(),
                                      view.camera.project(object.object.bounds.centre()).z);
  }
};

/// Asks for a colour under a key of its own for each direction of the eye.
class BoxOfViewFrontend final : public FrontendHalf {
 public:
  [[nodiscard]] Plan plan(const VisibleObject&, const View& view, const SharedOf& shared, const Reply* reply) override {
    if (reply != nullptr) return reply->payload;
    const Key key = std::to_string(view.camera.pose.yaw);
    if (auto colour = shared.find(key)) return Payload(std::move(colour));
    return Ask{.shared = true, .key = key, .rect = {}};
  }
};

/// `kOfView`: for shared data that depends on the view. `kClocked`: for shared data that comes from a clock.
enum class BoxAsks : std::uint8_t { kPictures, kShared, kOfView, kClocked };

class BoxFrontendType final : public FrontendType {
 public:
  explicit BoxFrontendType(BoxAsks asks) : asks_(asks) {}
  [[nodiscard]] std::string_view name() const override { return "box"; }
  [[nodiscard]] std::unique_ptr<FrontendHalf> makeHalf(const FrontendTools&) const override {
    if (asks_ == BoxAsks::kOfView) return std::make_unique<BoxOfViewFrontend>();
    if (asks_ == BoxAsks::kPictures) return std::make_unique<FrontendHalf>();
    return std::make_unique<SharedBoxFrontend>();
  }
  [[nodiscard]] std::shared_ptr<SharedData> unpack(const Key&, Version version, std::span<const std::byte> bytes,
                                                   const SharedData* /*known*/) const override {
    std::uint32_t colour = 0;
    if (bytes.size() != sizeof colour) throw PackingError("no colour");
    std::memcpy(&colour, bytes.data(), sizeof colour);
    return std::make_shared<BoxColour>(version, colour, asks_ == BoxAsks::kClocked ? 30.0 : 0.0);
  }

 private:
  const BoxAsks asks_;
};

inline BackendTypes boxBackends(const std::shared_ptr<BoxControls>& controls = std::make_shared<BoxControls>()) {
  BackendTypes types;
  types.add(std::make_unique<BoxBackendType>(controls));
  return types;
}

inline FrontendTypes boxFrontends(BoxAsks asks = BoxAsks::kPictures) {
  FrontendTypes types;
  types.add(std::make_unique<BoxFrontendType>(asks));
  return types;
}

}  // namespace grove::node::testing
