#include "objects/lightfield/backend/simd/thicket.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "world/camera.h"
#include "world/light.h"

namespace grove::objects::lightfield {
namespace {

using world::Vec3;

constexpr int kRaysAcross = 4;

struct Parts {
  world::Triangles triangles;
  std::vector<Vec3> colours;

  void quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d, Vec3 colour) {
    const auto base = static_cast<std::uint32_t>(triangles.positions.size());
    triangles.positions.insert(triangles.positions.end(), {a, b, c, d});
    triangles.indices.push_back({base, base + 1, base + 2});
    triangles.indices.push_back({base, base + 2, base + 3});
    colours.insert(colours.end(), 2, colour);
  }

  void box(Vec3 low, Vec3 high, Vec3 colour) {
    const auto at = [&](int x, int y, int z) {
      return Vec3(x != 0 ? high.x : low.x, y != 0 ? high.y : low.y, z != 0 ? high.z : low.z);
    };
    quad(at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0), colour);
    quad(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1), colour);
    quad(at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0), colour);
    quad(at(1, 0, 0), at(1, 0, 1), at(1, 1, 1), at(1, 1, 0), colour);
    quad(at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1), colour);
    quad(at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1), colour);
  }

  void ball(Vec3 centre, float radius, Vec3 colour) {
    constexpr int kParts = 24;
    const auto at = [&](int ring, int part) {
      const float polar = 3.14159265F * static_cast<float>(ring) / kParts;
      const float angle = 6.2831853F * static_cast<float>(part) / kParts;
      return centre +
             radius * Vec3(std::sin(polar) * std::cos(angle), std::cos(polar), std::sin(polar) * std::sin(angle));
    };
    for (int ring = 0; ring < kParts; ++ring) {
      for (int part = 0; part < kParts; ++part) {
        quad(at(ring, part), at(ring, part + 1), at(ring + 1, part + 1), at(ring + 1, part), colour);
      }
    }
  }

  /// Leaves in a crown.
  void leaves(Vec3 centre, float radius, int count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
    const auto vector = [&] { return Vec3(unit(random), unit(random), unit(random)); };
    for (int i = 0; i < count;) {
      const Vec3 place = vector();
      if (glm::dot(place, place) > 1.0F) continue;
      ++i;
      const Vec3 middle = centre + radius * place;
      const Vec3 along = 0.10F * glm::normalize(vector());
      const Vec3 across = 0.035F * glm::normalize(glm::cross(along, vector()));
      const Vec3 colour = Vec3(0.25F, 0.45F, 0.12F) + 0.15F * vector();
      quad(middle - along - across, middle + along - across, middle + along + across, middle - along + across, colour);
    }
  }
};

Parts parts() {
  Parts parts;
  parts.box({-1.0F, 0.0F, -1.0F}, {1.0F, 0.05F, 1.0F}, {0.35F, 0.3F, 0.2F});
  parts.box({-0.07F, 0.0F, -0.07F}, {0.07F, 1.2F, 0.07F}, {0.3F, 0.2F, 0.12F});
  parts.ball({0.6F, 0.35F, 0.5F}, 0.3F, {0.7F, 0.25F, 0.2F});
  parts.leaves({0.0F, 1.4F, 0.0F}, 0.6F, 500);
  return parts;
}

std::uint32_t encoded(Vec3 colour, float coverage) {
  const auto byte = [](float value) {
    return static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 255.0F));
  };
  return byte(colour.r) | byte(colour.g) << 8U | byte(colour.b) << 16U | byte(coverage) << 24U;
}

/// The middle one of those rays that meet what most of them do: the nearest surface that fills half of what is covered.
float middleDepth(std::vector<float>& depths) {
  const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  return *middle;
}

}  // namespace

Thicket::Thicket() : rays_(world::Triangles{parts().triangles}) {
  Parts made = parts();
  triangles_ = std::move(made.triangles);
  colours_ = std::move(made.colours);
}

Vec3 Thicket::shade(const world::RayScene::Hit& hit, Vec3 point) const {
  const Vec3 sun = glm::normalize(Vec3(-0.5F, 0.7F, 0.4F));
  const bool lit = !rays_.occluded(point, sun, 1.0e-3F);
  const float sunlight = lit ? std::abs(glm::dot(hit.normal, sun)) : 0.0F;
  const float pattern =
      0.85F + 0.15F * std::sin(17.0F * point.x) * std::sin(19.0F * point.z) * std::sin(15.0F * point.y);
  return colours_[hit.triangle] * pattern * (0.35F + 0.9F * sunlight);
}

Photograph Thicket::photograph(const ObjectCamera& camera, int size) const {
  Photograph result;
  result.size = size;
  result.colour.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  result.depth.reserve(result.colour.capacity());
  std::vector<float> depths;
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      depths.clear();
      Vec3 colour(0.0F);
      for (int i = 0; i < kRaysAcross * kRaysAcross; ++i) {
        const float x = static_cast<float>(column) + (static_cast<float>(i % kRaysAcross) + 0.5F) / kRaysAcross;
        const float y = static_cast<float>(row) + (static_cast<float>(i / kRaysAcross) + 0.5F) / kRaysAcross;
        const Vec3 ray = camera.ray(x, y);
        const auto hit = rays_.intersect(camera.eye, ray, 1.0e-3F);
        if (!hit) continue;
        depths.push_back(hit->distance);
        colour += shade(*hit, camera.eye + hit->distance * ray);
      }
      const float share = 1.0F / (kRaysAcross * kRaysAcross);
      result.colour.push_back(encoded(colour * share, static_cast<float>(depths.size()) * share));
      result.depth.push_back(depths.empty() ? world::kInfiniteDepth : middleDepth(depths));
    }
  }
  return result;
}

LightField Thicket::bake(int subdivision, int size, int levels) const {
  LightField shape;
  shape.sphere = ViewSphere(subdivision);
  shape.bounds = triangles_.bounds();
  shape.geometry.target = shape.bounds.centre();
  shape.geometry.extent = glm::length(shape.bounds.size()) * 0.5F;
  shape.geometry.centre = Vec3(0.0F);
  shape.geometry.radius = 2.5F * shape.geometry.extent;
  shape.size = size;
  shape.levels = levels;
  shape.source = "thicket";
  const ViewGeometry geometry = shape.geometry;
  const ViewSphere sphere = shape.sphere;
  LightFieldBuilder builder(std::move(shape), 1);
  for (int view = 0; view < sphere.views(); ++view) {
    const ViewCamera camera = viewCamera(geometry, sphere.direction(view));
    Photograph photograph = this->photograph(objectCamera(camera, size), size);
    DenseView dense;
    dense.size = size;
    for (const float depth : photograph.depth) {
      const float share = (depth - camera.nearDepth) / (camera.farDepth - camera.nearDepth);
      dense.depth.push_back(depth == world::kInfiniteDepth
                                ? kNoDepth
                                : static_cast<std::uint16_t>(std::clamp(std::lround(share * 65534.0F), 0L, 65534L)));
    }
    dense.colour.push_back(std::move(photograph.colour));
    builder.set(view, packView(dense, levels));
  }
  return std::move(builder).build();
}

ObjectCamera lookAt(Vec3 eye, Vec3 at, float extent, int size) {
  ViewGeometry geometry;
  geometry.centre = at;
  geometry.target = at;
  geometry.extent = extent;
  geometry.radius = glm::length(eye - at);
  return objectCamera(viewCamera(geometry, (eye - at) / geometry.radius), size);
}

}  // namespace grove::objects::lightfield
