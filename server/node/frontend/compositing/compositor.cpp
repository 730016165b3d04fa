#include "node/frontend/compositing/compositor.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "node/frontend/compositing/composite.h"
#include "node/limits.h"
#include "pipeline/clocks.h"
#include "pipeline/share_out.h"

namespace grove::node {
namespace {

constexpr const char* kCompositor = "Compositor";

/// Rows that are put together at once: with their edges, about what fits into the cache of a core.
constexpr int kBandHeight = 48;

}  // namespace

Compositor::Compositor(FrontendProcess& frontend, std::shared_ptr<VisitorHalves> halves, const FramePolicy& policy,
                       std::function<void()> frameDone)
    : Stage({.name = kCompositor,
             .work = pipeline::Work::kPerUserFrontend,
             .capacity = static_cast<std::size_t>(policy.framesInFlight) * (kMaxObjectsPerFrame + 1) + 1,
             .finishes = true},
            frontend.tools().workers, frontend.tools().timeline),
      frontend_(frontend),
      executor_(frontend.tools().workers),
      timeline_(frontend.tools().timeline),
      images_(frontend.tools().images),
      halves_(std::move(halves)),
      frameDone_(std::move(frameDone)),
      table_(static_cast<std::size_t>(policy.framesInFlight)) {}

void Compositor::connect(std::shared_ptr<pipeline::Inlet<FinishedFrame>> next) {
  next_.connect(std::move(next));
  addOutlet(next_);
}

void Compositor::process(std::span<CompositorInput> inputs, pipeline::Run& run) {
  for (CompositorInput& input : inputs) {
    if (auto* const answers = std::get_if<Answers>(&input)) {
      take(std::move(*answers), run);
      continue;
    }
    std::optional<CompleteFrame> frame;
    if (const auto* list = std::get_if<std::shared_ptr<const FrameList>>(&input)) {
      table_.open(*list);
      frame = table_.take((*list)->view->frame);
    } else {
      frame = takeOverdue();
    }
    if (frame) show(std::move(*frame), run);
  }
}

void Compositor::take(Answers answers, pipeline::Run& run) {
  const FrameNumber number = answers.view->frame;
  for (Answers::Slot& answer : answers.slots) {
    if (!table_.put(number, answer.slot, answer.payload)) takeStale(number, std::move(answer));
  }
  if (auto frame = table_.take(number)) show(std::move(*frame), run);
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

void Compositor::takeStale(FrameNumber frame, Answers::Slot answer) {
  timeline_.count("results that were not waited for");
  if (lastResults_.keepStale(frame, answer.slot, std::move(answer.payload))) {
    timeline_.count("results that the next frame may show");
  }
}

std::optional<CompleteFrame> Compositor::takeOverdue() {
  const double now = pipeline::wallSeconds();
  std::optional<CompleteFrame> newest;
  while (auto frame = table_.takeOverdue(now)) {
    // Older ones would be followed by this one at once.
    if (newest) frameDone_();
    newest = std::move(frame);
  }
  if (!newest) return newest;
  const View& view = *newest->list->view;
  frontend_.send(Cancel{view.session, view.frame});
  fillIn(*newest);
  return newest;
}

void Compositor::fillIn(CompleteFrame& frame) {
  for (const std::size_t slot : lastResults_.fillIn(frame)) {
    timeline_.recordFailure(kCompositor, pipeline::Work::kPerUserFrontend);
    const world::Object& object = frame.list->objects[slot].object;
    overdue_.warning(std::string(halves_->name(object.type)) + " " + object.name +
                     ": no result within the deadline of a frame");
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
