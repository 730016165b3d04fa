#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string_view>

#include "node/messages/picture_packing.h"
#include "node/messages/wire.h"

/// Gives libFuzzer's bytes to everything that decodes what a peer sends. The first byte chooses.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace grove;
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  const auto* const begin = reinterpret_cast<const std::byte*>(data) + 1;
  switch (data[0] % 3) {
    case 0: {
      const auto viewOf = [](node::SessionId, node::FrameNumber) { return std::make_shared<const node::View>(); };
      const auto decoded = node::decodeToBackend(text, viewOf);
      if (const auto* message = std::get_if<node::ToBackend>(&decoded)) (void)node::encode(*message);
      break;
    }
    case 1: {
      const auto bulk = data[0] < 128 ? std::make_shared<const node::PackedBytes>(3) : nullptr;
      const auto decoded = node::decodeToFrontend({std::string(text), bulk});
      if (const auto* message = std::get_if<node::ToFrontend>(&decoded)) (void)node::encode(*message);
      break;
    }
    default:
      try {
        static raster::ImagePool images;
        constexpr world::Rect kAsked{-2000, -2000, 2000, 2000};
        (void)node::packPicture(*node::unpackPicture({begin, size - 1}, kAsked, images));
      } catch (const node::PackingError&) {
      }
  }
  return 0;
}
