#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "node/backend/backend_half.h"
#include "node/backend/backend_services.h"
#include "node/backend/world_mirror.h"
#include "node/object_types.h"

/// An object type that shows nothing and watches the world.
namespace grove::stream::testing {

/// What a backend half sees of the world.
struct Sight {
  const node::WorldMirror* world = nullptr;
  std::atomic<int> wakes{0};
  std::atomic<int> quality{0};
  std::mutex mutex;
  std::vector<node::SessionId> forgotten;

  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const world::Player& player : world->players()) names.push_back(player.name);
    return names;
  }
};

class NoModel final : public world::Model {
 public:
  [[nodiscard]] world::Bounds bounds() const override { return {world::Vec3(-1.0F), world::Vec3(1.0F)}; }
};

class WatchingHalf final : public node::BackendHalf {
 public:
  WatchingHalf(const node::BackendServices& services, Sight& sight)
      : services_(services), sight_(sight), awake_(services.world.whileVisited([&sight] { ++sight.wakes; })) {
    sight.world = &services.world;
  }
  [[nodiscard]] node::NodeKind kind() const override { return node::NodeKind::kSimulation; }
  [[nodiscard]] pipeline::Executor& executor() override { return services_.workers; }
  void setQuality(int step) override { sight_.quality = step; }
  void forget(node::SessionId session) override {
    const std::lock_guard lock(sight_.mutex);
    sight_.forgotten.push_back(session);
  }
  void answer(std::span<const node::Request>, std::span<node::Payload>) override {}

 private:
  const node::BackendServices services_;
  Sight& sight_;
  const std::shared_ptr<void> awake_;
};

class WatchingType final : public node::BackendType {
 public:
  explicit WatchingType(Sight& sight) : sight_(sight) {}
  [[nodiscard]] std::string_view name() const override { return "watcher"; }
  [[nodiscard]] std::shared_ptr<const world::Model> model(const world::Parameters&) const override {
    return std::make_shared<NoModel>();
  }
  [[nodiscard]] std::unique_ptr<node::BackendHalf> makeHalf(const node::BackendServices& services,
                                                            world::TypeIndex) const override {
    return std::make_unique<WatchingHalf>(services, sight_);
  }

 private:
  Sight& sight_;
};

class UnseenType final : public node::FrontendType {
 public:
  [[nodiscard]] std::string_view name() const override { return "watcher"; }
};

inline node::ObjectTypes watchers(Sight& sight) {
  node::ObjectTypes types;
  types.backends.add(std::make_unique<WatchingType>(sight));
  types.frontends.add(std::make_unique<UnseenType>());
  return types;
}

inline node::LoadedScene watchedScene(const node::ObjectTypes& types) {
  return node::loadScene(world::parseScene("[[object]]\ntype = 'watcher'\n", "test"), types.backends);
}

}  // namespace grove::stream::testing
