#include "node/transport/node_router.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "base/log.h"
#include "node/transport/reported_node.h"
#include "pipeline/clocks.h"

namespace grove::node {
namespace {

/// The object that a message concerns; empty if it concerns all nodes.
struct AboutObject {
  std::optional<world::ObjectId> operator()(const Request& request) const { return request.object; }
  std::optional<world::ObjectId> operator()(const Acknowledgement& received) const { return received.what.object; }
  std::optional<world::ObjectId> operator()(const Unsubscribe& ended) const { return ended.what.object; }
  std::optional<world::ObjectId> operator()(const auto& /*other*/) const { return std::nullopt; }
};

}  // namespace

/// One node's messages to the router.
class NodeRouter::Branch final : public FrontendPort {
 public:
  Branch(NodeRouter& router, std::string name, std::shared_ptr<FrontendEnd> end)
      : router_(router), name_(std::move(name)), end_(std::move(end)) {
    end_->connect(*this);
  }
  ~Branch() override { end_->leaveFrontend(); }
  Branch(const Branch&) = delete;
  Branch& operator=(const Branch&) = delete;

  void receive(ToFrontend message) override { router_.receive(*this, std::move(message)); }
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] FrontendEnd& end() const noexcept { return *end_; }
  [[nodiscard]] ReportedNode& reported() noexcept { return reported_; }
  /// Whether its node is in another process and welcomed this one.
  [[nodiscard]] bool isReachable() const { return end_->status().state == LinkState::kWelcomed; }

 private:
  NodeRouter& router_;
  const std::string name_;
  const std::shared_ptr<FrontendEnd> end_;
  ReportedNode reported_;
};

NodeRouter::NodeRouter() = default;
NodeRouter::~NodeRouter() { branches_.clear(); }

void NodeRouter::add(std::string name, std::shared_ptr<FrontendEnd> end) {
  branches_.push_back(std::make_unique<Branch>(*this, std::move(name), std::move(end)));
}

pipeline::PushResult NodeRouter::send(ToBackend message) {
  if (const auto object = std::visit(AboutObject(), message)) {
    const Branch* owner = nullptr;
    {
      const std::shared_lock lock(mutex_);
      const auto found = owners_.find(std::min(*object, world::kFirstPlayerObject));
      if (found != owners_.end()) owner = found->second;
    }
    return owner == nullptr ? pipeline::PushResult::kClosed : owner->end().send(std::move(message));
  }
  pipeline::PushResult best = pipeline::PushResult::kClosed;
  for (const auto& branch : branches_) {
    const pipeline::PushResult result = branch->end().send(message);
    if (best != pipeline::PushResult::kAccepted) best = result;
  }
  return best;
}

LinkTraffic NodeRouter::traffic() const {
  LinkTraffic sum;
  for (const auto& branch : branches_) {
    const LinkTraffic one = branch->end().traffic();
    sum.toBackend += one.toBackend;
    sum.pictures += one.pictures;
    sum.sharedData += one.sharedData;
    sum.headers += one.headers;
  }
  return sum;
}

std::vector<NodeRouter::NodeLink> NodeRouter::links() const {
  const std::shared_lock lock(mutex_);
  std::vector<NodeLink> links;
  links.reserve(branches_.size());
  for (const auto& branch : branches_) {
    const auto isOwn = [&](const auto& owned) {
      return owned.second == branch.get() && owned.first != world::kFirstPlayerObject;
    };
    const auto welcome = welcomes_.find(branch.get());
    links.push_back({.name = branch->name(),
                     .objects = static_cast<std::size_t>(std::ranges::count_if(owners_, isOwn)),
                     .status = branch->end().status(),
                     .traffic = branch->end().traffic(),
                     .pace = branch->end().pace(),
                     .epoch = welcome == welcomes_.end() ? std::nullopt : std::optional(welcome->second.epoch),
                     .report = branch->isReachable() ? branch->reported().report() : std::nullopt});
  }
  return links;
}

