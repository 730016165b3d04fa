#include "node/frontend/compositing/compositor.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "node/frontend/compositing/composite.h"
#include "pipeline/share_out.h"

namespace grove::node {
namespace {

constexpr const char* kCompositor = "Compositor";

/// Rows that are put together at once: with their edges, about what fits into the cache of a core.
constexpr int kBandHeight = 48;

}  // namespace

Compositor::Compositor(std::size_t capacity, FrontendProcess& frontend, std::shared_ptr<VisitorHalves> halves,
                       std::function<void()> frameDone)
    : Stage({.name = kCompositor, .work = pipeline::Work::kPerUserFrontend, .capacity = capacity, .finishes = true},
            frontend.tools().workers, frontend.tools().timeline),
      executor_(frontend.tools().workers),
      timeline_(frontend.tools().timeline),
      images_(frontend.tools().images),
      halves_(std::move(halves)),
      frameDone_(std::move(frameDone)) {}

void Compositor::connect(std::shared_ptr<pipeline::Inlet<FinishedFrame>> next) {
  next_.connect(std::move(next));
  addOutlet(next_);
}

void Compositor::process(std::span<CompleteFrame> frames, pipeline::Run& run) {
  for (const CompleteFrame& frame : frames) {
    // One that cannot be shown ends, too.
    attempt([&] { next_.send(run, FinishedFrame{frame.list->view, composite(frame)}); }, [](const std::string&) {});
    frameDone_();
  }
}

std::shared_ptr<const raster::Image> Compositor::composite(const CompleteFrame& frame) {
  const View& view = *frame.list->view;
  const auto image = images_.acquire({0, 0, view.camera.width, view.camera.height});
  std::vector<Placed> placed = placedOf(frame);
  makeParts(frame, placed);
  // What covers all of its pixels comes first, which is cheapest where nothing lies yet; then the others, the nearest
  // first, so that what they hide need not be laid.
  std::vector<Placed*> order;
  order.reserve(placed.size());
  for (Placed& each : placed) order.push_back(&each);
  const auto isOpaque = [](const Placed* each) { return each->opaque(); };
  std::reverse(std::stable_partition(order.begin(), order.end(), isOpaque), order.end());
  const int bands = (image->height() + kBandHeight - 1) / kBandHeight;
  pipeline::shareOut(executor_, static_cast<std::size_t>(bands), [&](const pipeline::NextPart& next) {
    pipeline::TimedParts times = timesOf(frame);
    while (const auto band = next()) {
      const int top = static_cast<int>(*band) * kBandHeight;
      const int bottom = std::min(top + kBandHeight, image->height());
      layBand({0, top, image->width(), bottom}, order, times, *image);
    }
  });
  pipeline::TimedParts times = timesOf(frame);
  for (Placed& each : placed) {
    if (!each.layer) continue;
    times.turnTo(halves_->name(each.object.object.type));
    each.layer->draw(*image);
  }
  halves_->reportMemory();
  return image;
}

std::vector<Compositor::Placed> Compositor::placedOf(const CompleteFrame& frame) {
  pipeline::TimedParts times = timesOf(frame);
  const auto& objects = frame.list->objects;
  std::vector<Placed> placed;
  placed.reserve(objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Payload& payload = frame.payloads[i];
    if (std::holds_alternative<Failure>(payload)) continue;
    const auto* const picture = std::get_if<std::shared_ptr<const raster::Image>>(&payload);
    times.turnTo(halves_->name(objects[i].object.type));
    Placed each{objects[i], picture == nullptr ? nullptr : picture->get(),
                halves_->of(objects[i].object.type).layer(objects[i], payload, *frame.list->view)};
    if (each.picture != nullptr || each.layer) placed.push_back(std::move(each));
  }
  return placed;
}

void Compositor::makeParts(const CompleteFrame& frame, std::span<Placed> placed) {
  struct Part {
    Placed* of = nullptr;
    std::size_t number = 0;
  };
  std::vector<Part> parts;
  for (Placed& each : placed) {
    const std::size_t count = each.layer ? each.layer->parts() : 0;
    parts.reserve(parts.size() + count);
    for (std::size_t i = 0; i < count; ++i) parts.push_back({&each, i});
  }
  if (parts.empty()) return;
  pipeline::shareOut(executor_, parts.size(), [&](const pipeline::NextPart& next) {
    pipeline::TimedParts times = timesOf(frame);
    while (const auto part = next()) {
      const auto& [of, number] = parts[*part];
      times.turnTo(halves_->name(of->object.object.type));
      of->layer->makePart(number);
    }
  });
}

pipeline::TimedParts Compositor::timesOf(const CompleteFrame& frame) {
  return {timeline_, kCompositor, pipeline::Work::kPerUserFrontend, traceTag(frame.list)};
}

void Compositor::layBand(const world::Rect& band, std::span<Placed* const> placed, pipeline::TimedParts& times,
                         raster::Image& frame) {
  const auto edges = images_.acquire(band);
  FrameBuilder builder(frame, *edges);
  for (Placed* const each : placed) {
    times.turnTo(halves_->name(each->object.object.type));
    if (each->picture != nullptr) {
      if (!builder.clip(each->picture->rect).empty()) builder.lay(*each->picture);
    }
    if (each->layer && !builder.clip(each->object.rect).empty()) each->layer->lay(builder);
  }
  builder.finish();
}

}  // namespace grove::node
