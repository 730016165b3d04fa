#include "node/frontend/compositor.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "node/frontend/composite.h"
#include "node/limits.h"
#include "pipeline/share_out.h"
#include "world/world.h"

namespace grove::node {
namespace {

constexpr const char* kStage = "Compositor";

/// Rows that are put together at once: with their edges, about what fits into the cache of a core.
constexpr int kBandHeight = 48;

/// What covers all of its pixels comes first, which is cheapest where nothing lies yet; then the others, the nearest
/// first, so that what they hide need not be laid. The payloads are those of a frame's list, back to front.
std::vector<std::size_t> layingOrder(std::span<const Payload> payloads) {
  std::vector<std::size_t> order(payloads.size());
  std::iota(order.begin(), order.end(), 0);
  const auto isOpaque = [&](std::size_t index) {
    const auto* const layer = std::get_if<std::shared_ptr<const raster::Image>>(&payloads[index]);
    return layer != nullptr && *layer != nullptr && (*layer)->opaque;
  };
  const auto others = std::stable_partition(order.begin(), order.end(), isOpaque);
  std::reverse(others, order.end());
  return order;
}

}  // namespace

Compositor::Compositor(const Registry& registry, raster::ImagePool& images, pipeline::MemoryLedger& memory,
                       const FramePolicy& policy, std::function<void()> frameDone, pipeline::Executor& executor,
                       pipeline::Timeline& timeline)
    : Stage({.name = kStage,
             .work = pipeline::Work::kPerUserFrontend,
             .capacity = static_cast<std::size_t>(policy.framesInFlight) * (kMostObjectsPerFrame + 1) + 1,
             .finishes = true},
            executor, timeline),
      executor_(executor),
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

std::shared_ptr<const raster::Image> Compositor::composite(const CompleteFrame& frame) {
  const View& view = *frame.list->view;
  const auto& objects = frame.list->objects;
  const auto image = images_.acquire({0, 0, view.camera.width, view.camera.height});
  std::vector<Layer> layers;
  layers.reserve(objects.size());
  for (const std::size_t i : layingOrder(frame.payloads)) {
    if (std::holds_alternative<Failure>(frame.payloads[i])) continue;
    layers.push_back({objects[i], frame.payloads[i], halfOf(objects[i].object.type)});
  }
  const int bands = (image->height() + kBandHeight - 1) / kBandHeight;
  pipeline::shareOut(executor_, static_cast<std::size_t>(bands), [&](const pipeline::NextPart& next) {
    pipeline::TimedParts times = timesOf(frame);
    while (const auto band = next()) {
      const int top = static_cast<int>(*band) * kBandHeight;
      const int bottom = std::min(top + kBandHeight, image->height());
      layBand({0, top, image->width(), bottom}, layers, view, times, *image);
    }
  });
  pipeline::TimedParts times = timesOf(frame);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (std::holds_alternative<Failure>(frame.payloads[i])) continue;
    times.turnTo(registry_.type(objects[i].object.type).name());
    if (FrontendHalf* half = halfOf(objects[i].object.type)) half->draw(objects[i], frame.payloads[i], view, *image);
  }
  tellMemory();
  return image;
}

pipeline::TimedParts Compositor::timesOf(const CompleteFrame& frame) {
  return {timeline_, kStage, pipeline::Work::kPerUserFrontend, traceTag(frame.list)};
}

void Compositor::layBand(const world::Rect& band, std::span<const Layer> layers, const View& view,
                         pipeline::TimedParts& times, raster::Image& frame) {
  const auto edges = images_.acquire(band);
  FrameBuilder builder(frame, *edges);
  for (const Layer& layer : layers) {
    const auto* const image = std::get_if<std::shared_ptr<const raster::Image>>(&layer.payload);
    if (image != nullptr ? *image == nullptr : layer.half == nullptr) continue;
    if (builder.clip(image != nullptr ? (*image)->rect : layer.object.rect).empty()) continue;
    times.turnTo(registry_.type(layer.object.object.type).name());
    if (image != nullptr) {
      builder.lay(**image);
    } else {
      layer.half->lay(layer.object, layer.payload, view, builder);
    }
  }
  builder.finish();
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
