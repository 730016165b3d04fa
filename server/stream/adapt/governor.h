#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

namespace grove::stream {

/// Chooses how much all visitors get while the machine cannot hold their frame rate. Pages that move pictures (late
/// walk) hardly show a lower rate, so first they get 20 or 15 pictures a second. Then everybody's pictures shrink to
/// 5/6, 2/3 or 1/2 of the wanted width and height (720, 600, 480 or 360 lines), before visitors lose frames. All of it
/// is undone when the workers have room. Visitors with the same kind of page get the same, so nobody pays for the
/// others. Thread-safe; times are monotonic seconds.
class Governor {
 public:
  /// Returns the share of the workers that had work lately, 0 to 1. Called within update() only.
  using BusyShare = std::function<double()>;

  explicit Governor(BusyShare busyShare) : busyShare_(std::move(busyShare)) {}

  /// What a stream gets.
  struct Share {
    double scale = 1.0;                                               ///< of the wanted width and height
    double movedPerSecond = std::numeric_limits<double>::infinity();  ///< most pictures for a page that moves them
    friend bool operator==(const Share&, const Share&) = default;
  };

  /// How the machine keeps up with one visitor's stream.
  struct Pace {
    double wanted = 30.0;    ///< frames a second
    double achieved = 30.0;  ///< frames a second
    double delayed = 0.0;    ///< share of the time in which a due frame waited for the machine
    bool moves = false;      ///< the page moves pictures
  };

  /// One visitor's stream while it exists.
  class Stream {
   public:
    explicit Stream(std::shared_ptr<Governor> governor);
    ~Stream();
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;

    /// Reports the pace, or nothing if something else than the machine limits the stream; returns share(). Call at
    /// least a few times a second while frames are wanted.
    Share update(const std::optional<Pace>& pace, double now);
    /// No frame is wanted.
    void rest();
    [[nodiscard]] Share share() const { return governor_->share(); }

   private:
    const std::shared_ptr<Governor> governor_;
    const std::list<std::optional<Pace>>::iterator pace_;
  };

  [[nodiscard]] Share share() const;

 private:
  void assess(double now);
  void giveLess(double now);
  void giveMoreIfThereIsRoom(double now);
  [[nodiscard]] Share shareNow() const;

  const BusyShare busyShare_;
  mutable std::mutex mutex_;
  std::list<std::optional<Pace>> paces_;
  std::size_t scale_ = 0;  ///< index
  std::size_t rate_ = 0;   ///< index, of pages that move pictures
  double busy_ = 1.0;      ///< share of the workers, smoothed
  double assessed_ = 0.0;
  double missing_ = 0.0;  ///< missing frames, in seconds, since the machine last held the rate
  double changed_ = 0.0;
  bool gaveMore_ = false;  ///< with the last change
  double patience_ = 0.0;  ///< seconds until more may be given
};

}  // namespace grove::stream
