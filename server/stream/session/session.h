#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "node/messages.h"
#include "stream/adapt/page_clock.h"
#include "stream/adapt/stream_control.h"
#include "stream/encode/encoded_frame.h"
#include "stream/protocol/protocol.h"
#include "stream/session/camera_lead.h"
#include "stream/session/frame_cadence.h"
#include "world/players.h"

namespace grove::node {
class FrontendNode;
}

namespace grove::stream {

class Host;
class EncodeStage;
class WorldInstance;

/// Receives each new frame, on a worker thread; must not block. A newer frame replaces an unsent one.
using FrameSink = std::function<void(std::shared_ptr<const EncodedFrame>)>;
/// Receives the state of the stream, on the host's clock thread; must not block.
using StatusSink = std::function<void(const Status&)>;

using TimesSink = std::function<void(const Times&)>;
/// Receives Captured messages, on a worker thread; must not block.
using CaptureSink = std::function<void(std::vector<std::uint8_t>)>;

/// What a page supports, and its messages before Hello.
struct StreamTerms {
  PageLevel page = PageLevel::kBasic;
  StatusSink status;  ///< of pages since v1.2
  std::optional<Offer> offer;
  std::optional<Limits> limits;
  TimesSink times = {};  ///< of pages since v1.3
  CaptureSink captured = {};
};

/// One visitor: a camera in the world, a frontend node that draws its view, and an encoder. Independent of sockets, so
/// a websocket connection and a headless test use it alike. Thread-safe.
class Session : public std::enable_shared_from_this<Session> {
 public:
  /// Use Host::open().
  Session(Host& host, node::SessionId id, world::PlayerId player, int width, int height, FrameSink sink,
          StreamTerms terms);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  [[nodiscard]] Welcome welcome() const;

  /// Applies the newest controls; a refusal closes the connection.
  [[nodiscard]] std::optional<Refusal> input(const world::Input& input);
  [[nodiscard]] std::optional<Refusal> resize(const Resize& resize);
  /// A frame was presented; starts the next one at once if it is due. Refuses a frame that was never sent.
  [[nodiscard]] std::optional<Refusal> acknowledge(const Ack& ack);
  [[nodiscard]] std::optional<Refusal> acknowledge(const Presented& presented);
  [[nodiscard]] std::optional<Refusal> acknowledge(const Painted& painted);
  void offer(const Offer& offer);
  void limit(const Limits& limits);
  void broken();
  void capture(const Capture& capture) { control_->capture(capture.number); }
  /// The socket took all of this frame at `now`; the writing thread reached it at `reached`.
  void written(std::uint32_t frame, double reached, double now) { control_->written(frame, reached, now); }

  /// Seconds for which the page has been hidden; 0 if it is visible.
  [[nodiscard]] double secondsHidden(double now) const;

  /// Leaves the world for this reason, which refusal() returns.
  void refuse(Refusal why);
  /// Why the visitor had to leave; empty before.
  [[nodiscard]] std::optional<Refusal> refusal() const;

  /// Leaves the world. No frame reaches the sink after close() has returned and the runs in progress have ended.
  void close();

  /// Starts a frame, or queues for it, if one is due, fewer than `framesInFlight` are in progress and the line has
  /// room. Returns when to call again. Called by the host's frame clock.
  double tick(double now);

  /// Seconds since the last acknowledgement; 0 if no frame is unacknowledged. A repeated acknowledgement does not
  /// count.
  [[nodiscard]] double secondsUnacknowledged(double now) const;

 private:
  friend class Host;
  /// Starts the frames of this world.
  void begin(std::shared_ptr<WorldInstance> instance);
  [[nodiscard]] node::View look(node::FrameNumber frame);
  double startIfDue(double now);
  /// The gate has a place for this session's next frame.
  void takeTurn();
  [[nodiscard]] std::optional<Refusal> arrived(std::uint32_t frame, const Arrival& arrival);
  [[nodiscard]] Arrival arrivalOf(const Presented& presented);
  /// With mutex_ held: returns whether one more frame would only wait for acknowledgements.
  [[nodiscard]] bool isBehind(double now) const;
  /// With mutex_ held and a place in the gate: begins a frame if one is still due.
  [[nodiscard]] bool startFrame(double now);
  void deliver(const std::shared_ptr<const EncodedFrame>& frame);
  /// Reports to the world, if there is one, whether the visitor blows.
  void reportBreath();
  [[nodiscard]] std::shared_ptr<WorldInstance> currentInstance() const;

  Host& host_;
  const node::SessionId id_;
  const world::PlayerId player_;
  const FrameSink sink_;
  const StreamTerms terms_;
  const std::shared_ptr<StreamControl> control_;
  CameraLead lead_;  ///< used by look(), which runs once at a time

  mutable std::mutex mutex_;
  bool closed_ = false;
  std::optional<Refusal> refusal_;
  std::shared_ptr<WorldInstance> instance_;  ///< null before it is ready and after close()
  std::shared_ptr<EncodeStage> encoder_;
  std::unique_ptr<node::FrontendNode> node_;
  PageClock pageClock_;
  FrameCadence cadence_;
  double nextDeadlineCheck_ = 0.0;
  bool waits_ = false;                 ///< in the gate's queue
  bool entered_ = false;               ///< has been sent a frame
  std::optional<double> hiddenSince_;  ///< until a visible page acknowledges a frame
};

}  // namespace grove::stream
