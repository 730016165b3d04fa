#include "objects/lightfield/bake/light/surface_light.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>

#include "objects/lightfield/bake/directions.h"
#include "objects/lightfield/bake/light/meadow.h"
#include "objects/lightfield/bake/light/open_radiance.h"
#include "objects/lightfield/format/light_field.h"
#include "pipeline/parallel_for.h"
#include "world/camera.h"

namespace grove::bake {

using objects::lightfield::kMaxLightings;
using world::Vec3;

namespace {

constexpr float kSunRadius = 0.035F;  // of its direction: wider than the real sun, as through haze
constexpr int kBounces = 2;
constexpr std::size_t kPacketsPerTask = 8;

/// The hit of a ray from a point: a side of a point (2 * point, + 1 for the back), or one of these.
using Found = std::uint32_t;
constexpr Found kOpen = 0xFFFFFFFFU;     // sky or far meadow
constexpr Found kNotSent = 0xFFFFFFFEU;  // behind a surface with one side
constexpr Found kFirstOther = kNotSent;

/// One run of lightSurfaces(). A task handles a range of points and writes only their data.
class Computation {
 public:
  Computation(const models::Model& model, const LightPoints& points, const ModelRays& rays, const Lightings& lightings,
              const LightSettings& settings)
      : settings_(settings),
        model_(model),
        pointOf_(points.ofVertex),
        rays_(rays),
        lightings_(lightings),
        meadow_(points.points, lightings.meadowAlbedo()),
        modelPoints_(points.points.size()),
        points_(points.points),
        directions_(evenDirections(settings.directions)),
        open_(openRadiance(directions_, lightings)) {
    for (std::size_t i = 0; !settings.grounded && i < Meadow::size(); ++i) points_.push_back(meadow_.point(i));
    found_.assign(points_.size() * directions_.size(), kNotSent);
  }

  [[nodiscard]] SurfaceLight run(const std::function<void(float)>& progress, const std::stop_token& stop);

 private:
  using Packet = std::array<const LightPoint*, kPacket>;  ///< null beyond the last point

  [[nodiscard]] Packet packet(std::size_t first) const {
    Packet packet{};
    for (std::size_t i = 0; i < kPacket && first + i < points_.size(); ++i) packet[i] = &points_[first + i];
    return packet;
  }
  /// Whether a point sends a ray in a direction; the back only sends rays if it exists.
  [[nodiscard]] static bool sends(const LightPoint* point, Vec3 direction) {
    return point != nullptr && (point->bothSides || glm::dot(point->normal, direction) > 0.0F);
  }
  void place(RTCRay16& ray, std::size_t lane, const LightPoint& point, Vec3 direction) const;

  void addSun(std::size_t first, SurfaceLight& light) const;
  void look(std::size_t first);
  void addSky(std::size_t index, SurfaceLight& light) const;
  void addBounces(std::size_t index, const SurfaceLight& sent, SurfaceLight& light) const;
  void send(std::size_t index, const SurfaceLight& light, SurfaceLight& sent) const;
  [[nodiscard]] Found pointAt(const RTCRayHit16& rays, std::size_t lane) const;
  /// Calls visit(side, direction, weight); the weights of a side add up to 1.
  template <class Visit>
  void forEachDirection(const LightPoint& point, const Visit& visit) const;

