#include "stream/web_server/served_world.h"

#include <chrono>
#include <thread>

namespace grove::stream {
namespace {

node::LoadedScene emptyWorld() {
  node::LoadedScene scene;
  scene.layout.name = "Nowhere";
  return scene;
}

}  // namespace

GoodClient::GoodClient(int port, int width, int height) : GoodClient(RawWebsocket(port), width, height) {}

GoodClient::GoodClient(RawWebsocket websocket, int width, int height) : websocket_(std::move(websocket)) {
  websocket_.send(encode(Hello{"Ada", static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)}));
}

bool GoodClient::receiveFrames(int count) {
  while (count > 0) {
    const auto message = websocket_.receive();
    if (!message || message->opcode != RawWebsocket::kBinary) return false;
    const ServerMessage parsed = parseServerMessage(message->bytes);
    if (std::holds_alternative<Refusal>(parsed)) return false;
    const auto* frame = std::get_if<FrameMessage>(&parsed);
    if (frame == nullptr) continue;
    lastFrame_ = frame->header;
    websocket_.send(encode(Ack{frame->header.frame}));
    --count;
  }
  return true;
}

ServedWorld::ServedWorld()
    : gl_(gl::ContextKind::kAuto, shaders_, 1),
      host_(node::localWorld(emptyWorld(), types_.backends, gl_), types_.frontends, {.maxVisitors = kMaxVisitors},
            [](std::string_view, float) {}),
      server_(host_, {.visitors = {"127.0.0.1", 0}, .operators = {}}) {
  server_.start();
}

bool ServedWorld::becomesEmpty() {
  for (int i = 0; i < 500; ++i) {
    if (host_.visitors() == 0 && host_.players().count() == 0) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

}  // namespace grove::stream
