#include "objects/fluid/fine_wave.h"

#include <algorithm>
#include <utility>

namespace grove::objects::fluid {

namespace {

using rows::ChebyshevStage;

constexpr int kStages = FineWave::kStages;

/// Eigenvalues of Jacobi below are left to the coarser level: a little lower than for few stages.
constexpr auto kChebyshev = rows::chebyshevStages<kStages>(0.15F);

struct Halves3 {
  const Half* below;
  const Half* here;
  const Half* above;
};

Half neighbours(const Halves3& e, std::ptrdiff_t s, int i) {
  return ((e.here[i - 1] + e.here[i + 1]) + (e.here[i - s] + e.here[i + s])) + (e.below[i] + e.above[i]);
}

/// The first stage, from zero.
void smoothFromZero(const ChebyshevStage& stage, const Half* inverse, const Half* b, Half* __restrict out, int n) {
  const Half jacobi = static_cast<Half>(stage.jacobi);
  for (int i = 0; i < n; ++i) out[i] = jacobi * inverse[i] * b[i];
}

/// A stage that replaces the iterate before the current one, in `out`, by the next. kSecond: there is none before.
template <bool kSecond>
void smoothNext(const ChebyshevStage& stage, const Half* inverse, const Half* b, const Halves3& e, std::ptrdiff_t s,
                Half* __restrict out, int n) {
  const Half own = static_cast<Half>(stage.own);
  const Half previous = static_cast<Half>(stage.previous);
  const Half jacobi = static_cast<Half>(stage.jacobi);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const Half step = own * e.here[i] + jacobi * inverse[i] * (b[i] + neighbours(e, s, i));
    out[i] = kSecond ? step : step + previous * out[i];
  }
}

/// Residual over the diagonal.
void scaledResidual(const Half* inverse, const Half* b, const Halves3& e, std::ptrdiff_t s, Half* __restrict out,
                    int n) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) out[i] = inverse[i] * (b[i] + neighbours(e, s, i)) - e.here[i];
}

float squaredSum(const float* values, int n) {
  float sum = 0.0F;
  for (int i = 0; i < n; ++i) sum += values[i] * values[i];
  return sum;
}

}  // namespace

FineWave::Wave::Wave(const Layout& layout, const PackedPlane& packed, const Slab& own)
    : slab(own),
      source(static_cast<std::size_t>(packed.size) * (kPlanes + 1)),
      error{HalfField(source.size()), HalfField(source.size())},
      scaled(static_cast<std::size_t>(packed.size)),
      left(static_cast<std::size_t>(layout.plane) * (kPlanes + 1) + 2 * Layout::kLead),
      beside(left.size()) {}

FineWave::FineWave(const Layout& layout, std::shared_ptr<Team> team)
    : layout_(layout),
      packed_(layout.cells, 2),
      inverse_(static_cast<std::size_t>(packed_.size) * static_cast<std::size_t>(layout.cells)),
      team_(std::move(team)),
      norms_(static_cast<std::size_t>(layout.cells)) {
  for (int part = 0; part < team_->width(); ++part) {
    waves_.emplace_back(layout_, packed_, Slab::of(part, team_->width(), layout.cells));
  }
}

void FineWave::takeDiagonal(const Array<std::uint8_t>& diagonal, const CellBox& box) {
  for (int z = box.low[2]; z < box.high[2]; ++z) {
    for (int y = box.low[1]; y < box.high[1]; ++y) {
      for (int x = box.low[0]; x < box.high[0]; ++x) {
        const int d = diagonal[layout_.index(x, y, z)];
        inverse(y, z)[x] = static_cast<Half>(d > 0 ? 1.0F / static_cast<float>(d) : 0.0F);
      }
    }
  }
}

void FineWave::smooth(Wave& wave, int k, int plane) {
  const int count = wholeHalfVectors(packed_.step * layout_.cells);
  const ChebyshevStage& stage = kChebyshev[static_cast<std::size_t>(k)];
  HalfField& to = wave.error[static_cast<std::size_t>(k % 2)];
  HalfField& from = wave.error[static_cast<std::size_t>(1 - k % 2)];
  const Half* b = row(wave.source, 0, plane);
  Half* out = row(to, 0, plane);
  const Halves3 e{row(from, 0, plane - 1), row(from, 0, plane), row(from, 0, plane + 1)};
  if (k == 0) {
    smoothFromZero(stage, inverse(0, plane), b, out, count);
  } else if (k == 1) {
    smoothNext<true>(stage, inverse(0, plane), b, e, packed_.step, out, count);
  } else {
    smoothNext<false>(stage, inverse(0, plane), b, e, packed_.step, out, count);
  }
}

FineWave::Norms FineWave::run(const rows::FineOperator& a, const Field& b, const Field& x, Field& next,
                              const Coarse& coarse, double size) {
  team_->run([&](int part) { run(waves_[static_cast<std::size_t>(part)], a, b, x, next, coarse, size); });
  Norms norms;
  for (const Norms& plane : norms_) {
    norms.before += plane.before;
    norms.after += plane.after;
    norms.b += plane.b;
  }
  return norms;
}

