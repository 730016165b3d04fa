#pragma once

#include <cstdint>
#include <memory>

#include "cli/bench/picture_size.h"
#include "cli/bench/walk/frame_shelf.h"
#include "cli/bench/walk/walk_world.h"
#include "node/frontend/frontend_node.h"
#include "stream/encode/encoder.h"

namespace grove::cli {

/// How frames are made for who would rather wait than leave anything out: two at once, as the one before may still be
/// ending when the next begins.
[[nodiscard]] node::FramePolicy walkPolicy();

/// One who sees what a WalkWorld shows, one frame at a time. The world outlives him. One thread, that of the world.
class WalkVisitor {
 public:
  struct Terms {
    std::uint32_t number = 1;  ///< unique among the visitors in the world
    PictureSize size;
    node::FramePolicy policy = walkPolicy();
  };
  /// Without an encoder, his frames are not encoded.
  WalkVisitor(WalkWorld& world, const Terms& terms, std::unique_ptr<stream::Encoder> encoder = nullptr);
  /// Waits for what is still in progress.
  ~WalkVisitor();
  WalkVisitor(const WalkVisitor&) = delete;
  WalkVisitor& operator=(const WalkVisitor&) = delete;

  /// A frame of this moment. To be followed by take().
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
  Moment moment_;  ///< set between two frames only: there is never one in progress then
  const std::shared_ptr<FrameShelf> shelf_;
  node::FrontendNode node_;
};

}  // namespace grove::cli