  const LightSettings settings_;
  const models::Model& model_;
  const std::vector<std::uint32_t>& pointOf_;
  const ModelRays& rays_;
  const Lightings& lightings_;
  const Meadow meadow_;
  const std::size_t modelPoints_;
  std::vector<LightPoint> points_;  ///< the model's, then the meadow's
  const std::vector<Vec3> directions_;
  const std::vector<Vec3> open_;
  std::vector<Found> found_;  ///< [point][direction]
};

void Computation::place(RTCRay16& ray, std::size_t lane, const LightPoint& point, Vec3 direction) const {
  const float side = glm::dot(point.normal, direction);
  Vec3 origin = point.position + point.normal * std::copysign(settings_.away, side);
  // Points below the meadow start at its surface: their light is used for parts above it.
  if (!settings_.grounded) origin.y = std::max(origin.y, settings_.away);
  ray.org_x[lane] = origin.x;
  ray.org_y[lane] = origin.y;
  ray.org_z[lane] = origin.z;
  ray.dir_x[lane] = direction.x;
  ray.dir_y[lane] = direction.y;
  ray.dir_z[lane] = direction.z;
  ray.tnear[lane] = 0.0F;
  ray.tfar[lane] = world::kInfiniteDepth;
  ray.time[lane] = 0.0F;
  ray.mask[lane] = 0xFFFFFFFFU;
  ray.id[lane] = 0;
  ray.flags[lane] = 0;
}

void Computation::addSun(std::size_t first, SurfaceLight& light) const {
  const Packet packet = this->packet(first);
  for (int k = 0; k < lightings_.count(); ++k) {
    const Vec3 sun = lightings_.sun(k);
    const glm::mat3 basis = world::basisAround(sun);
    std::array<int, kPacket> seen{};
    const auto trace = [&](int begin, const ModelRays::Mask& wanted) {
      // Every other ray of a spiral over the disc.
      for (int i = begin; i < settings_.sunRays; i += 2) {
        const float radius =
            kSunRadius * std::sqrt((static_cast<float>(i) + 0.5F) / static_cast<float>(settings_.sunRays));
        const float around = 2.3999632F * static_cast<float>(i);
        const Vec3 direction = basis * Vec3(radius * std::cos(around), radius * std::sin(around), 1.0F);
        RTCRay16 rays;
        for (std::size_t lane = 0; lane < kPacket; ++lane) {
          if (wanted.lane[lane] != 0) place(rays, lane, *packet[lane], direction);
        }
        rays_.occluded(wanted, rays, ModelRays::Among::kModel);
        for (std::size_t lane = 0; lane < kPacket; ++lane) {
          if (wanted.lane[lane] != 0 && rays.tfar[lane] > 0.0F) ++seen[lane];
        }
      }
    };
    ModelRays::Mask mask;
    for (std::size_t lane = 0; lane < kPacket; ++lane) mask.lane[lane] = sends(packet[lane], sun) ? -1 : 0;
    trace(0, mask);
    // For most points, half of the rays suffice to show that they are wholly in the sun or in shade.
    for (std::size_t lane = 0; lane < kPacket; ++lane) {
      const bool partly = seen[lane] > 0 && seen[lane] < settings_.sunRays / 2;
      if (!partly) {
        mask.lane[lane] = 0;
        seen[lane] *= 2;
      }
    }
    trace(1, mask);
    for (std::size_t lane = 0; lane < kPacket; ++lane) {
      if (seen[lane] == 0) continue;
      const float cosine = glm::dot(packet[lane]->normal, sun);
      const float share = std::abs(cosine) * static_cast<float>(seen[lane]) / static_cast<float>(settings_.sunRays);
      const std::size_t at = static_cast<std::size_t>(k) * 3 + (cosine < 0.0F ? light.stride() : 0);
      const std::span<float> to = light.at(first + lane);
      for (int c = 0; c < 3; ++c) to[at + static_cast<std::size_t>(c)] += lightings_.sunColour()[c] * share;
    }
  }
}

Found Computation::pointAt(const RTCRayHit16& rays, std::size_t lane) const {
  const auto& corners = model_.triangles.indices[rays.hit.primID[lane]];
  const float u = rays.hit.u[lane];
  const float v = rays.hit.v[lane];
  const float w = 1.0F - u - v;
  const std::uint32_t point = pointOf_[corners[w >= u && w >= v ? 0 : u >= v ? 1 : 2]];
  const float towards = rays.hit.Ng_x[lane] * rays.ray.dir_x[lane] + rays.hit.Ng_y[lane] * rays.ray.dir_y[lane] +
                        rays.hit.Ng_z[lane] * rays.ray.dir_z[lane];
  return 2 * point + (towards > 0.0F && points_[point].bothSides ? 1 : 0);
}

void Computation::look(std::size_t first) {
  const Packet packet = this->packet(first);
  for (std::size_t d = 0; d < directions_.size(); ++d) {
    const Vec3 direction = directions_[d];
    ModelRays::Mask mask;
    RTCRayHit16 rays;
    for (std::size_t lane = 0; lane < kPacket; ++lane) {
      if (!sends(packet[lane], direction)) continue;
      mask.lane[lane] = -1;
      place(rays.ray, lane, *packet[lane], direction);
      rays.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
      rays.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    }
    rays_.intersect(mask, rays, ModelRays::Among::kModel, ModelRays::Backs::kMet);
    for (std::size_t lane = 0; lane < kPacket; ++lane) {
      if (mask.lane[lane] == 0) continue;
      Found& found = found_[(first + lane) * directions_.size() + d];
      found = kOpen;
      if (rays.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID) {
        found = pointAt(rays, lane);
      } else if (direction.y < 0.0F && !settings_.grounded) {
        const Vec3 origin(rays.ray.org_x[lane], rays.ray.org_y[lane], rays.ray.org_z[lane]);
        if (const auto cell = meadow_.hit(origin, direction)) found = static_cast<Found>(2 * (modelPoints_ + *cell));
      }
    }
  }
}

template <class Visit>
void Computation::forEachDirection(const LightPoint& point, const Visit& visit) const {
  std::array<float, 2> sums{};
  for (const Vec3 direction : directions_) {
    const float cosine = glm::dot(point.normal, direction);
    sums[cosine < 0.0F ? 1 : 0] += std::abs(cosine);
  }
  for (std::size_t d = 0; d < directions_.size(); ++d) {
    const float cosine = glm::dot(point.normal, directions_[d]);
    const std::size_t side = cosine < 0.0F ? 1 : 0;
    visit(side, d, std::abs(cosine) / sums[side]);
  }
}

void Computation::addSky(std::size_t index, SurfaceLight& light) const {
  const LightPoint& point = points_[index];
  const auto count = static_cast<std::size_t>(lightings_.count());
  std::array<std::array<Vec3, kMaxLightings>, 2> all{};
  std::array<std::array<Vec3, kMaxLightings>, 2> seen{};
  forEachDirection(point, [&](std::size_t side, std::size_t d, float weight) {
    const Found found = found_[index * directions_.size() + d];
    const bool open = found == kOpen || (found < kFirstOther && found / 2 >= modelPoints_);
    for (std::size_t k = 0; k < count; ++k) {
      const Vec3 radiance = open_[d * count + k] * weight;
      all[side][k] += radiance;
      if (open) seen[side][k] += radiance;
    }
  });
  const std::span<float> to = light.at(index);
  for (std::size_t side = 0; side < 2; ++side) {
    for (std::size_t k = 0; k < count; ++k) {
      const Vec3 normal = side == 0 ? point.normal : -point.normal;
      const Vec3 part = lightings_.ambient(static_cast<int>(k), normal) * seen[side][k] / all[side][k];
      for (int c = 0; c < 3; ++c) to[side * light.stride() + k * 3 + static_cast<std::size_t>(c)] += part[c];
    }
  }
}

void Computation::addBounces(std::size_t index, const SurfaceLight& sent, SurfaceLight& light) const {
  const std::span<float> to = light.at(index);
  const std::size_t stride = light.stride();
  forEachDirection(points_[index], [&](std::size_t side, std::size_t d, float weight) {
    const Found found = found_[index * directions_.size() + d];
    if (found >= kFirstOther) return;
    const std::span<const float> from = sent.at(found / 2).subspan(found % 2 * stride, stride);
    for (std::size_t i = 0; i < stride; ++i) to[side * stride + i] += weight * from[i];
  });
}

/// The light that a point sends from each side. The sky's light already includes the open meadow, so the meadow only
/// sends its difference to that: less in the object's shade.
void Computation::send(std::size_t index, const SurfaceLight& light, SurfaceLight& sent) const {
  const LightPoint& point = points_[index];
  const std::span<const float> from = light.at(index);
  const std::span<float> to = sent.at(index);
  const std::size_t stride = light.stride();
  for (std::size_t i = 0; i < 2 * stride; ++i) {
    const auto c = static_cast<int>(i % 3);
    const std::size_t other = i < stride ? i + stride : i - stride;
    to[i] = point.albedo[c] * from[i] + point.transmittance[c] * from[other];
    if (index >= modelPoints_) to[i] -= lightings_.meadowRadiance()[c];
  }
}

SurfaceLight Computation::run(const std::function<void(float)>& progress, const std::stop_token& stop) {
  constexpr std::size_t kTask = kPacket * kPacketsPerTask;
  const std::size_t tasks = (points_.size() + kTask - 1) / kTask;
  std::mutex mutex;
  std::size_t done = 0;
  SurfaceLight direct(points_.size(), lightings_.count());
  pipeline::parallelFor(settings_.threads, tasks, [&](std::size_t task) {
    if (stop.stop_requested()) return;
    const std::size_t end = std::min((task + 1) * kTask, points_.size());
    for (std::size_t first = task * kTask; first < end; first += kPacket) {
      addSun(first, direct);
      look(first);
    }
    for (std::size_t i = task * kTask; i < end; ++i) addSky(i, direct);
    const std::lock_guard lock(mutex);
    progress(static_cast<float>(++done) / static_cast<float>(tasks));
  });
  SurfaceLight light = direct;
  for (int bounce = 0; bounce < kBounces && !stop.stop_requested(); ++bounce) {
    SurfaceLight sent(points_.size(), lightings_.count());
    for (std::size_t i = 0; i < points_.size(); ++i) send(i, light, sent);
    light = direct;
    pipeline::parallelFor(settings_.threads, tasks, [&](std::size_t task) {
      for (std::size_t i = task * kTask; i < std::min((task + 1) * kTask, points_.size()); ++i) {
        addBounces(i, sent, light);
      }
    });
  }
  for (std::size_t i = 0; i < modelPoints_; ++i) {
    const std::span<float> sides = light.at(i);
    for (float& value : sides) value = std::max(value, 0.0F);
    const auto half = static_cast<std::ptrdiff_t>(light.stride());
    if (!points_[i].bothSides) std::copy_n(sides.begin(), half, sides.begin() + half);
  }
  return light;
}

}  // namespace

SurfaceLight lightSurfaces(const models::Model& model, const LightPoints& points, const ModelRays& rays,
                           const Lightings& lightings, const LightSettings& settings,
                           const std::function<void(float)>& progress, const std::stop_token& stop) {
  return Computation(model, points, rays, lightings, settings).run(progress, stop);
}

}  // namespace grove::bake
