#include "models/plants/blade.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace grove::models {
namespace {

using world::Vec3;

constexpr float kPi = std::numbers::pi_v<float>;

/// Half the width at a share of the length, relative to half the greatest width.
float halfWidth(Outline outline, float at) {
  switch (outline) {
    case Outline::kGrass:
      return std::pow(1.0F - at, 0.6F) * (0.75F + 0.25F * std::sin(kPi * std::min(1.0F, at + 0.25F)));
    case Outline::kOval:
      return std::sqrt(std::max(0.0F, 1.0F - (2.0F * at - 1.0F) * (2.0F * at - 1.0F)));
    case Outline::kOak:  // broadest beyond the middle, rounded lobes
      return std::pow(std::sin(kPi * std::pow(at, 1.35F)), 0.8F) * (0.86F + 0.2F * std::sin(2.0F * kPi * 4.0F * at));
    case Outline::kBirch:  // broadest near the root, pointed, toothed
      return std::sin(kPi * std::pow(at, 0.55F)) * (0.95F + 0.06F * std::sin(2.0F * kPi * 9.0F * at));
    case Outline::kFern:  // a saw of leaflets
      return (1.0F - at * at) * (0.72F + 0.28F * std::sin(2.0F * kPi * 7.0F * at)) + 0.02F;
    case Outline::kPetal:  // narrow root, broad blunt end
      return std::sin(0.5F * kPi * std::min(1.0F, 1.5F * at + 0.15F)) * std::sqrt(1.0F - std::pow(at, 6.0F));
  }
  return 1.0F;
}

/// Two triangles that meet where the blade is widest.
void drawFlat(MeshWriter& mesh, const Blade& blade, Vec3 side, Vec3 face) {
  const auto along = [&](float angle) { return blade.along * std::cos(angle) - face * std::sin(angle); };
  const auto up = [&](float angle) { return blade.along * std::sin(angle) + face * std::cos(angle); };
  const float half = 0.5F * blade.width * halfWidth(blade.outline, 0.5F);
  const Vec3 middle = blade.root + along(0.25F * blade.bend) * (0.5F * blade.length);
  const Vec3 rims = middle + up(0.25F * blade.bend) * (blade.fold * half);
  const Vec3 colour = glm::mix(blade.rootColour, blade.tipColour, 0.5F);
  const std::uint32_t root = mesh.vertex(blade.root, blade.rootColour);
  const std::uint32_t left = mesh.vertex(rims - side * half, colour);
  const std::uint32_t right = mesh.vertex(rims + side * half, colour);
  const std::uint32_t tip = mesh.vertex(middle + along(0.75F * blade.bend) * (0.5F * blade.length), blade.tipColour);
  mesh.triangle(root, right, left, blade.material);
  mesh.triangle(left, right, tip, blade.material);
  mesh.finishSurface();
}

}  // namespace

void drawBlade(MeshWriter& mesh, const Blade& blade, int rows) {
  assert(rows >= 1);
  const Vec3 side = unitOr(glm::cross(blade.along, blade.face), anyNormalTo(blade.along));
  const Vec3 face = glm::cross(side, blade.along);
  if (rows == 1) {
    drawFlat(mesh, blade, side, face);
    return;
  }
  const float step = blade.length / static_cast<float>(rows);
  std::array<std::uint32_t, 3> before{};
  Vec3 at = blade.root;
  const std::uint32_t root = mesh.vertex(at, blade.rootColour);
  for (int row = 1; row <= rows; ++row) {
    const float share = static_cast<float>(row) / static_cast<float>(rows);
    const float angle = blade.bend * (share - 0.5F / static_cast<float>(rows));
    const Vec3 along = blade.along * std::cos(angle) - face * std::sin(angle);
    const Vec3 up = blade.along * std::sin(angle) + face * std::cos(angle);
    at += along * step;
    const Vec3 colour = glm::mix(blade.rootColour, blade.tipColour, share);
    if (row == rows) {
      const std::uint32_t tip = mesh.vertex(at, colour);
      mesh.triangle(before[0], before[1], tip, blade.material);
      mesh.triangle(before[1], before[2], tip, blade.material);
      break;
    }
    const float half = 0.5F * blade.width * halfWidth(blade.outline, share);
    const Vec3 rise = up * (blade.fold * half);
    // The vein is a little darker than the rims.
    const std::array<std::uint32_t, 3> now{mesh.vertex(at - side * half + rise, colour),
                                           mesh.vertex(at, colour * 0.93F),
                                           mesh.vertex(at + side * half + rise, colour)};
    if (row == 1) {
      mesh.triangle(root, now[1], now[0], blade.material);
      mesh.triangle(root, now[2], now[1], blade.material);
    } else {
      for (int i = 0; i < 2; ++i) {
        const auto left = static_cast<std::size_t>(i);
        mesh.triangle(before[left], before[left + 1], now[left], blade.material);
        mesh.triangle(before[left + 1], now[left + 1], now[left], blade.material);
      }
    }
    before = now;
  }
  mesh.finishSurface();
}

}  // namespace grove::models
