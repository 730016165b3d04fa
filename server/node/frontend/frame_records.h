#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <vector>

#include "node/frontend/frame_record.h"

namespace grove::node {

/// The frames of one visitor: requests x frames in flight (section 4.4), and beside those in the making some that have
/// ended, for results that come late are of use as the last ones of their objects. Bounded by the frames in flight and
/// kKept. Only the newest that was shown and the newest that drew a whole backdrop hold payloads after their end.
/// Records stay where they are until open() forgets them. Used by one thread at a time.
class FrameRecords {
 public:
  /// Whose results are still of use; frames in the making are kept even if they are more.
  static constexpr std::size_t kKept = 16;

  FrameRecords() = default;
  FrameRecords(const FrameRecords&) = delete;
  FrameRecords& operator=(const FrameRecords&) = delete;

  /// A frame begins; its number is new. The oldest one that has ended may be forgotten.
  FrameRecord& open(const std::shared_ptr<const FrameList>& list);

  /// Null if it is unknown or forgotten.
  [[nodiscard]] FrameRecord* find(FrameNumber frame);

  /// Those in the making whose deadline has passed, oldest first.
  [[nodiscard]] std::vector<FrameRecord*> overdue(double now);

  /// Whether a newer one was shown.
  [[nodiscard]] bool overtaken(const FrameRecord& frame) const;

  /// It is the newest shown from now on.
  void show(FrameRecord& frame);

  /// See FrameRecord::fillIn(), with what the newest shown frame has, and the newest that drew a backdrop.
  std::vector<std::uint32_t> fillIn(FrameRecord& frame) { return frame.fillIn({newestShown_, newestDrawn_}); }

  /// What an object of a frame that is in the making was shown with last; null if nothing.
  [[nodiscard]] const Payload* lastOf(const FrameRecord& frame, std::uint32_t slot) const {
    return frame.lastOf(slot, {newestShown_, newestDrawn_});
  }

  /// Those in the making that show the backdrop which this frame draws.
  [[nodiscard]] std::vector<FrameRecord*> showingBackdropOf(const FrameRecord& frame);
  /// Whether the frame that draws its backdrop is still in the making.
  [[nodiscard]] bool waitsForBackdrop(const FrameRecord& frame);

  /// What has come of a slot after its frame's end: true if it is the last result of its object now, see
  /// FrameRecord::takeStale(). Of frames that were not shown it never is.
  bool keepStale(const FrameRecord& late, std::uint32_t slot, Payload payload);

  [[nodiscard]] std::size_t size() const noexcept { return frames_.size(); }

 private:
  void forget();

  std::map<FrameNumber, FrameRecord> frames_;
  FrameRecord* newestShown_ = nullptr;
  FrameRecord* newestDrawn_ = nullptr;  ///< a whole backdrop, of those that were shown
};

}  // namespace grove::node
