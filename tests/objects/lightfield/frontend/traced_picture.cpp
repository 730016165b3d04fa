#include "objects/lightfield/frontend/traced_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "world/noise.h"

namespace grove::objects::lightfield {
namespace {

using world::Vec3;

void quad(world::Triangles& to, Vec3 corner, Vec3 u, Vec3 v) {
  const auto first = static_cast<std::uint32_t>(to.positions.size());
  to.positions.insert(to.positions.end(), {corner, corner + u, corner + u + v, corner + v});
  to.indices.push_back({first, first + 1, first + 2});
  to.indices.push_back({first, first + 2, first + 3});
}

void box(world::Triangles& to, Vec3 low, Vec3 high) {
  const Vec3 d = high - low;
  const Vec3 x(d.x, 0, 0);
  const Vec3 y(0, d.y, 0);
  const Vec3 z(0, 0, d.z);
  quad(to, low, x, y);
  quad(to, low, y, z);
  quad(to, low, z, x);
  quad(to, high, -x, -y);
  quad(to, high, -y, -z);
  quad(to, high, -z, -x);
}

void ball(world::Triangles& to, Vec3 centre, float radius) {
  constexpr int kRings = 24;
  const auto at = [&](int i, int j) {
    const float up = (static_cast<float>(i) / kRings - 0.5F) * std::numbers::pi_v<float>;
    const float around = static_cast<float>(j) / kRings * std::numbers::pi_v<float>;
    return centre + radius * Vec3(std::cos(up) * std::sin(around), std::sin(up), std::cos(up) * std::cos(around));
  };
  for (int i = 0; i < kRings; ++i) {
    for (int j = 0; j < 2 * kRings; ++j) {
      const auto first = static_cast<std::uint32_t>(to.positions.size());
      to.positions.insert(to.positions.end(), {at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
      to.indices.push_back({first, first + 1, first + 2});
      to.indices.push_back({first, first + 2, first + 3});
    }
  }
}

float unit(int i, int k) { return world::hashUnit(i, k, 7); }

Vec3 anyDirection(int i, int k) {
  const float y = 2.0F * unit(i, k) - 1.0F;
  const float around = 2.0F * std::numbers::pi_v<float> * unit(i, k + 1);
  const float across = std::sqrt(std::max(0.0F, 1.0F - y * y));
  return {across * std::sin(around), y, across * std::cos(around)};
}

/// A colour by the surface's slope, mottled in the large.
Vec3 shade(Vec3 point, Vec3 normal, std::uint32_t triangle) {
  const float lit = 0.35F + 0.5F * std::abs(glm::dot(normal, glm::normalize(Vec3(0.6F, 0.3F, 0.7F))));
  const float spots = 0.6F + 0.4F * world::noise(point * 3.0F);
  const float own = 0.8F + 0.2F * world::hashUnit(static_cast<int>(triangle / 2), 3);
  return Vec3(0.75F, 0.95F, 0.45F) * (lit * spots * own);
}

}  // namespace

TracedModel::TracedModel(const world::Triangles& triangles) : scene_(triangles) {
  const world::Bounds bounds = triangles.bounds();
  geometry_.target = bounds.centre();
  geometry_.extent = 0.0F;
  for (const Vec3 p : triangles.positions) {
    geometry_.extent = std::max(geometry_.extent, glm::length(p - geometry_.target) * 1.001F);
  }
}

TracedModel TracedModel::crown(float radius, int leaves, float edge) {
  world::Triangles triangles;
  for (int i = 0; i < leaves; ++i) {
    // More of them outside, in clumps, as on a tree.
    const Vec3 clump = anyDirection(i % 97, 40) * std::cbrt(unit(i % 97, 42)) * 0.72F;
    const Vec3 at = clump + anyDirection(i, 50) * std::cbrt(unit(i, 52)) * 0.26F;
    const Vec3 u = anyDirection(i, 60);
    const Vec3 v = glm::normalize(glm::cross(u, anyDirection(i, 70)));
    quad(triangles, Vec3(0, radius, 0) + at * radius, u * edge, v * edge * 0.6F);
  }
  return TracedModel(triangles);
}

TracedModel TracedModel::blades(int count, float width) {
  world::Triangles triangles;
  for (int i = 0; i < count; ++i) {
    const Vec3 foot(2.0F * unit(i, 1) - 1.0F, 0.0F, 2.0F * unit(i, 2) - 1.0F);
    const float around = 2.0F * std::numbers::pi_v<float> * unit(i, 3);
    const Vec3 up(0.1F * (unit(i, 4) - 0.5F), 0.5F + 0.5F * unit(i, 5), 0.1F * (unit(i, 6) - 0.5F));
    quad(triangles, foot, Vec3(std::cos(around), 0, std::sin(around)) * width, up);
  }
  return TracedModel(triangles);
}

TracedModel TracedModel::stillLife() {
  world::Triangles triangles;
  box(triangles, {-1.2F, 0.0F, -1.2F}, {1.2F, 0.1F, 1.2F});
  box(triangles, {-0.9F, 0.1F, -0.6F}, {-0.1F, 1.3F, 0.2F});
  ball(triangles, {0.5F, 0.6F, 0.4F}, 0.5F);
  return TracedModel(triangles);
}

float TracedModel::depth(Vec3 eye, Vec3 ray) const {
  const auto hit = scene_.intersect(eye, ray);
  return hit ? hit->distance : world::kInfiniteDepth;
}

std::shared_ptr<raster::Image> TracedModel::picture(const ObjectCamera& camera, const world::Rect& rect,
                                                    int samples) const {
  auto image = raster::ImagePool().acquire(rect);
  const float share = 1.0F / static_cast<float>(samples);
  for (int y = 0; y < image->height(); ++y) {
    for (int x = 0; x < image->width(); ++x) {
      Vec3 colour(0.0F);
      float cover = 0.0F;
      float depth = world::kInfiniteDepth;
      for (int s = 0; s < samples * samples; ++s) {
        const float dx = (static_cast<float>(s % samples) + 0.5F) * share;
        const int line = s / samples;
        const float dy = (static_cast<float>(line) + 0.5F) * share;
        const Vec3 ray = camera.ray(static_cast<float>(x + rect.left) + dx, static_cast<float>(y + rect.top) + dy);
        const auto hit = scene_.intersect(camera.eye, ray);
        if (!hit) continue;
        colour += shade(camera.eye + hit->distance * ray, hit->normal, hit->triangle) * share * share;
        cover += share * share;
        depth = std::min(depth, hit->distance);
      }
      const auto byte = [](float value) { return static_cast<std::uint32_t>(std::lround(value * 255.0F)); };
      image->colourRow(y)[x] = byte(colour.r) | byte(colour.g) << 8U | byte(colour.b) << 16U | byte(cover) << 24U;
      image->depthRow(y)[x] = depth;
    }
  }
  return image;
}

ObjectCamera frameCamera(Vec3 eye, Vec3 at, int width, int height, float focal) {
  const Vec3 forward = glm::normalize(at - eye);
  const Vec3 right = glm::normalize(glm::cross(forward, Vec3(0, 1, 0)));
  const Vec3 down = glm::cross(forward, right);
  ObjectCamera camera;
  camera.eye = eye;
  camera.perColumn = right / focal;
  camera.perRow = down / focal;
  camera.corner = forward - camera.perColumn * (0.5F * static_cast<float>(width)) -
                  camera.perRow * (0.5F * static_cast<float>(height));
  return camera;
}

Vec3 projected(const ObjectCamera& camera, Vec3 point) {
  const Vec3 p = glm::inverse(glm::mat3(camera.perColumn, camera.perRow, camera.corner)) * (point - camera.eye);
  return {p.x / p.z, p.y / p.z, p.z};
}

world::Rect ballRect(const ViewGeometry& geometry, const ObjectCamera& camera, int width, int height) {
  const Vec3 middle = projected(camera, geometry.target);
  const float reach = geometry.extent / (glm::length(camera.perColumn) * (middle.z - geometry.extent));
  return {std::max(0, static_cast<int>(middle.x - reach)), std::max(0, static_cast<int>(middle.y - reach)),
          std::min(width, static_cast<int>(middle.x + reach) + 1),
          std::min(height, static_cast<int>(middle.y + reach) + 1)};
}

double psnr(const raster::Image& a, const raster::Image& b) {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < a.colour.size(); ++i) {
    if ((a.colour[i] | b.colour[i]) >> 24U == 0) continue;
    for (const unsigned shift : {0U, 8U, 16U}) {
      const auto over = [&](std::uint32_t pixel) {
        return static_cast<double>(pixel >> shift & 255U) + 0.5 * (255.0 - static_cast<double>(pixel >> 24U));
      };
      const double difference = over(a.colour[i]) - over(b.colour[i]);
      sum += difference * difference;
      count += 1.0;
    }
  }
  return count == 0.0 ? 200.0 : 10.0 * std::log10(255.0 * 255.0 / std::max(sum / count, 1.0e-15));
}

}  // namespace grove::objects::lightfield
