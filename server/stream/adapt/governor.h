#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

namespace grove::stream {

/// Chooses the size of all visitors' pictures while the machine cannot hold their frame rate: 1, 5/6, 2/3 or 1/2 of the
/// wanted width and height (720, 600, 480 or 360 lines). Pictures shrink before visitors lose frames, and grow again
/// when the workers have room for it. Every visitor gets the same share, so nobody pays for the others.
/// Thread-safe; times are monotonic seconds.
class Governor {
 public:
  /// Returns the share of the workers that had work lately, 0 to 1. Called within update() only.
  using BusyShare = std::function<double()>;

  explicit Governor(BusyShare busyShare) : busyShare_(std::move(busyShare)) {}

  /// How the machine keeps up with one visitor's stream.
  struct Pace {
    double wanted = 30.0;    ///< frames a second
    double achieved = 30.0;  ///< frames a second
    double delayed = 0.0;    ///< share of the time in which a due frame waited for the machine
  };

  /// One visitor's stream while it exists.
  class Stream {
   public:
    explicit Stream(std::shared_ptr<Governor> governor);
    ~Stream();
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;

    /// Reports the pace, or nothing if something else than the machine limits the stream; returns scale(). Call at
    /// least a few times a second while frames are wanted.
    double update(const std::optional<Pace>& pace, double now);
    /// No frame is wanted.
    void rest();
    /// Of the wanted width and height.
    [[nodiscard]] double scale() const { return governor_->scale(); }

   private:
    const std::shared_ptr<Governor> governor_;
    const std::list<std::optional<Pace>>::iterator pace_;
  };

  [[nodiscard]] double scale() const;

 private:
  void assess(double now);
  void shrink(double now);
  void growIfThereIsRoom(double now);

  const BusyShare busyShare_;
  mutable std::mutex mutex_;
  std::list<std::optional<Pace>> paces_;
  std::size_t step_ = 0;
  double busy_ = 1.0;  ///< share of the workers, smoothed
  double assessed_ = 0.0;
  double missing_ = 0.0;  ///< missing frames, in seconds, since the machine last held the rate
  double changed_ = 0.0;
  bool grew_ = false;      ///< with the last change
  double patience_ = 0.0;  ///< seconds until the pictures may grow
};

}  // namespace grove::stream
