#include "objects/lightfield/backend/near/near_canvas_kernels.h"

#include <algorithm>
#include <span>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/lightfield/backend/near/near_canvas_kernels.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "objects/lightfield/backend/near/face_batch_inl.h"
#include "objects/lightfield/backend/near/face_functions_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::lightfield::HWY_NAMESPACE {

/// Returns whether all blocks that a face touches are fully covered by nearer faces.
HWY_INLINE bool isHidden(const NearCanvas& canvas, const TileFace& face) {
  for (int row = face.top; row <= face.bottom; ++row) {
    for (int column = face.left; column <= face.right; ++column) {
      if (canvas.farthest[NearCanvas::block(column, row)] < face.nearest) return false;
    }
  }
  return true;
}

/// Counts NearPixels that became fully covered; the last one of a block closes the block.
HWY_INLINE void addFull(NearCanvas& canvas, int column, int row) {
  const std::size_t block = NearCanvas::block(column, row / NearCanvas::kBlock);
  if (++canvas.fullCount[block] < NearCanvas::kBlock) return;
  WordVec least = hn::Set(Words(), 32767);
  for (int i = 0; i < NearCanvas::kBlock; ++i) {
    const NearPixels& pixels = canvas.row((row / NearCanvas::kBlock) * NearCanvas::kBlock + i)[column];
    for (std::size_t k = 0; k < NearPixels::kCount; k += kStep) {
      least = hn::Min(least, hn::Load(Words(), pixels.nearness + k));
    }
  }
  canvas.farthest[block] = hn::GetLane(hn::MinOfLanes(Words(), least));
}

/// Moves samples to a nearer face that came later, because the order of the faces' middles was wrong for these pixels.
/// `first`: the first pixel of the step.
HWY_NOINLINE void takeSamples(NearPixels& pixels, std::size_t first, MaskVec taken, const MaskVec (&colour)[3]) {
  const Masks masks;
  HWY_ALIGN std::uint16_t takenCount[kStep];
  HWY_ALIGN std::uint16_t coveredCount[kStep];
  HWY_ALIGN std::uint16_t colours[3][kStep];
  hn::Store(hn::PopulationCount(taken), masks, takenCount);
  hn::Store(hn::PopulationCount(hn::Load(masks, pixels.covered + first)), masks, coveredCount);
  for (std::size_t c = 0; c < 3; ++c) hn::Store(colour[c], masks, colours[c]);
  for (std::size_t i = 0; i < kStep; ++i) {
    if (takenCount[i] == 0) continue;
    const int kept = coveredCount[i] - takenCount[i];
    for (std::size_t c = 0; c < 3; ++c) {
      std::uint16_t& sum = pixels.colour[c][first + i];
      sum = static_cast<std::uint16_t>(sum * kept / coveredCount[i] + takenCount[i] * colours[c][i]);
    }
  }
}

/// Draws one step. Returns whether its pixels became fully covered. Branches only on rare cases, since others would
/// often be mispredicted.
HWY_INLINE bool drawStep(NearPixels& pixels, const Coverage& coverage, const Surface& surface, int column, int row) {
  const Masks masks;
  const Words words;
  const auto first = static_cast<std::size_t>(row % NearPixels::kRows) * NearPixels::kColumns;
  const MaskVec none = hn::Zero(masks);
  const MaskVec all = hn::Set(masks, 0xFFFF);
  const MaskVec inside = coverage.at(column, row);
  const MaskVec before = hn::Load(masks, pixels.covered + first);
  const WordVec nearnessBefore = hn::Load(words, pixels.nearness + first);
  const auto values = surface.at(column, row);
  const WordVec nearness = surface.nearness(values);
  MaskVec colours[3];
  surface.colours(values, colours);
  const MaskVec taken =
      hn::IfThenElseZero(hn::RebindMask(masks, hn::Gt(nearness, nearnessBefore)), hn::And(before, inside));
  if (!hn::AllTrue(masks, hn::Eq(taken, none))) takeSamples(pixels, first, taken, colours);
  const MaskVec count = hn::PopulationCount(hn::AndNot(before, inside));
  for (std::size_t c = 0; c < 3; ++c) {
    std::uint16_t* const to = pixels.colour[c] + first;
    hn::Store(hn::Add(hn::Load(masks, to), hn::Mul(count, colours[c])), masks, to);
  }
  const auto isInside = hn::RebindMask(words, hn::Ne(inside, none));
  hn::Store(hn::IfThenElse(isInside, hn::Max(nearness, nearnessBefore), nearnessBefore), words,
            pixels.nearness + first);
  const MaskVec covered = hn::Or(before, inside);
  hn::Store(covered, masks, pixels.covered + first);
  return hn::AllTrue(masks, hn::Eq(covered, all)) && !hn::AllTrue(masks, hn::Eq(before, all));
}

