#include "stream/host.h"

#include <algorithm>
#include <chrono>
#include <future>
#include <set>
#include <utility>

#include "gl/workers.h"
#include "node/transport/in_process.h"

namespace grove::stream {

Host::Host(world::World::Layout layout, const node::Registry& registry, gl::Workers& gl, const HostOptions& options,
           const std::function<void(std::string_view, float)>& progress)
    : registry_(registry),
      gl_(gl),
      options_(options),
      world_(std::move(layout)),
      transport_(std::make_unique<node::InProcessTransport>()),
      workers_(static_cast<int>(std::max(1U, std::thread::hardware_concurrency()))) {
  const node::BackendServices services{world_, workers_, gl_, timeline_, memory_, images_, progress};
  std::set<world::TypeIndex> types;
  for (const world::Object& object : world_.objects()) types.insert(object.type);
  if (world_.visitor()) types.insert(world_.visitor()->type);
  std::vector<std::future<std::unique_ptr<node::BackendNode>>> prepared;
  prepared.reserve(types.size());
  for (const world::TypeIndex type : types) {
    prepared.push_back(std::async(std::launch::async, [this, type, services] {
      return std::make_unique<node::BackendNode>(registry_.type(type), type, services, *transport_);
    }));
  }
  for (auto& backend : prepared) backends_.push_back(backend.get());
  clock_ = std::thread([this] { runClock(); });
}

Host::~Host() {
  std::vector<std::shared_ptr<Session>> open;
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    for (const auto& [id, weak] : sessions_) {
      if (auto session = weak.lock()) open.push_back(std::move(session));
    }
  }
  clockWake_.notify_all();
  clock_.join();
  for (const auto& session : open) session->close();
  for (const auto& backend : backends_) backend->close();
  // Runs in progress use the backends; with every queue closed, none can start after these.
  pipeline::drain(workers_);
  pipeline::drain(gl_);
  pipeline::drain(workers_);
}

std::variant<std::shared_ptr<Session>, Refusal> Host::open(const Hello& hello, FrameSink sink) {
  const auto [width, height] = fitSize(hello.width, hello.height);
  node::SessionId id = 0;
  {
    const std::lock_guard lock(mutex_);
    if (stopping_) return Refusal{CloseCode::kGoingAway, "the server stops"};
    if (sessions_.size() >= static_cast<std::size_t>(options_.mostVisitors)) {
      return Refusal{CloseCode::kFull, "the world is full (" + std::to_string(options_.mostVisitors) + " visitors)"};
    }
    id = nextSession_++;
    sessions_[id] = {};  // keeps the place
  }
  const std::string name = hello.name.empty() ? "Visitor " + std::to_string(id) : hello.name;
  const world::PlayerId player = world_.players().join(name, world::World::now());
  const auto session = std::make_shared<Session>(*this, id, player, width, height, std::move(sink));
  session->begin();
  {
    const std::lock_guard lock(mutex_);
    sessions_[id] = session;
    sessionsChanged_ = true;
  }
  clockWake_.notify_all();
  return session;
}

std::size_t Host::visitors() const {
  const std::lock_guard lock(mutex_);
  return sessions_.size();
}

node::FrontendServices Host::frontendServices() {
  return {world_, registry_, *transport_, workers_, timeline_, memory_, images_};
}

void Host::remove(node::SessionId id) {
  const std::lock_guard lock(mutex_);
  sessions_.erase(id);
}

void Host::runClock() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    std::vector<std::shared_ptr<Session>> open;
    for (const auto& [id, weak] : sessions_) {
      if (auto session = weak.lock()) open.push_back(std::move(session));
    }
    lock.unlock();
    const double now = world::World::now();
    double next = now + 1.0;
    for (const auto& session : open) next = std::min(next, session->tick(now));
    open.clear();
    lock.lock();
    if (stopping_) return;
    clockWake_.wait_for(lock, std::chrono::duration<double>(std::max(0.0, next - world::World::now())),
                        [this] { return stopping_ || sessionsChanged_; });
    sessionsChanged_ = false;
  }
}

}  // namespace grove::stream
