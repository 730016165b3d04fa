#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <shared_mutex>

#include "node/frontend/asked_pictures.h"
#include "node/frontend/frontend_half.h"
#include "node/frontend/frontend_types.h"
#include "node/frontend/shared/shared_receiver.h"
#include "node/frontend/shared/shared_store.h"
#include "node/transport/transport.h"
#include "world/layout.h"

namespace grove::node {

/// What a frontend process says to each backend node first.
[[nodiscard]] NodeHello helloOf(ProcessId process, const world::Layout& layout);

/// What the frontend nodes of a process have in common: the world's layout, the link to the backend node, the shared
/// store, and where each session takes its results. Any thread.
class FrontendProcess final : public FrontendPort {
 public:
  /// Says hello to the backend node, among whose frontend processes `id` is distinct. All of it outlives the process.
  FrontendProcess(ProcessId id, const world::Layout& layout, const FrontendTypes& types, FrontendEnd& transport,
                  const FrontendTools& tools, std::size_t maxSharedBytes);
  ~FrontendProcess() override;
  FrontendProcess(const FrontendProcess&) = delete;
  FrontendProcess& operator=(const FrontendProcess&) = delete;

  /// Pictures for `session` go to `receiver` for as long as it lives.
  void connect(SessionId session, std::weak_ptr<pipeline::Inlet<Result>> receiver);
  void disconnect(SessionId session);

  pipeline::PushResult send(ToBackend message) { return transport_.send(std::move(message)); }
  /// Asks for a picture, so that its answer is let in.
  pipeline::PushResult askForPicture(Request request);
  void receive(ToFrontend message) override;

  /// Makes a result's payload of the bytes that it came as; one that came by reference stays as it is. Throws
  /// PackingError, also for a picture that nobody asked for, or that is larger than what was asked for.
  void unpack(Result& result);

  [[nodiscard]] const world::Layout& layout() const noexcept { return layout_; }
  /// The type of an object of the world. Asserts that this process knows it.
  [[nodiscard]] const FrontendType& type(world::TypeIndex index) const;
  /// Null if the world has no such object.
  [[nodiscard]] const FrontendType* typeOf(world::ObjectId id) const;
  [[nodiscard]] SharedStore& shared() noexcept { return store_; }
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
  SharedStore store_;
  const std::shared_ptr<SharedReceiver> sharedReceiver_;
  std::shared_mutex mutex_;
  std::map<world::ObjectId, std::uint64_t> epochs_;  ///< of the nodes that have served them last
  std::map<SessionId, std::weak_ptr<pipeline::Inlet<Result>>> sessions_;
};

}  // namespace grove::node
