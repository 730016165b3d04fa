#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "node/messages/obstacle_messages.h"
#include "node/messages/packing/picture_packing.h"
#include "node/messages/wire/wire.h"
#include "objects/builtin_frontends.h"

namespace {

using namespace grove;

void decodeForBackend(std::string_view header) {
  const auto viewOf = [](node::SessionId, node::FrameNumber) { return std::make_shared<const node::View>(); };
  const auto decoded = node::decodeToBackend(header, viewOf);
  if (const auto* message = std::get_if<node::ToBackend>(&decoded)) (void)node::encode(*message);
}

void decodeForFrontend(std::string_view header, bool withBulk) {
  const auto bulk = withBulk ? std::make_shared<const node::PackedBytes>(3) : nullptr;
  const auto decoded = node::decodeToFrontend({std::string(header), bulk});
  if (const auto* message = std::get_if<node::ToFrontend>(&decoded)) (void)node::encode(*message);
}

void unpackPicture(std::span<const std::byte> bytes) {
  static raster::ImagePool images;
  constexpr world::Rect kAsked{-1000, -1000, 1000, 1000};
  (void)node::packPicture(*node::unpackPicture(bytes, kAsked, images));
}

/// What a node asks about obstacles, or what another one answers.
void decodeObstacles(std::string_view bytes, bool isAnswer) {
  constexpr int kCells = 16;
  if (isAnswer) {
    const auto cells = node::decodeCells(bytes, kCells);
    if (const auto* decoded = std::get_if<node::CubeCells>(&cells)) (void)node::encodeCells(*decoded);
  } else {
    const auto request = node::decodeObstacleRequest(bytes);
    if (const auto* decoded = std::get_if<node::ObstacleRequest>(&request)) (void)node::encode(*decoded);
  }
}

/// As the type's own data, and as what it has under a key.
void unpackShared(const node::FrontendType& type, bool ownData, std::span<const std::byte> bytes) {
  (void)type.unpack(ownData ? node::Key() : node::Key("key"), 1, bytes, nullptr);
}

}  // namespace

/// Gives libFuzzer's bytes to everything that decodes what a peer sends. The first byte chooses.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const node::FrontendTypes types = objects::builtinFrontends();
  constexpr std::size_t kFirstType = 4;
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  const auto bytes = std::as_bytes(std::span(data + 1, size - 1));
  const std::size_t choice = data[0] % (kFirstType + types.all().size());
  const bool other = data[0] >= 128;
  try {
    if (choice == 0) {
      decodeForBackend(text);
    } else if (choice == 1) {
      decodeForFrontend(text, other);
    } else if (choice == 2) {
      unpackPicture(bytes);
    } else if (choice == 3) {
      decodeObstacles(text, other);
    } else {
      unpackShared(*types.all()[choice - kFirstType], other, bytes);
    }
  } catch (const node::PackingError&) {
  }
  return 0;
}
