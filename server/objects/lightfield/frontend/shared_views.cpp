#include "objects/lightfield/frontend/shared_views.h"

#include <algorithm>
#include <array>
#include <utility>

#include "objects/lightfield/common/keys.h"
#include "objects/lightfield/common/permitted_error.h"

namespace grove::objects::lightfield {
namespace {

/// Metres. Two visitors rarely share a smaller cell, and a walking visitor leaves it after two frames; their own
/// picture contains less than the whole object.
constexpr float kMinSharedReach = 0.13F;

/// Positions ahead of a walking visitor for a new picture, in reaches of the current cell; the first that serves the
/// current eye is used.
constexpr std::array<float, 3> kStepsAhead{1.8F, 1.2F, 0.6F};

float errorFor(const Sight& sight, world::Vec3 own, std::int32_t sharper = 0) {
  return reprojectionError(sight.field.geometry, own, sight.camera.eye, sight.focal(), sight.field.maxError, sharper);
}

std::optional<ViewCell> cellAt(const Sight& sight, world::Vec3 eye) {
  auto cell = viewCell(sight.field.geometry, eye, sight.focal(), sight.field.maxError);
  if (cell) cell->id.version = sight.field.number;
  return cell;
}

std::shared_ptr<const CachedView> find(const Sight& sight, const CellId& cell) {
  return std::static_pointer_cast<const CachedView>(sight.shared.find(keyOf(cell)));
}

}  // namespace

SharedViews::Last SharedViews::pictureOf(const Sight& sight, const CellId& cell, std::int32_t focal) {
  Last last{cell, find(sight, cell), kNever};
  if (!last.picture) return last;
  // Frames may have changed their size, for everybody at once.
  last.error = errorFor(sight, last.picture->camera().eye, cell.focal - focal);
  if (cell.coarse) last.error = std::max(last.error, kCoarseError);
  if (cell.version != sight.field.number) last.error = std::max(last.error, kOutdatedError);
  return last;
}

std::optional<ViewCell> SharedViews::cellOf(const Sight& sight) {
  if (sight.field.maxError <= 0.0F) return std::nullopt;
  auto cell = cellAt(sight, sight.camera.eye);
  if (cell && cell->reach < kMinSharedReach) cell.reset();
  return cell;
}

SharedViews::Last SharedViews::lastOf(const Sight& sight, std::int32_t focal) const {
  const std::optional<CellId> cell = last_.last(sight.id());
  return cell ? pictureOf(sight, *cell, focal) : ofOthers(sight, focal);
}

SharedViews::Last SharedViews::ofOthers(const Sight& sight, std::int32_t focal) const {
  Last best;
  for (const CellId& cell : recent_->of(sight.id())) {
    Last last = pictureOf(sight, cell, focal);
    if (last.error < best.error) best = std::move(last);
  }
  return best;
}

node::Plan SharedViews::begin(const Sight& sight, const ViewCell& cell) {
  const CrossFade fade = last_.fade(sight.id(), sight.view.time);
  if (fade.from && errorFor(sight, fade.from->camera().eye) > kMaxFadingError) last_.endFade(sight.id());
  // Reusing the last picture as long as it is good enough needs fewer pictures than changing at each cell's border.
  Last last = lastOf(sight, cell.id.focal);
  if (last.error <= 1.0F) return show(sight, "view cache hits", last.cell, std::move(last.picture));
  const world::Vec3 step = cell.reach * sight.heading();
  CellId best = cell.id;
  for (const float steps : kStepsAhead) {
    const auto ahead = cellAt(sight, sight.camera.eye + steps * step);
    if (!ahead || errorFor(sight, ahead->camera.eye) > 1.0F) continue;
    if (auto picture = find(sight, ahead->id)) return show(sight, "view cache hits", ahead->id, std::move(picture));
    if (best == cell.id) best = ahead->id;
  }
  if (auto picture = find(sight, cell.id)) return show(sight, "view cache hits", cell.id, std::move(picture));
  return node::Ask{.shared = true, .key = keyOf(best), .rect = {}, .urgency = last.error};
}

node::Plan SharedViews::resume(const Sight& sight, const node::Reply& reply) {
  CellId cell = cellIdOf(reply.ask.key);
  if (const auto* const data = std::get_if<std::shared_ptr<const node::SharedData>>(&reply.payload)) {
    recent_->add(sight.id(), cell);
    return show(sight, cell.coarse ? "coarse views" : "view cache misses", cell,
                std::static_pointer_cast<const CachedView>(*data));
  }
  if (cell.coarse || !isNotNow(reply.payload)) return reply.payload;
  Last last = lastOf(sight, cell.focal);
  if (last.error < kNever) return show(sight, "views shown stale", last.cell, std::move(last.picture));
  cell.coarse = true;
  if (auto picture = find(sight, cell)) return show(sight, "views shown stale", cell, std::move(picture));
  return node::Ask{.shared = true, .key = keyOf(cell), .rect = {}, .urgency = kNever};
}

node::Plan SharedViews::show(const Sight& sight, const char* counter, const CellId& cell,
                             std::shared_ptr<const CachedView> picture) {
  timeline_.count(counter);
  const std::optional<CellId> former = last_.last(sight.id());
  last_.shown(sight.id(), cell, sight.view.time,
              former && former->version < cell.version ? find(sight, *former) : nullptr);
  return node::Payload(std::shared_ptr<const node::SharedData>(std::move(picture)));
}

}  // namespace grove::objects::lightfield