/// Returns whether all samples are covered by faces not behind `nearest`.
HWY_INLINE bool isFull(const NearPixels& pixels, std::int16_t nearest) {
  const Masks masks;
  const Words words;
  auto covered = hn::Load(masks, pixels.covered);
  auto nearness = hn::Load(words, pixels.nearness);
  for (std::size_t k = kStep; k < NearPixels::kCount; k += kStep) {
    covered = hn::And(covered, hn::Load(masks, pixels.covered + k));
    nearness = hn::Min(nearness, hn::Load(words, pixels.nearness + k));
  }
  const auto isOpen =
      hn::Or(hn::Ne(covered, hn::Set(masks, 0xFFFF)), hn::RebindMask(masks, hn::Lt(nearness, hn::Set(words, nearest))));
  return hn::AllFalse(masks, isOpen);
}

HWY_INLINE void drawFace(const FaceBatch& batch, std::size_t face, const HalfPlanes& halfPlanes, std::int16_t nearest,
                         NearCanvas& canvas) {
  const Coverage coverage(batch, face, halfPlanes);
  const Surface surface(batch, face);
  const int bottom = batch.bottom[face];
  for (int top = batch.top[face]; top < bottom; top += kSpanRows) {
    const Spans spans(batch, face, top);
    for (int row = top; row < std::min(top + kSpanRows, bottom); ++row) {
      NearPixels* const pixels = canvas.row(row);
      for (int column = spans.begin[row - top]; column < spans.end[row - top]; ++column) {
        if (isFull(pixels[column], nearest)) continue;
        for (int k = 0; k < NearPixels::kRows; k += kStepRows) {
          const bool filled =
              drawStep(pixels[column], coverage, surface, column * NearPixels::kColumns, row * NearPixels::kRows + k);
          if (filled && (kStepRows == NearPixels::kRows || isFull(pixels[column], 0))) addFull(canvas, column, row);
        }
      }
    }
  }
}

void drawTile(const NearTiles& tiles, int column, int row, const HalfPlanes& halfPlanes, NearCanvas& canvas) {
  FaceBatch batch;
  const std::span<const TileFace> entries = tiles.at(column, row);
  std::size_t next = 0;
  while (next < entries.size()) {
    const ScreenFace* faces[kBatch];
    std::int16_t nearest[kBatch];
    std::size_t count = 0;
    for (; next < entries.size() && count < kBatch; ++next) {
      if (isHidden(canvas, entries[next])) continue;
      faces[count] = &tiles.face(entries[next].face);
      nearest[count] = entries[next].nearest;
      ++count;
    }
    if (count == 0) return;
    std::fill(faces + count, faces + kBatch, faces[0]);
    prepareFaces(faces, column, row, batch);
    for (std::size_t i = next; i < std::min(entries.size(), next + kBatch); ++i) {
      hwy::Prefetch(&tiles.face(entries[i].face));
    }
    for (std::size_t face = 0; face < count; ++face) drawFace(batch, face, halfPlanes, nearest[face], canvas);
  }
}

}  // namespace grove::objects::lightfield::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::lightfield {

HWY_EXPORT(drawTile);

void drawTile(const NearTiles& tiles, int column, int row, const HalfPlanes& halfPlanes, NearCanvas& canvas) {
  HWY_DYNAMIC_DISPATCH(drawTile)(tiles, column, row, halfPlanes, canvas);
}

}  // namespace grove::objects::lightfield

#endif  // HWY_ONCE
