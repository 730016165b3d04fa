#pragma once

#include <cstdint>
#include <memory>

#include "cli/bench/picture_size.h"
#include "cli/bench/walk/frame_shelf.h"
#include "cli/bench/walk/walk_world.h"
#include "node/frontend/frontend_node.h"
#include "stream/encode/encoder.h"

namespace grove::cli {

/// Policy for complete frames, however long they take; two in flight, because the previous frame may still be ending
/// when the next begins.
[[nodiscard]] node::FramePolicy walkPolicy();
/// The same, with everything drawn in every frame.
[[nodiscard]] node::FramePolicy wholePolicy();

/// A visitor of a WalkWorld, who sees one frame at a time. The world outlives this. On the world's thread.
class WalkVisitor {
 public:
  struct Terms {
    std::uint32_t number = 1;  ///< unique among the visitors in the world
    PictureSize size;
    node::FramePolicy policy = walkPolicy();
    int borderPercent = 0;  ///< as in stream::withBorder()
  };
  /// Without an encoder, frames are not encoded.
  WalkVisitor(WalkWorld& world, const Terms& terms, std::unique_ptr<stream::Encoder> encoder = nullptr);
  /// Waits for runs in progress.
  ~WalkVisitor();
  WalkVisitor(const WalkVisitor&) = delete;
  WalkVisitor& operator=(const WalkVisitor&) = delete;

  /// Begins a frame of this moment. Call take() next.
  void begin(const Moment& moment);
  /// Waits for the frame. Throws EnvironmentError if it does not come within a minute.
  [[nodiscard]] node::FinishedFrame take();

  [[nodiscard]] node::FinishedFrame draw(const Moment& moment) {
    begin(moment);
    return take();
  }

 private:
  [[nodiscard]] node::View look(node::FrameNumber number) const;

  WalkWorld& world_;
  const node::SessionId session_;
  const PictureSize size_;
  const int borderPercent_;
  Moment moment_;  ///< set only between two frames, when none is in progress
  const std::shared_ptr<FrameShelf> shelf_;
  node::FrontendNode node_;
};

}  // namespace grove::cli
