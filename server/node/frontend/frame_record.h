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

/// All that is known of one frame, from its list until nothing of it is of use: what each object waits for, what it is
/// shown with, and how the frame has ended. A slot is an object's index in the list. Used by one thread at a time.
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
  /// Whether every slot is answered.
  [[nodiscard]] bool complete() const noexcept { return missing_ == 0; }
  /// Whether it is in the making though its deadline has passed.
  [[nodiscard]] bool overdue(double now) const noexcept { return inTheMaking() && now >= view().deadline; }

  /// A slot waits for one thing more. Those of frames that have ended may ask, too.
  void ask(std::uint32_t slot, Ask ask);
  /// What a slot waits for; null if it waits for nothing, or if there is no such slot.
  [[nodiscard]] const Ask* asked(std::uint32_t slot) const;
  /// How often a slot has asked.
  [[nodiscard]] int rounds(std::uint32_t slot) const { return slots_[slot].rounds; }

  /// A slot waits no more. True if the frame takes the payload; false, and the payload stays as it is, for an unknown
  /// slot, for a second answer, and after the frame's end.
  bool answer(std::uint32_t slot, Payload& payload);
  /// An answer is what an earlier frame was shown with.
  void markStale() noexcept { stale_ = true; }

  /// Gives each slot without an answer what the first of the earlier frames, which may be null, was shown with for the
  /// same object, or a Failure if there is nothing that fits. Returns those slots.
  std::vector<std::uint32_t> fillIn(std::initializer_list<const FrameRecord*> earlier);
  /// What the object of a slot was shown with in the first of those frames that showed it; null if none did.
  [[nodiscard]] const Payload* lastOf(std::uint32_t slot, std::initializer_list<const FrameRecord*> earlier) const;

  /// What has come of a slot of `late`, which was shown without it, stands for that object in this frame from now on.
  /// False, and nothing changes, if this frame has an answer of its own or the payload does not fit.
  bool takeStale(const FrameRecord& late, std::uint32_t slot, Payload payload);

  /// With an answer for each slot, as it is to be shown.
  [[nodiscard]] CompleteFrame toShow() const;
  void show() noexcept { state_ = State::kShown; }
  void drop();
  /// Gives up the payloads of a frame that has ended.
  void release();

 private:
  struct Slot {
    Payload payload;
    std::optional<Ask> asked;
    int rounds = 0;
    bool answered = false;  ///< the payload is its own
  };
  /// What this frame was shown with for an object that is seen by `view`; null if nothing fits.
  [[nodiscard]] const Payload* shownWith(const VisibleObject& object, const View& view) const;
  /// Where this frame has an object that is seen by `view`, if both see pictures of one size.
  [[nodiscard]] std::optional<std::size_t> slotOf(const VisibleObject& object, const View& view) const;

  std::shared_ptr<const FrameList> list_;
  std::vector<Slot> slots_;
  std::size_t missing_;
  State state_ = State::kInTheMaking;
  bool stale_ = false;  ///< some payloads are of an earlier frame
};

}  // namespace grove::node
