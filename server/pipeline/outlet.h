#pragma once

#include <cassert>
#include <functional>
#include <memory>
#include <utility>

#include "pipeline/stage.h"

namespace grove::pipeline {

/// The sending end of an arrow, a member of the stage that sends. Connect before the first item arrives.
template <class T>
class Outlet final : public OutletBase {
 public:
  void connect(std::shared_ptr<Inlet<T>> to) { to_ = std::move(to); }

  /// Sends within a run, into the reserved room.
  PushResult send(Run& run, T value) {
    assert(to_);
    const bool reserved = run.use(*this);
    assert(reserved && "a run may send one value per item and outlet");
    return reserved ? to_->pushReserved(std::move(value)) : to_->push(std::move(value));
  }

  bool reserve(std::function<void()> onRoom) override { return to_->tryReserve(std::move(onRoom)); }
  void cancel() override { to_->cancelReservation(); }

 private:
  std::shared_ptr<Inlet<T>> to_;
};

}  // namespace grove::pipeline
