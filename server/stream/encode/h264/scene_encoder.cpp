#include "stream/encode/h264/scene_encoder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "stream/encode/h264/deblocking/deblocking.h"
#include "stream/encode/h264/residual/residual_coding.h"
#include "stream/protocol/protocol.h"

namespace grove::stream::h264 {
namespace {

/// Whether a macroblock without a residual needs no more than a decoder assumes.
bool canSkip(const CodedMacroblock& macroblock, const MotionVector& skipped) {
  return macroblock.kind == MacroblockKind::kInter && !macroblock.hasResidual() &&
         std::ranges::count(macroblock.vectors, skipped) == 4;
}

}  // namespace

std::uint8_t SceneEncoder::codec() const noexcept { return kCodecH264; }

std::size_t SceneEncoder::bytes() const noexcept {
  return shown_.bytes() + next_.bytes() + grid_.macroblocks.capacity() * sizeof(Macroblock) + still_.bytes() +
         slice_.capacity();
}

int SceneEncoder::quantiserOf(Quantiser picture, int row) const {
  const Quantiser within = std::clamp(picture, range_.finest, range_.coarsest);
  return static_cast<int>(std::floor(within * (row + 1)) - std::floor(within * row));
}

void SceneEncoder::restart(const PictureSize& size) {
  size_ = size;
  const int across = size.macroblocksAcross();
  const int down = size.macroblocksDown();
  grid_ = {across, down, std::vector<Macroblock>(static_cast<std::size_t>(across) * static_cast<std::size_t>(down))};
  still_ = StillMacroblocks(across, down);
  shown_ = ReferencePicture(across, down);
  next_ = ReferencePicture(across, down);
}

bool SceneEncoder::encode(const raster::YuvImage& picture, const EncodeOrder& order, std::vector<std::uint8_t>& out) {
  const PictureSize size{picture.width(), picture.height()};
  const bool resized = size != size_;
  const bool independent = order.independent || resized;
  if (resized) restart(size);
  if (independent) {
    frameNumber_ = 0;
    ++independents_;
    appendUnit(UnitType::kSequenceParameters, sequenceParameters(size_).bytes(), out);
    appendUnit(UnitType::kPictureParameters, pictureParameters().bytes(), out);
  }
  const SliceHeader header{.independent = independent,
                           .frameNumber = frameNumber_,
                           .independentId = independents_ % 2,
                           .quantiser = quantiserOf(order.quantiser, 0)};
  still_.nextPicture(independent);
  adaptive_.nextPicture();
  slice_.clear();
  SliceWriter slice(header, grid_, slice_);
  MacroblockChoice choice(independent ? nullptr : &shown_, next_, grid_);
  for (int row = 0; row < grid_.down; ++row) {
    encodeRow(picture, order, row, choice, slice);
    filter(row + 1);
  }
  slice.finish();
  appendUnit(independent ? UnitType::kIndependentSlice : UnitType::kSlice, slice_.bytes(), out);
  std::swap(shown_, next_);
  frameNumber_ = (frameNumber_ + 1) % kFrameNumbers;
  return independent;
}

void SceneEncoder::encodeRow(const raster::YuvImage& picture, const EncodeOrder& order, int row,
                             MacroblockChoice& choice, SliceWriter& slice) {
  const int mean = quantiserOf(order.quantiser, row);
  MacroblockPixels source;
  CodedMacroblock coded;
  for (int column = 0; column < grid_.across; ++column) {
    readMacroblock(picture, column, row, source);
    choice.begin(column, row);
    if (choice.skipped() == MotionVector{} && still_.isStill(source, mean, column, row)) {
      // The picture before the last one, which this one replaces, has the same pixels here.
      coded.skip({});
      slice.write(coded, mean, column, row);
      continue;
    }
    const int quantiser = adaptive_.choose(source, mean);
    const MacroblockPixels& prediction = choice.choose(source, motionOf(order, column, row), quantiser, coded);
    quantiseResidual(source, prediction, quantisations_, quantiser, coded);
    if (canSkip(coded, choice.skipped())) coded.kind = MacroblockKind::kSkipped;
    slice.write(coded, quantiser, column, row);
    reconstruct(coded, prediction, quantisations_, quantiser, column, row, next_);
    if (coded.kind == MacroblockKind::kSkipped && choice.skipped() == MotionVector{}) {
      still_.keep(source, mean, column, row);
    } else {
      still_.change(column, row);
    }
  }
}

std::optional<KnownMotion> SceneEncoder::motionOf(const EncodeOrder& order, int column, int row) const {
  if (order.motion.empty()) return std::nullopt;
  const int across = (size_.width + 7) / 8;
  const int down = (size_.height + 7) / 8;
  KnownMotion motion;
  for (int i = 0; i < 4; ++i) {
    const int x = std::min(2 * column + i % 2, across - 1);
    const int y = std::min(2 * row + i / 2, down - 1);
    const int cell = y * across + x;
    motion[static_cast<std::size_t>(i)] = order.motion[static_cast<std::size_t>(cell)];
  }
  return motion;
}

void SceneEncoder::filter(int rows) {
  // A macroblock is predicted from unfiltered pixels of the row above, and its filter changes up to three rows above.
  constexpr int kChanging = 8;
  if (rows >= 2) deblockRow(grid_, rows - 2, next_);
  const int finished = std::max(0, (rows - 1) * kMacroblock - kChanging);
  const int before = std::max(0, finished - kMacroblock);
  if (finished > before) next_.extend(before, finished);
  if (rows < grid_.down) return;
  deblockRow(grid_, rows - 1, next_);
  next_.extend(finished, rows * kMacroblock);
}

}  // namespace grove::stream::h264
