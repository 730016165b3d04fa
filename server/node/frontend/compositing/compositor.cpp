#include "node/frontend/compositing/compositor.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "node/frontend/compositing/composite.h"
#include "node/frontend/compositing/fresh_parts.h"
#include "node/limits.h"
#include "pipeline/share_out.h"
#include "raster/yuv_image.h"

namespace grove::node {
namespace {

constexpr const char* kCompositor = "Compositor";
/// Name in the timeline of a part of the frame's time.
constexpr const char* kBackdrop = "backdrop";

/// Rows that are composited at once: with their edges, they fit approximately into a core's cache.
constexpr int kBandHeight = 48;

/// Adds the rows of a picture that may show anything. Its rectangle is that of its object's bounds, which is larger.
void addRows(const raster::Image& picture, std::vector<world::Rect>& parts) {
  for (int y = 0; y < picture.height(); ++y) {
    const raster::Span span = picture.span(y);
    parts.push_back(world::Rect{span.begin, y, span.end, y + 1}.moved(picture.rect.left, picture.rect.top));
  }
}

std::vector<Label> nearestOf(std::vector<Label> labels) {
  // Ids decide between equal depths, so that names that overlap do not change places from frame to frame.
  std::ranges::sort(labels, {}, [](const Label& label) { return std::pair(label.depth, label.object); });
  labels.resize(std::min(labels.size(), kMaxLabelsPerFrame));
  return labels;
}

std::vector<Mover> nearestOf(std::vector<Mover> movers) {
  std::ranges::sort(movers, {}, &Mover::nearest);
  movers.resize(std::min(movers.size(), kMaxMoversPerFrame));
  return movers;
}

}  // namespace

Compositor::Compositor(std::size_t capacity, FrontendProcess& frontend, std::shared_ptr<VisitorHalves> halves,
                       std::shared_ptr<BackdropStore> backdrops, std::function<void()> frameDone)
    : Stage({.name = kCompositor, .work = pipeline::Work::kPerUserFrontend, .capacity = capacity, .finishes = true},
            frontend.tools().workers, frontend.tools().timeline),
      executor_(frontend.tools().workers),
      timeline_(frontend.tools().timeline),
      images_(frontend.tools().images),
      halves_(std::move(halves)),
      backdrops_(std::move(backdrops)),
      frameDone_(std::move(frameDone)) {}

void Compositor::connect(std::shared_ptr<pipeline::Inlet<FinishedFrame>> next) {
  next_.connect(std::move(next));
  addOutlet(next_);
}

void Compositor::process(std::span<CompleteFrame> frames, pipeline::Run& run) {
  for (const CompleteFrame& frame : frames) {
    // A frame that cannot be shown ends, too.
    attempt([&] { next_.send(run, composite(frame)); }, [](const std::string&) {});
    frameDone_();
  }
}

FinishedFrame Compositor::composite(const CompleteFrame& frame) {
  const FrameList& list = *frame.list;
  const world::Rect area{0, 0, list.view->camera.width, list.view->camera.height};
  if (list.drawsBackdrop()) drawBackdrop(frame);
  Scene scene = sceneOf(frame, false, area);
  const auto backdrop = backdrops_->newest();
  const std::optional<BackdropWarp> warp = warpOf(list, backdrop.get());
  const FreshParts fresh(area, warp ? drawnParts(scene) : std::vector{area});
  const auto picture = raster::acquireYuv(images_, area);
  auto layers = images_.acquire(area);
  layers->spans = fresh.spans();
  const auto nearness = std::make_shared<CellNearness>(area.width(), area.height(), images_);
  const std::vector<world::Rect> strips = fresh.strips();
  BandSteps steps{.image = [&](const world::Rect&) { return layers; },
                  .end =
                      [&](const raster::Image& image, const world::Rect& band) {
                        for (const world::Rect& strip : strips) nearness->measure(image, world::overlap(strip, band));
                      }};
  if (warp) {
    steps.begin = [&](FrameBuilder& rows, const world::Rect& band) {
      rows.cover();
      warp->fill(band.top, band.bottom, fresh, {*picture, *layers, *nearness});
    };
  }
  compose(scene, traceTag(frame), area, steps);
  pipeline::TimedParts times = timesOf(traceTag(frame));
  std::vector<Label> labels;
  std::vector<Mover> movers;
  for (Placed& each : scene) {
    if (!each.layer) continue;
    times.turnTo(halves_->name(each.object.object.type));
    each.layer->draw(*layers);
    if (const auto label = each.layer->label(*layers)) labels.push_back(*label);
    if (const auto mover = each.layer->mover()) movers.push_back(*mover);
  }
  times.turnTo(kBackdrop);
  for (const world::Rect& strip : strips) raster::toYuv(*layers, strip, *picture);
  halves_->reportMemory();
  return {list.view, picture, nearestOf(std::move(labels)), nearness, nearestOf(std::move(movers))};
}

void Compositor::drawBackdrop(const CompleteFrame& frame) {
  const FrameList& list = *frame.list;
  const auto image = raster::acquireSemiPlanar(images_, list.area);
  BackdropDepths depths(list.area, images_);
  const auto before = list.extended ? backdrops_->newest() : nullptr;
  if (list.extended) {
    if (!before || before->origin().frame != *list.extended) throw std::runtime_error("no backdrop to extend");
    const world::Rect kept = world::overlap(before->image().rect, list.area);
    raster::copyPart(before->image(), kept, *image);
    depths.copy(before->depths(), kept);
  }
  const auto isFailure = [](const Payload& payload) { return std::holds_alternative<Failure>(payload); };
  bool isFinal =
      !frame.stale && std::ranges::none_of(frame.payloads, isFailure) && (!before || before->origin().isFinal);
  for (const world::Rect& part : list.drawn) {
    Scene scene = sceneOf(frame, true, part);
    isFinal = isFinal && std::ranges::all_of(scene, &Placed::isFinal);
    compose(scene, traceTag(frame), part,
            {.image = [&](const world::Rect& band) { return images_.acquire(band); },
             .end =
                 [&](const raster::Image& drawn, const world::Rect&) {
                   depths.measure(drawn);
                   raster::toSemiPlanar(drawn, *image);
                 }});
  }
  const Backdrop::Origin origin{list.backdropEye(), list.view->frame, isFinal};
  backdrops_->put(std::make_shared<const Backdrop>(image, std::move(depths), origin));
}

std::optional<BackdropWarp> Compositor::warpOf(const FrameList& list, const Backdrop* backdrop) {
  if (!list.backdrop) return std::nullopt;
  if (backdrop == nullptr) throw std::runtime_error("no backdrop could be drawn yet");
  return std::make_optional<BackdropWarp>(*backdrop, list.view->camera);
}

std::vector<world::Rect> Compositor::drawnParts(const Scene& scene) {
  std::vector<world::Rect> parts;
  for (const Placed& each : scene) {
    if (each.picture != nullptr) addRows(*each.picture, parts);
    if (each.layer) parts.push_back(each.layer->reach(each.object.rect));
  }
  return parts;
}

Compositor::Scene Compositor::sceneOf(const CompleteFrame& frame, bool still, const world::Rect& area) {
  pipeline::TimedParts times = timesOf(traceTag(frame));
  const auto& objects = frame.list->objects;
  Scene scene;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Payload& payload = frame.payloads[i];
    if (objects[i].still != still || std::holds_alternative<Failure>(payload)) continue;
    if (world::overlap(objects[i].rect, area).empty()) continue;
    const auto* const picture = std::get_if<std::shared_ptr<const raster::Image>>(&payload);
    times.turnTo(halves_->name(objects[i].object.type));
    Placed each{objects[i], picture == nullptr ? nullptr : picture->get(),
                halves_->of(objects[i].object.type).layer(objects[i], payload, *frame.list->eyeOf(objects[i]))};
    if (each.picture != nullptr || each.layer) scene.push_back(std::move(each));
  }
  return scene;
}

