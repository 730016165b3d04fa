#include "node/frontend/compositor.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "node/frontend/composite.h"
#include "node/limits.h"
#include "world/world.h"

namespace grove::node {
namespace {

constexpr const char* kStage = "Compositor";

/// Tells apart what the objects of each type cost. Objects of one type that follow one another share a measurement,
/// because reading the clock of a thread takes a good part of a microsecond.
class TypeClock {
 public:
  TypeClock(const Registry& registry, pipeline::Timeline& timeline, pipeline::TraceTag tag)
      : registry_(registry), timeline_(timeline), tag_(tag) {}

  void turnTo(world::TypeIndex type) {
    if (type_ == type) return;
    part_.reset();
    part_.emplace(timeline_, kStage, pipeline::Work::kPerUserFrontend, tag_, registry_.type(type).name());
    type_ = type;
  }

 private:
  const Registry& registry_;
  pipeline::Timeline& timeline_;
  const pipeline::TraceTag tag_;
  std::optional<world::TypeIndex> type_;
  std::optional<pipeline::TimedRun> part_;
};

/// What covers all of its pixels comes first, which is cheapest where nothing lies yet; then the others, the nearest
/// first, so that what they hide need not be laid. The payloads are those of a frame's list, back to front.
std::vector<std::size_t> layingOrder(std::span<const Payload> payloads) {
  std::vector<std::size_t> order(payloads.size());
  std::iota(order.begin(), order.end(), 0);
  const auto isOpaque = [&](std::size_t index) {
    const auto* const layer = std::get_if<std::shared_ptr<const Image>>(&payloads[index]);
    return layer != nullptr && *layer != nullptr && (*layer)->opaque;
  };
  const auto others = std::stable_partition(order.begin(), order.end(), isOpaque);
  std::reverse(others, order.end());
  return order;
}

}  // namespace

Compositor::Compositor(const Registry& registry, ImagePool& images, pipeline::MemoryLedger& memory,
                       const FramePolicy& policy, std::function<void()> frameDone, pipeline::Executor& executor,
                       pipeline::Timeline& timeline)
    : Stage({.name = kStage,
             .work = pipeline::Work::kPerUserFrontend,
             .capacity = static_cast<std::size_t>(policy.framesInFlight) * (kMostObjectsPerFrame + 1) + 1},
            executor, timeline),
      registry_(registry),
      timeline_(timeline),
      images_(images),
      memory_(memory),
      frameDone_(std::move(frameDone)),
      table_(static_cast<std::size_t>(policy.framesInFlight)) {}

void Compositor::connect(std::shared_ptr<pipeline::Inlet<FinishedFrame>> next) {
  next_.connect(std::move(next));
  addOutlet(next_);
}

void Compositor::process(std::span<CompositorInput> inputs, pipeline::Run& run) {
  for (CompositorInput& input : inputs) {
    std::optional<CompleteFrame> frame;
    if (const auto* list = std::get_if<std::shared_ptr<const FrameList>>(&input)) {
      table_.open(*list);
      frame = table_.take((*list)->view->frame);
    } else if (Result* result = std::get_if<Result>(&input)) {
      const FrameNumber number = result->frame;
      if (!table_.put(*result)) takeLate(std::move(*result));
      frame = table_.take(number);
    } else {
      frame = takeOverdue();
    }
    if (frame) show(std::move(*frame), run);
  }
}

void Compositor::show(CompleteFrame frame, pipeline::Run& run) {
  struct Done {
    const std::function<void()>& call;
    ~Done() { call(); }
  };
  const Done done{frameDone_};
  const FrameNumber number = frame.list->view->frame;
  if (number <= newestShown_) return;
  newestShown_ = number;
  next_.send(run, FinishedFrame{frame.list->view, composite(frame)});
  lastResults_.keep(std::move(frame));
}

void Compositor::takeLate(Result result) {
  timeline_.count("results that were not waited for");
  if (lastResults_.keepLate(std::move(result))) timeline_.count("results that the next frame may show");
}

std::optional<CompleteFrame> Compositor::takeOverdue() {
  const double now = world::World::now();
  std::optional<CompleteFrame> newest;
  while (auto frame = table_.takeOverdue(now)) {
    // Older ones would be followed by this one at once.
    if (newest) frameDone_();
    newest = std::move(frame);
  }
  if (newest) fillIn(*newest);
  return newest;
}

void Compositor::fillIn(CompleteFrame& frame) {
  for (const std::size_t slot : lastResults_.fillIn(frame)) {
    timeline_.recordFailure(kStage, pipeline::Work::kPerUserFrontend);
    const world::Object& object = frame.list->objects[slot].object;
    overdue_.warning(std::string(registry_.type(object.type).name()) + " " + object.name +
                     ": no result within the deadline of a frame");
  }
}

std::shared_ptr<const Image> Compositor::composite(const CompleteFrame& frame) {
  const View& view = *frame.list->view;
  const auto image = images_.acquire({0, 0, view.camera.width, view.camera.height});
  const auto edges = images_.acquire(image->rect);
  FrameBuilder builder(*image, *edges);
  const auto& objects = frame.list->objects;
  TypeClock clock(registry_, timeline_, traceTag(frame.list));
  for (const std::size_t i : layingOrder(frame.payloads)) {
    clock.turnTo(objects[i].object.type);
    lay(objects[i], frame.payloads[i], view, builder);
  }
  builder.finish();
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (std::holds_alternative<Failure>(frame.payloads[i])) continue;
    clock.turnTo(objects[i].object.type);
    if (FrontendHalf* half = halfOf(objects[i].object.type)) half->draw(objects[i], frame.payloads[i], view, *image);
  }
  tellMemory();
  return image;
}

void Compositor::lay(const VisibleObject& object, const Payload& payload, const View& view, FrameBuilder& frame) {
  if (std::holds_alternative<Failure>(payload)) return;
  if (const auto* layer = std::get_if<std::shared_ptr<const Image>>(&payload)) {
    if (*layer) frame.lay(**layer);
  } else if (FrontendHalf* half = halfOf(object.object.type)) {
    half->lay(object, payload, view, frame);
  }
}

FrontendHalf* Compositor::halfOf(world::TypeIndex type) {
  const auto it = halves_.find(type);
  if (it != halves_.end()) return it->second.half.get();
  return halves_.try_emplace(type, registry_.type(type), memory_).first->second.half.get();
}

void Compositor::tellMemory() {
  for (auto& [type, half] : halves_) {
    if (half.half) half.held.set(half.half->bytes());
  }
}

}  // namespace grove::node
