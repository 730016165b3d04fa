#include "node/frontend/compositor.h"

#include <optional>
#include <utility>

#include "node/frontend/composite.h"
#include "node/limits.h"

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

}  // namespace

Compositor::Compositor(const Registry& registry, ImagePool& images, pipeline::MemoryLedger& memory, int framesInFlight,
                       std::function<void()> frameDone, pipeline::Executor& executor, pipeline::Timeline& timeline)
    : Stage({.name = kStage,
             .work = pipeline::Work::kPerUserFrontend,
             .capacity = static_cast<std::size_t>(framesInFlight) * (kMostObjectsPerFrame + 1)},
            executor, timeline),
      registry_(registry),
      timeline_(timeline),
      images_(images),
      memory_(memory),
      frameDone_(std::move(frameDone)),
      table_(static_cast<std::size_t>(framesInFlight)) {}

void Compositor::connect(std::shared_ptr<pipeline::Inlet<FinishedFrame>> next) {
  next_.connect(std::move(next));
  addOutlet(next_);
}

void Compositor::process(std::span<CompositorInput> inputs, pipeline::Run& run) {
  for (CompositorInput& input : inputs) {
    FrameNumber number = 0;
    if (const auto* list = std::get_if<std::shared_ptr<const FrameList>>(&input)) {
      number = (*list)->view->frame;
      table_.open(*list);
    } else {
      Result& result = std::get<Result>(input);
      number = result.frame;
      table_.put(std::move(result));
    }
    const auto complete = table_.take(number);
    if (!complete) continue;
    struct Done {
      const std::function<void()>& call;
      ~Done() { call(); }
    };
    const Done done{frameDone_};
    if (number <= newestShown_) continue;
    newestShown_ = number;
    next_.send(run, FinishedFrame{complete->list->view, composite(*complete)});
  }
}

std::shared_ptr<const Image> Compositor::composite(const CompleteFrame& frame) {
  const View& view = *frame.list->view;
  const auto image = images_.acquire({0, 0, view.camera.width, view.camera.height});
  FrameBuilder builder(*image);
  const auto& objects = frame.list->objects;
  TypeClock clock(registry_, timeline_, traceTag(frame.list));
  for (std::size_t i = 0; i < objects.size(); ++i) {
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
