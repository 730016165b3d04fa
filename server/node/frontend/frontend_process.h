#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <shared_mutex>

#include "node/frontend/frames/asked_pictures.h"
#include "node/frontend/frames/redraw_turns.h"
#include "node/frontend/frontend_half.h"
#include "node/frontend/frontend_types.h"
#include "node/frontend/shared/shared_receiver.h"
#include "node/frontend/shared/shared_store.h"
#include "node/transport/transport.h"
#include "world/layout.h"

namespace grove::node {

/// The first message of a frontend process to each backend node.
[[nodiscard]] NodeHello helloOf(ProcessId process, const world::Layout& layout);

/// The common part of a process's frontend nodes: the world's layout, the link to the backend node, the shared store,
/// and the result receiver of each session. Thread-safe.
class FrontendProcess final : public FrontendPort {
 public:
  /// Sends hello to the backend node; `id` is unique among its frontend processes. All arguments outlive the process.
  FrontendProcess(ProcessId id, const world::Layout& layout, const FrontendTypes& types, FrontendEnd& transport,
                  const FrontendTools& tools, std::size_t maxSharedBytes);
  ~FrontendProcess() override;
  FrontendProcess(const FrontendProcess&) = delete;
  FrontendProcess& operator=(const FrontendProcess&) = delete;

  /// Sends pictures for `session` to `receiver` as long as it lives.
  void connect(SessionId session, std::weak_ptr<pipeline::Inlet<Result>> receiver);
  void disconnect(SessionId session);

  pipeline::PushResult send(ToBackend message) { return transport_.send(std::move(message)); }
  /// Requests a picture, and expects its answer.
  pipeline::PushResult requestPicture(Request request);
  void receive(ToFrontend message) override;

  /// Unpacks a result's payload; leaves one that came by reference unchanged. Throws PackingError, also for a picture
  /// that nobody requested or that is larger than requested.
  void unpack(Result& result);

  [[nodiscard]] const world::Layout& layout() const noexcept { return layout_; }
  /// Returns the type of an object of the world. Asserts that this process knows it.
  [[nodiscard]] const FrontendType& type(world::TypeIndex index) const;
  /// Returns null if the world has no such object.
  [[nodiscard]] const FrontendType* typeOf(world::ObjectId id) const;
  [[nodiscard]] SharedStore& shared() noexcept { return store_; }
  [[nodiscard]] RedrawTurns& redrawTurns() noexcept { return redrawTurns_; }
  [[nodiscard]] const FrontendTools& tools() const noexcept { return tools_; }

 private:
  void receive(Result result);
  void welcomed(const NodeWelcome& welcome);

  const ProcessId id_;
  const world::Layout& layout_;
  const FrontendTypes& types_;
  FrontendEnd& transport_;
  const FrontendTools tools_;
  AskedPictures pictures_;
  RedrawTurns redrawTurns_;
  SharedStore store_;
  const std::shared_ptr<SharedReceiver> sharedReceiver_;
  std::shared_mutex mutex_;
  std::map<world::ObjectId, std::uint64_t> epochs_;  ///< of the nodes that served them last
  std::map<SessionId, std::weak_ptr<pipeline::Inlet<Result>>> sessions_;
};

}  // namespace grove::node
