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
#include "world/players.h"

namespace grove::node {
class FrontendNode;
}

namespace grove::stream {

class Host;
class EncodeStage;
class WorldInstance;

/// Receives each new frame, on a worker thread; must not block. A newer frame replaces one that was not sent yet.
using FrameSink = std::function<void(std::shared_ptr<const EncodedFrame>)>;
/// Gets how the stream stands, on the host's clock; must not block.
using StatusSink = std::function<void(const Status&)>;

using TimesSink = std::function<void(const Times&)>;
/// Gets Captured messages, on a worker thread; must not block.
using CaptureSink = std::function<void(std::vector<std::uint8_t>)>;

/// What a page understands, and what it said before Hello.
struct StreamTerms {
  PageLevel page = PageLevel::kBasic;
  StatusSink status;  ///< of pages since v1.2
  std::optional<Offer> offer;
  std::optional<Limits> limits;
  TimesSink times = {};  ///< of pages since v1.3
  CaptureSink captured = {};
};

/// One visitor: a camera in the world, a frontend node that draws what it sees, and an encoder. Knows no sockets, so a
/// websocket connection and a headless test use it alike. Any thread.
class Session : public std::enable_shared_from_this<Session> {
 public:
  /// Use Host::open().
  Session(Host& host, node::SessionId id, world::PlayerId player, int width, int height, FrameSink sink,
          StreamTerms terms);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  [[nodiscard]] Welcome welcome() const;

  /// Takes over the newest controls; a refusal closes the connection.
  [[nodiscard]] std::optional<Refusal> input(const world::Input& input);
  [[nodiscard]] std::optional<Refusal> resize(const Resize& resize);
  /// A frame was presented; starts the next one at once if it is due. A frame that was never sent is refused.
  [[nodiscard]] std::optional<Refusal> acknowledge(const Ack& ack);
  [[nodiscard]] std::optional<Refusal> acknowledge(const Presented& presented);
  [[nodiscard]] std::optional<Refusal> acknowledge(const Painted& painted);
  void offer(const Offer& offer);
  void limit(const Limits& limits);
  void broken();
  void capture(const Capture& capture) { control_->capture(capture.number); }
  /// The socket has taken all of this frame at `now`; the thread that writes had come to it at `reached`.
  void written(std::uint32_t frame, double reached, double now) { control_->written(frame, reached, now); }

  /// How long nobody has looked, seconds; 0 while somebody does.
  [[nodiscard]] double secondsHidden(double now) const;

  /// Leaves the world because of this, which refusal() reports.
  void refuse(Refusal why);
  /// Why he had to leave; none while he is here.
  [[nodiscard]] std::optional<Refusal> refusal() const;

  /// Leaves the world; no frame reaches the sink after close() returned and the runs in progress ended.
  void close();

  /// Starts a frame if one is due, fewer than `framesInFlight` are being made and the line has room for one, or waits
  /// for its turn to. Returns when to ask again. Called by the host's frame clock.
  double tick(double now);

  /// How long frames have been waiting to be acknowledged, seconds, since one was last; 0 if there is none. To
  /// acknowledge one a second time does not count.
  [[nodiscard]] double secondsUnacknowledged(double now) const;

 private:
  friend class Host;
  /// Starts to deliver frames of this world.
  void begin(std::shared_ptr<WorldInstance> instance);
  [[nodiscard]] node::View look(node::FrameNumber frame);
  double startIfDue(double now);
  /// The gate has a place for this session's next frame.
  void takeTurn();
  [[nodiscard]] std::optional<Refusal> arrived(std::uint32_t frame, const Arrival& arrival);
  [[nodiscard]] Arrival arrivalOf(const Presented& presented);
  /// With mutex_ held: whether one more frame would only wait for the visitor to acknowledge others.
  [[nodiscard]] bool isBehind(double now) const;
  /// With mutex_ held and a place in the gate: begins a frame if one still is due.
  [[nodiscard]] bool startFrame(double now);
  void deliver(const std::shared_ptr<const EncodedFrame>& frame);
  /// Reports to the world, if there is one, whether he blows.
  void reportBreath();
  [[nodiscard]] std::shared_ptr<WorldInstance> currentInstance() const;

  Host& host_;
  const node::SessionId id_;
  const world::PlayerId player_;
  const FrameSink sink_;
  const StreamTerms terms_;
  const std::shared_ptr<StreamControl> control_;

  mutable std::mutex mutex_;
  bool closed_ = false;
  std::optional<Refusal> refusal_;
  std::shared_ptr<WorldInstance> instance_;  ///< null until it is ready, and once closed
  std::shared_ptr<EncodeStage> encoder_;
  std::unique_ptr<node::FrontendNode> node_;
  PageClock pageClock_;
  double nextDue_ = 0.0;
  double nextDeadlineCheck_ = 0.0;
  bool waits_ = false;                 ///< for its turn
  bool entered_ = false;               ///< has been sent a frame
  std::optional<double> hiddenSince_;  ///< until a frame is acknowledged that somebody sees
};

}  // namespace grove::stream
