#include "node/image.h"

#include <bit>
#include <map>
#include <utility>

namespace grove::node {
namespace {

using Memory = std::unique_ptr<std::uint32_t[]>;  // colour, then depth

// Sizes are rounded up so that a moving object's slightly different rectangles share memory.
std::size_t roundedPixels(std::size_t pixels) {
  const std::size_t granule = std::max<std::size_t>(1024, std::bit_ceil(pixels) / 8);
  return (pixels + granule - 1) / granule * granule;
}

}  // namespace

struct ImagePool::Store {
  explicit Store(std::size_t most) : mostBytes(most) {}

  const std::size_t mostBytes;
  std::mutex mutex;
  std::multimap<std::size_t, Memory> unused;  // by pixels
  std::size_t bytes = 0;

  Memory take(std::size_t pixels) {
    const std::lock_guard lock(mutex);
    const auto it = unused.find(pixels);
    if (it == unused.end()) return nullptr;
    Memory memory = std::move(it->second);
    unused.erase(it);
    bytes -= pixels * 8;
    return memory;
  }

  void give(std::size_t pixels, Memory memory) {
    const std::lock_guard lock(mutex);
    if (bytes + pixels * 8 > mostBytes) return;
    unused.emplace(pixels, std::move(memory));
    bytes += pixels * 8;
  }
};

ImagePool::ImagePool(std::size_t mostBytes) : store_(std::make_shared<Store>(mostBytes)) {}

std::shared_ptr<Image> ImagePool::acquire(const world::Rect& rect) {
  struct Owned {
    Image image;
    std::size_t pixels = 0;
    Memory memory;
    std::shared_ptr<Store> store;

    Owned() = default;
    Owned(const Owned&) = delete;
    Owned& operator=(const Owned&) = delete;
    ~Owned() { store->give(pixels, std::move(memory)); }
  };
  const std::size_t used =
      rect.empty() ? 0 : static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height());
  const std::size_t pixels = roundedPixels(used);
  const auto owned = std::make_shared<Owned>();
  owned->pixels = pixels;
  owned->store = store_;
  owned->memory = store_->take(pixels);
  if (!owned->memory) owned->memory = Memory(new std::uint32_t[pixels * 2]);
  owned->image.rect = rect;
  owned->image.colour = {owned->memory.get(), used};
  owned->image.depth = {reinterpret_cast<float*>(owned->memory.get() + pixels), used};
  return {owned, &owned->image};
}

std::size_t ImagePool::unusedBytes() const {
  const std::lock_guard lock(store_->mutex);
  return store_->bytes;
}

}  // namespace grove::node
