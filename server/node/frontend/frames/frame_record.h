#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <vector>

#include "node/frontend/frontend_half.h"
#include "node/messages.h"

namespace grove::node {

/// The state of one frame, from its list until its last use: the pending request and the payload of each object, and
/// how the frame has ended. A slot is an object's index in the list. Not thread-safe.
class FrameRecord {
 public:
  enum class State : std::uint8_t {
    kInTheMaking,
    kShown,    ///< sent to the Compositor
    kDropped,  ///< never shown
  };

  explicit FrameRecord(std::shared_ptr<const FrameList> list);

  [[nodiscard]] const std::shared_ptr<const FrameList>& list() const noexcept { return list_; }
  [[nodiscard]] const View& view() const noexcept { return *list_->view; }
  [[nodiscard]] FrameNumber number() const noexcept { return list_->view->frame; }
  [[nodiscard]] const VisibleObject& object(std::uint32_t slot) const { return list_->objects[slot]; }
  [[nodiscard]] State state() const noexcept { return state_; }
  [[nodiscard]] bool inTheMaking() const noexcept { return state_ == State::kInTheMaking; }
  /// Returns whether every slot has an answer.
  [[nodiscard]] bool complete() const noexcept { return missing_ == 0; }
  /// Returns whether it is still in progress after its deadline.
  [[nodiscard]] bool overdue(double now) const noexcept { return inTheMaking() && now >= view().deadline; }

  /// A slot waits for one more result. Slots of ended frames may wait, too.
  void ask(std::uint32_t slot, Ask ask);
  /// Returns the pending need of a slot; null if there is none, or no such slot.
  [[nodiscard]] const Ask* asked(std::uint32_t slot) const;
  /// Number of a slot's requests so far.
  [[nodiscard]] int rounds(std::uint32_t slot) const { return slots_[slot].rounds; }

  /// A slot gets its answer. Returns true if the frame takes the payload. Returns false and leaves the payload
  /// unchanged for an unknown slot, for a second answer, and after the frame's end.
  bool answer(std::uint32_t slot, Payload& payload);
  /// An answer is the payload of an earlier frame.
  void markStale() noexcept { stale_ = true; }

  /// Fills each slot without an answer with the same object's payload of the first of the earlier frames (which may be
  /// null) that fits, or with a Failure. Returns those slots.
  std::vector<std::uint32_t> fillIn(std::initializer_list<const FrameRecord*> earlier);
  /// Returns the payload of a slot's object in the first of those frames that showed it; null if none did.
  [[nodiscard]] const Payload* lastOf(std::uint32_t slot, std::initializer_list<const FrameRecord*> earlier) const;

  /// Takes a late result of a slot of `late`, which was shown without it, as this frame's payload of that object.
  /// Returns false and changes nothing if this frame has its own answer or the payload does not fit.
  bool takeStale(const FrameRecord& late, std::uint32_t slot, Payload payload);

  /// Returns the frame to show; each slot has an answer.
  [[nodiscard]] CompleteFrame toShow() const;
  void show() noexcept { state_ = State::kShown; }
  void drop();
  /// Frees the payloads of an ended frame.
  void release();

 private:
  struct Slot {
    Payload payload;
    std::optional<Ask> asked;
    int rounds = 0;
    bool answered = false;  ///< the payload is its own
  };
  /// Returns this frame's payload of an object in `view`; null if none fits.
  [[nodiscard]] const Payload* shownWith(const VisibleObject& object, const View& view) const;
  /// Returns this frame's slot of an object in `view`, if both frames have pictures of one size.
  [[nodiscard]] std::optional<std::size_t> slotOf(const VisibleObject& object, const View& view) const;

  std::shared_ptr<const FrameList> list_;
  std::vector<Slot> slots_;
  std::size_t missing_;
  State state_ = State::kInTheMaking;
  bool stale_ = false;  ///< some payloads are from an earlier frame
};

}  // namespace grove::node
