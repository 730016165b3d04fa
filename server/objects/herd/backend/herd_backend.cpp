#include "objects/herd/backend/herd_backend.h"

#include <cassert>
#include <cstdint>
#include <limits>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "base/log.h"
#include "node/backend/tick_clock.h"
#include "objects/herd/backend/herd_backend_type.h"
#include "objects/herd/backend/herd_model.h"
#include "objects/herd/backend/mind/herd_simulation.h"
#include "objects/herd/common/deer_skeleton.h"
#include "objects/herd/common/herd_name.h"
#include "objects/herd/common/herd_snapshot.h"
#include "raster/shading/light_bake.h"

namespace grove::objects::herd {
namespace {

constexpr const char* kStage = "Motion Graph Tick";
constexpr int kIdleTicks = 60;  ///< two seconds without visitors before the herd sleeps
/// An animal's share of the sun is looked up each time this many ticks have passed.
constexpr std::uint64_t kTicksPerLook = 5;
constexpr double kAsleep = std::numeric_limits<double>::infinity();

const HerdSettings& settingsOf(const world::ModelledObject& object) {
  const auto* model = dynamic_cast<const HerdModel*>(object.model.get());
  assert(model != nullptr && "an object of this type has this type's model");
  return model->settings();
}

Terrain terrainOf(const world::Layout& layout, const world::ModelledObject& object) {
  std::vector<world::Vec2> fires;
  for (const world::FlickeringLight& light : layout.lights) {
    if (light.flicker > 0.0F) fires.emplace_back(light.light.position.x, light.light.position.z);
  }
  const world::Vec3& home = object.transform.position;
  return {{home.x, home.z}, settingsOf(object).range, layout.hills, layout.obstacles(), fires};
}

}  // namespace

/// One herd, its clock and its newest snapshot.
class HerdBackend::Herd {
 public:
  Herd(const node::BackendServices& services, const MotionGraph& graph, const world::ModelledObject& object)
      : services_(services),
        id_(object.id),
        name_(object.name),
        simulation_(graph, terrainOf(services.scene.layout, object),
                    static_cast<std::size_t>(settingsOf(object).animals),
                    static_cast<std::uint32_t>(settingsOf(object).seed)),
        sun_(simulation_.animals().size(), 1.0F),
        held_(services.memory, "herds", kTypeName, pipeline::Work::kAcrossUser) {
    publish(kAsleep);
    clock_ = std::make_unique<node::TickClock>(kTicksPerSecond, [this] { return tick(); });
    awake_ = services_.world.whileVisited([this] { clock_->wake(); });
  }

  /// Any thread.
  [[nodiscard]] std::shared_ptr<const node::SharedData> newest() {
    const std::lock_guard lock(mutex_);
    return newest_;
  }

 private:
  void publish(double now) {
    if (simulation_.ticks() % kTicksPerLook == 0) look();
    std::vector<Animal> animals = simulation_.animals();
    for (std::size_t i = 0; i < animals.size(); ++i) animals[i].sunShare = sun_[i];
    // Versions count from 1.
    auto next = std::make_shared<const HerdSnapshot>(simulation_.ticks() + 1, now, std::move(animals));
    const std::lock_guard lock(mutex_);
    held_.set(simulation_.bytes() + next->bytes());
    newest_ = std::move(next);
  }

  void look() {
    const world::Vec3 sun = services_.scene.layout.sky.sun;
    for (std::size_t i = 0; i < sun_.size(); ++i) {
      const Animal& animal = simulation_.animals()[i];
      const world::Vec3 back = animal.now.place + world::Vec3(0.0F, kTrunkHeight * animal.size, 0.0F);
      sun_[i] = raster::sunAt(back, sun, services_.geometry.rays());
    }
  }

  node::TickClock::Next tick() noexcept {
    using Next = node::TickClock::Next;
    try {
      const pipeline::TimedRun timed(services_.timeline, kStage, pipeline::Work::kAcrossUser, {}, kTypeName);
      const std::vector<world::Player> visitors = services_.world.players();
      idleTicks_ = visitors.empty() ? idleTicks_ + 1 : 0;
      const bool rests = idleTicks_ >= kIdleTicks;
      simulation_.step(visitors);
      publish(rests ? kAsleep : services_.world.now().value_or(kAsleep));
      services_.announce({{id_, {}}, static_cast<node::Version>(simulation_.ticks() + 1)});
      return rests ? Next::kSleep : Next::kTick;
    } catch (const std::exception& e) {
      services_.timeline.recordFailure(kStage, pipeline::Work::kAcrossUser);
      log::error(std::string(kStage) + " of " + name_ + ": " + e.what());
      return Next::kTick;
    }
  }

  const node::BackendServices& services_;
  const world::ObjectId id_;
  const std::string name_;
  HerdSimulation simulation_;
  std::vector<float> sun_;  ///< share of each animal
  pipeline::HeldMemory held_;
  int idleTicks_ = 0;  ///< without visitors
  std::mutex mutex_;
  std::shared_ptr<const HerdSnapshot> newest_;
  std::unique_ptr<node::TickClock> clock_;  ///< stops before the members that it uses are destroyed
  std::shared_ptr<void> awake_;             ///< held while visitors are present; last, since it uses the clock
};

HerdBackend::HerdBackend(const node::BackendServices& services, world::TypeIndex self)
    : services_(services),
      database_(services_.scene.optionsOf<HerdOptions>(kTypeName).variants),
      graph_(database_,
             [this](float share) {
               if (services_.progress) services_.progress("motion graph", share);
             }),
      held_(services_.memory, "motions", kTypeName, pipeline::Work::kAcrossUser, database_.bytes() + graph_.bytes()) {
  for (const world::ModelledObject& object : services_.scene.objects) {
    if (object.type == self) herds_.emplace(object.id, std::make_unique<Herd>(services_, graph_, object));
  }
}

HerdBackend::~HerdBackend() = default;

void HerdBackend::answer(std::span<const node::Request> requests, std::span<node::Payload> payloads) {
  assert(requests.size() == payloads.size());
  for (std::size_t i = 0; i < requests.size(); ++i) {
    const auto herd = herds_.find(requests[i].object);
    if (herd == herds_.end() || !requests[i].shared) {
      payloads[i] = node::Failure{"herds return only shared data of herds"};
    } else {
      payloads[i] = herd->second->newest();
    }
  }
}

}  // namespace grove::objects::herd
