#include "raster/image.h"

#include <bit>
#include <map>
#include <utility>

namespace grove::raster {
namespace {

constexpr std::size_t kPixelBytes = sizeof(std::uint32_t) + sizeof(float);

// Sizes are rounded up so that a moving object's slightly different rectangles share memory.
std::size_t roundedPixels(std::size_t pixels) {
  const std::size_t granule = std::max<std::size_t>(1024, std::bit_ceil(pixels) / 8);
  return (pixels + granule - 1) / granule * granule;
}

}  // namespace

struct ImagePool::Store {
  struct Memory {
    std::unique_ptr<std::uint32_t[]> words;  // colour, then depth
    std::size_t touched = 0;                 // pixels of the largest image so far: beyond, the process holds nothing
  };

  explicit Store(std::size_t max) : maxBytes(max) {}

  const std::size_t maxBytes;
  std::mutex mutex;
  std::multimap<std::size_t, Memory> unused;  // by pixels
  std::size_t unusedBytes = 0;
  std::size_t allBytes = 0;                    // touched, in use or not
  std::unique_ptr<pipeline::HeldMemory> held;  // while there is a ledger

  /// Room for `pixels`, of which `used` are wanted.
  Memory take(std::size_t pixels, std::size_t used) {
    Memory memory = takeUnused(pixels);
    if (!memory.words) memory.words.reset(new std::uint32_t[pixels * 2]);
    if (used > memory.touched) {
      const std::lock_guard lock(mutex);
      allBytes += (used - memory.touched) * kPixelBytes;
      memory.touched = used;
      report();
    }
    return memory;
  }

  Memory takeUnused(std::size_t pixels) {
    const std::lock_guard lock(mutex);
    const auto [oldest, end] = unused.equal_range(pixels);
    if (oldest == end) return {};
    const auto it = std::prev(end);  // caches may hold some of it
    Memory memory = std::move(it->second);
    unused.erase(it);
    unusedBytes -= pixels * kPixelBytes;
    return memory;
  }

  void give(std::size_t pixels, Memory memory) {
    const std::lock_guard lock(mutex);
    if (unusedBytes + pixels * kPixelBytes > maxBytes) {
      allBytes -= memory.touched * kPixelBytes;
      report();
      return;
    }
    unused.emplace(pixels, std::move(memory));
    unusedBytes += pixels * kPixelBytes;
  }

  void freeUnused() {
    std::multimap<std::size_t, Memory> freed;  // after the lock
    const std::lock_guard lock(mutex);
    freed.swap(unused);
    unusedBytes = 0;
    for (const auto& [pixels, memory] : freed) allBytes -= memory.touched * kPixelBytes;
    report();
  }

  /// Only what is allocated and freed, so a frame that reuses memory reports nothing.
  void report() {
    if (held) held->set(allBytes);
  }
};

ImagePool::ImagePool(std::size_t maxBytes) : store_(std::make_shared<Store>(maxBytes)) {}

ImagePool::ImagePool(pipeline::MemoryLedger& memory, std::size_t maxBytes) : ImagePool(maxBytes) {
  store_->held = std::make_unique<pipeline::HeldMemory>(memory, "images", "", pipeline::Work::kPerUserFrontend);
}

ImagePool::~ImagePool() {
  const std::lock_guard lock(store_->mutex);
  store_->held.reset();
}

/// Memory that is in use.
struct ImagePool::Held {
  std::size_t pixels = 0;
  Store::Memory memory;
  std::shared_ptr<Store> store;
  Image image;  ///< of acquire()

  Held() = default;
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;
  ~Held() { store->give(pixels, std::move(memory)); }
};

std::shared_ptr<ImagePool::Held> ImagePool::hold(std::size_t pixels) {
  auto held = std::make_shared<Held>();
  held->pixels = roundedPixels(pixels);
  held->store = store_;
  held->memory = store_->take(held->pixels, pixels);
  return held;
}

std::shared_ptr<Image> ImagePool::acquire(const world::Rect& rect) {
  const std::size_t used =
      rect.empty() ? 0 : static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height());
  const std::shared_ptr<Held> held = hold(used);
  std::uint32_t* const words = held->memory.words.get();
  held->image.rect = rect;
  held->image.colour = std::span(words, used);
  held->image.depth = std::span(reinterpret_cast<float*>(words + held->pixels), used);
  return {held, &held->image};
}

ImagePool::Bytes ImagePool::acquireBytes(std::size_t size) {
  const std::shared_ptr<Held> held = hold((size + kPixelBytes - 1) / kPixelBytes);
  return {{reinterpret_cast<std::uint8_t*>(held->memory.words.get()), size}, held};
}

void ImagePool::freeUnused() { store_->freeUnused(); }

std::size_t ImagePool::unusedBytes() const {
  const std::lock_guard lock(store_->mutex);
  return store_->unusedBytes;
}

}  // namespace grove::raster