void Compositor::compose(Scene& scene, pipeline::TraceTag tag, const world::Rect& area, const BandSteps& steps) {
  makeParts(scene, tag);
  // Opaque objects come first, which is cheapest on an empty frame; then the others, the nearest first, so that hidden
  // parts are skipped.
  std::vector<Placed*> order;
  order.reserve(scene.size());
  for (Placed& each : scene) order.push_back(&each);
  const auto isOpaque = [](const Placed* each) { return each->opaque(); };
  std::reverse(std::stable_partition(order.begin(), order.end(), isOpaque), order.end());
  const int bands = (area.height() + kBandHeight - 1) / kBandHeight;
  pipeline::shareOut(executor_, static_cast<std::size_t>(bands), [&](const pipeline::NextPart& next) {
    pipeline::TimedParts times = timesOf(tag);
    while (const auto number = next()) {
      const int top = area.top + static_cast<int>(*number) * kBandHeight;
      const world::Rect band{area.left, top, area.right, std::min(top + kBandHeight, area.bottom)};
      const auto image = steps.image(band);
      const auto edges = images_.acquire(band);
      FrameBuilder rows(*image, *edges);
      times.turnTo(kBackdrop);
      if (steps.begin) steps.begin(rows, band);
      for (Placed* const each : order) {
        times.turnTo(halves_->name(each->object.object.type));
        if (each->picture != nullptr && !rows.clip(each->picture->rect).empty()) rows.lay(*each->picture);
        if (each->layer && !rows.clip(each->object.rect).empty()) each->layer->lay(rows);
      }
      rows.finish();
      times.turnTo(kBackdrop);
      if (steps.end) steps.end(*image, band);
    }
  });
}

void Compositor::makeParts(Scene& scene, pipeline::TraceTag tag) {
  struct Part {
    Placed* of = nullptr;
    std::size_t number = 0;
  };
  std::vector<Part> parts;
  for (Placed& each : scene) {
    const std::size_t count = each.layer ? each.layer->parts() : 0;
    parts.reserve(parts.size() + count);
    for (std::size_t i = 0; i < count; ++i) parts.push_back({&each, i});
  }
  if (parts.empty()) return;
  pipeline::shareOut(executor_, parts.size(), [&](const pipeline::NextPart& next) {
    pipeline::TimedParts times = timesOf(tag);
    while (const auto part = next()) {
      const auto& [of, number] = parts[*part];
      times.turnTo(halves_->name(of->object.object.type));
      of->layer->makePart(number);
    }
  });
}

pipeline::TimedParts Compositor::timesOf(pipeline::TraceTag tag) {
  return {timeline_, kCompositor, pipeline::Work::kPerUserFrontend, tag};
}

}  // namespace grove::node
