#include "world/rays/voxelizer.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace grove::world {

namespace {

constexpr int kMaxHitsPerRay = 256;

/// Calls `visit` for each crossing of a ray with surfaces: with the distance and +1 (enters) or -1 (leaves).
template <class Visit>
void forEachCrossing(const RayScene& surfaces, Vec3 origin, Vec3 direction, float far, const Visit& visit) {
  float near = 0.0F;
  for (int hits = 0; hits < kMaxHitsPerRay; ++hits) {
    const std::optional<RayScene::Hit> hit = surfaces.intersect(origin, direction, near, far);
    if (!hit) return;
    visit(hit->distance, glm::dot(hit->normal, direction) < 0.0F ? 1 : -1);
    near = std::max(hit->distance + 1.0e-5F, std::nextafter(hit->distance, far));
  }
}

/// The first cell of `n` with its centre behind a place on a ray, in cells from its low side; n if there is none.
int firstBehind(float place, int n) {
  return static_cast<int>(std::clamp(std::ceil(place - 0.5F), 0.0F, static_cast<float>(n)));
}

/// Votes of the rays along the three axes on which cells lie inside, and cells that hold a part of less than a cell.
struct Votes {
  std::vector<std::uint8_t> inside;
  std::vector<std::uint8_t> thin;
};

/// Votes along a ray from `before` metres in front of a row of `n` cells; at(i) is the index of its cell i.
template <class At>
void voteAlong(const RayScene& surfaces, Vec3 origin, Vec3 direction, float before, const Cube& cube, const At& at,
               Votes& votes) {
  const int n = cube.cells;
  int winding = 0;
  float entered = 0.0F;
  forEachCrossing(surfaces, origin, direction, before + cube.size, [&](float distance, int turn) {
    const float position = (distance - before) / cube.cellSize();  // in cells from the cube's low side
    if (winding == 0) {
      entered = position;
    } else if (winding + turn == 0) {
      const int first = firstBehind(entered, n);
      const int end = firstBehind(position, n);
      for (int i = first; i < end; ++i) ++votes.inside[at(i)];
      const float middle = 0.5F * (entered + position);
      if (first >= end && middle >= 0.0F && middle < static_cast<float>(n)) {
        votes.thin[at(static_cast<int>(middle))] = 1;
      }
    }
    winding += turn;
  });
  if (winding == 0) return;
  for (int i = firstBehind(entered, n); i < n; ++i) ++votes.inside[at(i)];
}

}  // namespace

std::vector<std::uint8_t> voxelize(const RayScene& surfaces, const Cube& cube) {
  // Rays start outside everything, so that the count of entries begins correctly.
  constexpr float kBefore = 1000.0F;
  const int n = cube.cells;
  const float cell = cube.cellSize();
  const std::size_t all = static_cast<std::size_t>(n) * n * n;
  Votes votes{std::vector<std::uint8_t>(all, 0), std::vector<std::uint8_t>(all, 0)};
  for (int a = 0; a < 3; ++a) {
    const int s = (a + 1) % 3;
    const int t = (a + 2) % 3;
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        Vec3 origin = cube.low;
        // A small offset from the centre avoids rays along shared edges and along faces.
        origin[s] += (static_cast<float>(i) + 0.5F) * cell + 1.3e-4F * cell;
        origin[t] += (static_cast<float>(j) + 0.5F) * cell + 2.1e-4F * cell;
        origin[a] -= kBefore;
        Vec3 direction(0.0F);
        direction[a] = 1.0F;
        const auto at = [&](int k) {
          std::size_t c[3];
          c[a] = static_cast<std::size_t>(k);
          c[s] = static_cast<std::size_t>(i);
          c[t] = static_cast<std::size_t>(j);
          return (c[2] * n + c[1]) * n + c[0];
        };
        voteAlong(surfaces, origin, direction, kBefore, cube, at, votes);
      }
    }
  }
  std::ranges::transform(votes.inside, votes.thin, votes.inside.begin(),
                         [](int inside, int thin) { return static_cast<std::uint8_t>(inside >= 2 || thin != 0); });
  return std::move(votes.inside);
}

std::vector<std::uint8_t> sunVisibility(const RayScene& surfaces, const Cube& cube, Vec3 towardsSun) {
  const int n = cube.cells;
  std::vector<std::uint8_t> visible;
  visible.reserve(static_cast<std::size_t>(n) * n * n);
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const Vec3 cell(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
        const Vec3 centre = cube.low + (cell + 0.5F) * cube.cellSize();
        visible.push_back(surfaces.occluded(centre, towardsSun) ? 0 : 1);
      }
    }
  }
  return visible;
}

}  // namespace grove::world
