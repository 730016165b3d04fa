#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <vector>

#include "node/frontend/frames/frame_record.h"

namespace grove::node {

/// The frames of one visitor: requests x frames in flight (section 4.4). Besides frames in progress it keeps some ended
/// ones, because late results are useful as the last results of their objects. Bounded by the frames in flight and
/// kKept. Of the ended frames, only the newest shown one and the newest that drew a whole backdrop hold payloads.
/// References to records stay valid until open() forgets them. Not thread-safe.
class FrameRecords {
 public:
  /// Number of frames whose results are still useful; more frames in progress are kept, too.
  static constexpr std::size_t kKept = 16;

  FrameRecords() = default;
  FrameRecords(const FrameRecords&) = delete;
  FrameRecords& operator=(const FrameRecords&) = delete;

  /// A frame with a new number begins. May forget the oldest ended frame.
  FrameRecord& open(const std::shared_ptr<const FrameList>& list);

  /// Returns null if the frame is unknown or forgotten.
  [[nodiscard]] FrameRecord* find(FrameNumber frame);

  /// Frames in progress past their deadline, oldest first.
  [[nodiscard]] std::vector<FrameRecord*> overdue(double now);

  /// Returns whether a newer frame was shown.
  [[nodiscard]] bool overtaken(const FrameRecord& frame) const;

  /// Marks it as the newest shown frame.
  void show(FrameRecord& frame);

  /// See FrameRecord::fillIn(), with the newest shown frame and the newest that drew a backdrop.
  std::vector<std::uint32_t> fillIn(FrameRecord& frame) { return frame.fillIn({newestShown_, newestDrawn_}); }

  /// Returns the last shown payload of an object of a frame in progress; null if none.
  [[nodiscard]] const Payload* lastOf(const FrameRecord& frame, std::uint32_t slot) const {
    return frame.lastOf(slot, {newestShown_, newestDrawn_});
  }

  /// Frames in progress that show the backdrop which this frame draws.
  [[nodiscard]] std::vector<FrameRecord*> showingBackdropOf(const FrameRecord& frame);
  /// Returns whether the frame that draws its backdrop is still in progress.
  [[nodiscard]] bool waitsForBackdrop(const FrameRecord& frame);

  /// Handles a result of a slot after its frame's end. Returns true if it becomes the last result of its object, see
  /// FrameRecord::takeStale(). Always false for frames that were not shown.
  bool keepStale(const FrameRecord& late, std::uint32_t slot, Payload payload);

  [[nodiscard]] std::size_t size() const noexcept { return frames_.size(); }

 private:
  void forget();

  std::map<FrameNumber, FrameRecord> frames_;
  FrameRecord* newestShown_ = nullptr;
  FrameRecord* newestDrawn_ = nullptr;  ///< of the shown frames, the newest that drew a whole backdrop
};

}  // namespace grove::node