std::vector<NodeRouter::NodeEvents> NodeRouter::traces(std::chrono::milliseconds max) {
  const auto until = ReportedNode::Clock::now() + max;
  std::vector<Branch*> asked;
  for (const auto& branch : branches_) {
    if (!branch->isReachable()) continue;
    const TraceRequest request = branch->reported().expectTrace();
    if (branch->end().send(request) == pipeline::PushResult::kAccepted) asked.push_back(branch.get());
  }
  std::vector<NodeEvents> events;
  for (Branch* const branch : asked) {
    auto trace = branch->reported().waitForTrace(until);
    const std::optional<double> ahead = branch->reported().ahead();
    if (!trace || !ahead) continue;
    const double travelled = branch->end().pace().roundTrip.value_or(0.0) / 2.0;
    events.push_back({branch->name(), std::move(trace), std::llround((*ahead + travelled) * 1.0e9)});
  }
  return events;
}

std::vector<NodeWelcome> NodeRouter::welcomes() const {
  const std::shared_lock lock(mutex_);
  std::vector<NodeWelcome> welcomes;
  welcomes.reserve(welcomes_.size());
  for (const auto& [branch, welcome] : welcomes_) welcomes.push_back(welcome);
  return welcomes;
}

ServedObjects NodeRouter::served() const {
  const std::shared_lock lock(mutex_);
  ServedObjects served;
  for (const auto& [id, owner] : owners_) {
    if (id == world::kFirstPlayerObject) {
      served.visitors = true;
    } else {
      served.objects.insert(id);
    }
  }
  return served;
}

std::optional<std::string> NodeRouter::conflict() const {
  const std::shared_lock lock(mutex_);
  return conflict_;
}

void NodeRouter::receive(Branch& from, ToFrontend message) {
  if (auto* const report = std::get_if<NodeReport>(&message)) {
    return from.reported().add(std::move(*report), pipeline::wallSeconds());
  }
  if (auto* const trace = std::get_if<std::shared_ptr<const NodeTrace>>(&message)) {
    return from.reported().add(std::move(*trace));
  }
  if (const auto* const welcome = std::get_if<NodeWelcome>(&message)) welcomed(from, *welcome);
  const auto* const result = std::get_if<Result>(&message);
  const auto* const announcement = std::get_if<Announcement>(&message);
  if ((result != nullptr && !serves(from, result->what.object)) ||
      (announcement != nullptr && !serves(from, announcement->what.object))) {
    return foreign_.warning(from.name() + " names an object that it does not serve");
  }
  frontend_.use([&](FrontendPort* port) {
    if (port != nullptr) port->receive(std::move(message));
  });
}

bool NodeRouter::serves(const Branch& branch, world::ObjectId object) const {
  const std::shared_lock lock(mutex_);
  const auto owner = owners_.find(std::min(object, world::kFirstPlayerObject));
  return owner != owners_.end() && owner->second == &branch;
}

void NodeRouter::welcomed(Branch& from, const NodeWelcome& welcome) {
  from.reported().welcomed();
  const std::unique_lock lock(mutex_);
  std::erase_if(owners_, [&](const auto& owned) { return owned.second == &from; });
  for (const ServedObject& object : welcome.objects) own(from, object.id, object.name);
  if (welcome.visitors) own(from, world::kFirstPlayerObject, "of visitors");
  welcomes_[&from] = welcome;
}

void NodeRouter::own(const Branch& branch, world::ObjectId id, const std::string& name) {
  const auto [owner, isNew] = owners_.try_emplace(id, &branch);
  if (isNew) return;
  conflict_ = "object " + std::to_string(id) + " " + name + " is served by " + owner->second->name() + " and by " +
              branch.name();
  log::error(*conflict_ + ": the first one continues to serve it");
}

}  // namespace grove::node