void FineWave::run(Wave& wave, const rows::FineOperator& a, const Field& b, const Field& x, Field& next,
                   const Coarse& coarse, double size) {
  const int n = layout_.cells;
  const auto [first, end] = wave.slab;
  constexpr double kTypical = 0.25;  // leaves room for peaks of a quarter million times that
  const float scale = static_cast<float>(kTypical / size);
  const float back = static_cast<float>(size / kTypical);
  const auto isOwn = [first, end](int plane) { return plane >= first && plane < end; };
  // Beyond the cube are the ghosts of `next`.
  const auto unknown = [&](int y, int z) {
    return isOwn(z) || z < 0 || z >= n ? next.data() + layout_.index(0, y, z) : row(wave.beside, y, z);
  };
  alignas(64) float buffer[rows::kLongestRow + kHalfLanes];

  const auto addCorrection = [&](int z) {
    for (int y = 0; y < n; ++y) {
      const std::ptrdiff_t at = layout_.index(0, y, z);
      float* const out = unknown(y, z);
      std::copy_n(x.data() + at, n, out);
      if (coarse.correction == nullptr) continue;
      const std::ptrdiff_t from = coarse.layout.index(0, y / 2, z / 2);
      rows::interpolate(coarse.correction + from, coarse.a.row(from), y % 2 != 0, z % 2 != 0, a.row(at), out,
                        coarse.layout.cells);
    }
  };
  const auto takeResidual = [&](int z) {
    float before = 0.0F;
    float squaredB = 0.0F;
    for (int y = 0; y < n; ++y) {
      const std::ptrdiff_t at = layout_.index(0, y, z);
      rows::residual(a.row(at), b.data() + at, {unknown(y, z - 1), unknown(y, z), unknown(y, z + 1)}, buffer, n);
      before += squaredSum(buffer, n);
      squaredB += squaredSum(b.data() + at, n);
      toHalf(buffer, scale, row(wave.source, y, z), n);
    }
    if (!isOwn(z)) return;
    norms_[static_cast<std::size_t>(z)].before = static_cast<double>(before);
    norms_[static_cast<std::size_t>(z)].b = static_cast<double>(squaredB);
  };
  const auto addError = [&](int z) {
    for (int y = 0; y < n; ++y) {
      float* out = next.data() + layout_.index(0, y, z);
      addHalf(out, row(wave.error[(kStages - 1) % 2], y, z), back, out, n);
    }
  };
  const auto keepResidual = [&](int z) {
    HalfField& error = wave.error[(kStages - 1) % 2];
    const Halves3 e{row(error, 0, z - 1), row(error, 0, z), row(error, 0, z + 1)};
    Half* scaled = wave.scaled.data() + packed_.row(0);
    scaledResidual(inverse(0, z), row(wave.source, 0, z), e, packed_.step, scaled, wholeHalfVectors(packed_.step * n));
    float after = 0.0F;
    for (int y = 0; y < n; ++y) {
      const std::ptrdiff_t at = layout_.index(0, y, z);
      toFloat(scaled + packed_.step * y, back, buffer, n);
      const rows::FineOperator::Row weights = a.row(at);
      float* out = row(wave.left, y, z);
      for (int i = 0; i < n; ++i) out[i] = weights.weight(i) * buffer[i];
      after += squaredSum(out, n);
    }
    if (isOwn(z)) norms_[static_cast<std::size_t>(z)].after = static_cast<double>(after);
  };
  const auto restrictPlane = [&](int z) {
    for (int y = 0; y < coarse.layout.cells; ++y) {
      rows::Around around{};
      for (int dz = 0; dz < 4; ++dz) {
        for (int dy = 0; dy < 4; ++dy) around.row[dz][dy] = row(wave.left, 2 * y - 1 + dy, 2 * z - 1 + dz);
      }
      const std::ptrdiff_t at = coarse.layout.index(0, y, z);
      rows::restrictRow(around, coarse.a.row(at), coarse.b + at, coarse.layout.cells);
    }
  };

  // Each step needs one plane more on either side than the one after it.
  const auto within = [&](int plane, int beyond) {
    return plane >= std::max(first - beyond, 0) && plane < std::min(end + beyond, n);
  };
  constexpr int kBeyond = kStages + 2;
  for (int at = std::max(first - kBeyond, 0); at <= end + kBeyond; ++at) {
    if (within(at, kBeyond)) addCorrection(at);
    if (within(at - 1, kBeyond - 1)) takeResidual(at - 1);
    for (int k = 0; k < kStages; ++k) {
      if (within(at - 1 - k, kBeyond - 1 - k)) smooth(wave, k, at - 1 - k);
    }
    if (within(at - kStages, 0)) addError(at - kStages);
    if (within(at - kStages - 1, 1)) keepResidual(at - kStages - 1);
    if (const int plane = at - kStages - 1; plane > first && plane <= end && plane % 2 == 0) {
      restrictPlane(plane / 2 - 1);
    }
  }
}

}  // namespace grove::objects::fluid
