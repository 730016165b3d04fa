#include "objects/mesh/backend/shapes/rock.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "raster/shading/noise.h"

namespace grove::objects::mesh {
namespace {

using world::Vec3;

constexpr std::size_t kPlanes = 9;

/// The relief and colours of one rock.
class Rock {
 public:
  explicit Rock(const RockForm& form) : form_(form) {
    const auto random = [&](std::uint32_t i) { return raster::random01(form.seed, i); };
    offset_ = Vec3(random(1), random(2), random(3)) * 200.0F;
    for (std::uint32_t i = 0; i < kPlanes; ++i) {
      const float around = (static_cast<float>(i) + 0.7F * random(10 + i)) * 6.2832F / static_cast<float>(kPlanes);
      // Steep faces; slanting ones only near the top, otherwise the rock would end in a point.
      const float up = 0.42F * random(30 + i);
      Plane& plane = planes_[i];
      plane.normal = glm::normalize(Vec3(std::cos(around), up, std::sin(around)));
      // Extent of the superellipsoid in that direction, less the broken part.
      const Vec3 reach = glm::abs(plane.normal) * form.half;
      const float dual = form.roundness / (form.roundness - 1.0F);
      const Vec3 power = glm::pow(reach, Vec3(dual));
      const float support = std::pow(power.x + power.y + power.z, 1.0F / dual);
      plane.distance = support * (1.0F - form.breaks * (0.03F + 0.17F * random(50 + i)));
    }
    warmth_ = random(70);
    darkness_ = 0.85F + 0.3F * random(71);
  }

  [[nodiscard]] raster::Vertex at(Vec3 cube) const {
    const Vec3 power = glm::pow(glm::abs(cube), Vec3(form_.roundness));
    const float norm = std::pow(power.x + power.y + power.z, 1.0F / form_.roundness);
    const Vec3 unit = cube / norm;
    Vec3 p = unit * form_.half;
    for (const Plane& plane : planes_)
      p -= plane.normal * (0.92F * std::max(0.0F, dot(plane.normal, p) - plane.distance));
    const float rise = 0.5F * (unit.y + 1.0F);
    const float narrow = 1.0F - form_.taper * rise * rise + 0.10F * form_.taper * std::sin(rise * 5.0F);
    p.x *= narrow;
    p.z *= 1.0F - 0.6F * (1.0F - narrow);
    p.x += form_.lean * rise * rise;
    p.y += form_.shoulder * unit.x * rise * rise * rise;
    const Vec3 outward = glm::normalize(unit / form_.half * glm::pow(glm::abs(unit), Vec3(form_.roundness - 2.0F)) +
                                        0.25F * unit / form_.half);
    const Vec3 q = p + offset_;
    const float relief = weathering(q);
    p += outward * relief;
    return painted(p, q, outward, relief);
  }

 private:
  struct Plane {
    Vec3 normal{0.0F};
    float distance = 0.0F;
  };

  /// Metres outwards: bulges, ridges of broken layers, pits, and furrows washed by rain.
  [[nodiscard]] float weathering(Vec3 q) const {
    const float thin = std::min({form_.half.x, form_.half.y, form_.half.z});
    const float bulge = raster::fractalNoise(q * (0.55F / thin), 3) * 0.34F * thin;
    const float ridge = 1.0F - 2.0F * std::abs(raster::fractalNoise(q * Vec3(2.1F, 3.4F, 2.1F) + 7.0F, 3));
    const float pits = std::max(0.0F, raster::fractalNoise(q * 5.5F + 31.0F, 2) - 0.14F);
    const float furrow = raster::fractalNoise(q * Vec3(4.2F, 0.5F, 4.2F) + 59.0F, 2);
    const float small = std::min(1.0F, thin / 0.3F);
    return form_.roughness * (bulge + small * (0.045F * (ridge - 0.6F) - 0.14F * pits + 0.035F * furrow +
                                               0.016F * raster::fractalNoise(q * 13.0F, 2)));
  }

  [[nodiscard]] raster::Vertex painted(Vec3 p, Vec3 q, Vec3 outward, float relief) const {
    raster::Vertex vertex;
    vertex.position = p;
    const float blotch = raster::fractalNoise(q * 1.6F + 90.0F, 3);
    const float streak = raster::fractalNoise(q * Vec3(5.0F, 0.45F, 5.0F) + 120.0F, 2);
    const Vec3 grey =
        glm::mix(Vec3(0.26F, 0.26F, 0.265F), Vec3(0.33F, 0.285F, 0.23F), warmth_ * 0.6F + 0.5F * blotch + 0.2F);
    const float height = p.y + form_.half.y - form_.buried;
    const float total = 2.0F * form_.half.y - form_.buried;
    const float stained = std::clamp(streak * 1.6F, 0.0F, 1.0F) * std::clamp(height / total, 0.0F, 1.0F);
    vertex.albedo = grey * darkness_ * (1.0F + 0.35F * blotch + 1.1F * relief) * (1.0F - 0.45F * stained);
    const float moss = std::clamp(1.1F - height / 0.55F + 1.3F * blotch + 0.35F * outward.y, 0.0F, 1.0F);
    vertex.albedo = glm::mix(vertex.albedo, Vec3(0.15F, 0.17F, 0.07F), 0.75F * moss);
    const float soil = std::clamp(1.0F - height / 0.14F, 0.0F, 1.0F);
    vertex.albedo = glm::mix(vertex.albedo, Vec3(0.13F, 0.105F, 0.07F), 0.7F * soil);
    vertex.lichen = std::clamp(0.30F + 1.1F * raster::fractalNoise(q * 1.1F + 150.0F, 2), 0.0F, 0.6F) * (1.0F - moss);
    return vertex;
  }

  RockForm form_;
  Vec3 offset_{0.0F};
  std::array<Plane, kPlanes> planes_;
  float warmth_ = 0.0F;
  float darkness_ = 1.0F;
};

}  // namespace

raster::Surface makeRock(const RockForm& form, float cell, int halvings) {
  const auto count = [&](float half) { return std::clamp(static_cast<int>(std::lround(2.0F * half / cell)), 1, 12); };
  const Rock rock(form);
  raster::Surface surface = raster::makeDeformedBox({count(form.half.x), count(form.half.y), count(form.half.z)},
                                                    halvings, [&](Vec3 cube) { return rock.at(cube); });
  surface.weathered = true;
  surface.gloss = 1.0F;
  return surface;
}

}  // namespace grove::objects::mesh
