#pragma once

#include <gtest/gtest.h>

#include "gl/shader_library.h"
#include "gl/workers.h"
#include "node/local/local_world.h"
#include "node/object_types.h"
#include "stream/session/host.h"
#include "stream/web_server/raw_websocket.h"
#include "stream/web_server/websocket_server.h"

namespace grove::stream {

/// A browser that does as PROTOCOL.md says.
class GoodClient {
 public:
  explicit GoodClient(int port, int width = 320, int height = 180);
  explicit GoodClient(RawWebsocket websocket, int width = 320, int height = 180);

  /// Receives and acknowledges frames; false if the connection ends before.
  bool receiveFrames(int count);
  [[nodiscard]] RawWebsocket& websocket() noexcept { return websocket_; }
  [[nodiscard]] const FrameHeader& lastFrame() const noexcept { return lastFrame_; }

 private:
  RawWebsocket websocket_;
  FrameHeader lastFrame_;
};

/// A real server with an empty world and room for four, on a free port.
class ServedWorld : public testing::Test {
 protected:
  static constexpr int kMaxVisitors = 4;
  ServedWorld();

  [[nodiscard]] int port() const { return server_.port(); }
  [[nodiscard]] int operatorPort() const { return server_.operatorPort(); }
  /// Whether everybody has left the world, within 5 seconds.
  [[nodiscard]] bool becomesEmpty();

  gl::ShaderLibrary shaders_;
  node::ObjectTypes types_;
  gl::Workers gl_;
  Host host_;
  WebsocketServer server_;
};

}  // namespace grove::stream
