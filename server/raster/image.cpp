#include "raster/image.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <list>
#include <map>
#include <utility>

namespace grove::raster {
namespace {

constexpr std::size_t kPixelBytes = sizeof(std::uint32_t) + sizeof(float);

/// Size of the largest memory that an image may use, in multiples of what it needs.
constexpr std::size_t kMaxLarger = 2;

// Sizes are rounded up so that a moving object's slightly different rectangles reuse memory.
std::size_t roundedPixels(std::size_t pixels) {
  const std::size_t granule = std::max<std::size_t>(1024, std::bit_ceil(pixels) / 8);
  return (pixels + granule - 1) / granule * granule;
}

std::size_t pixelsOf(const world::Rect& rect) {
  return rect.empty() ? 0 : static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height());
}

/// Pixels of all memory pages that may contain covered pixels.
std::size_t touchedPixels(const Image& image) {
  constexpr std::size_t kPage = 4096 / sizeof(std::uint32_t);
  std::size_t pages = 0;
  std::size_t next = 0;  // first uncounted page
  for (int row = 0; row < image.height(); ++row) {
    const Span span = image.span(row);
    if (span.begin >= span.end) continue;
    const auto at = [&](int column) { return static_cast<std::size_t>(std::ptrdiff_t{row} * image.width() + column); };
    const std::size_t end = at(span.end - 1) / kPage + 1;
    const std::size_t begin = std::max(at(span.begin) / kPage, next);
    if (end > begin) pages += end - begin;
    next = std::max(next, end);
  }
  return pages * kPage;
}

}  // namespace

struct ImagePool::Store {
  struct Memory {
    std::unique_ptr<std::uint32_t[]> words;  // colour, then depth
    std::size_t pixels = 0;
    std::size_t touched = 0;  // most pixels that any image has touched: only their pages are resident
  };
  using Unused = std::list<Memory>;

  explicit Store(std::size_t max) : maxBytes(max) {}

  const std::size_t maxBytes;
  std::mutex mutex;
  Unused unused;                                        // the newest first
  std::multimap<std::size_t, Unused::iterator> bySize;  // in pixels, of one size the newest last
  std::size_t unusedBytes = 0;
  std::size_t allBytes = 0;                    // touched by released images
  std::unique_ptr<pipeline::HeldMemory> held;  // null without a ledger

  /// At least this many pixels.
  Memory take(std::size_t pixels) {
    Memory memory = takeUnused(pixels);
    if (!memory.words) memory = {std::unique_ptr<std::uint32_t[]>(new std::uint32_t[pixels * 2]), pixels};
    return memory;
  }

  Memory takeUnused(std::size_t pixels) {
    const std::lock_guard lock(mutex);
    const auto smallest = bySize.lower_bound(pixels);
    if (smallest == bySize.end() || smallest->first > kMaxLarger * pixels) return {};
    const auto it = std::prev(bySize.upper_bound(smallest->first));  // caches may contain part of it
    Memory memory = std::move(*it->second);
    unused.erase(it->second);
    bySize.erase(it);
    unusedBytes -= memory.pixels * kPixelBytes;
    return memory;
  }

  /// `touched`: pixels that the image has touched, known only at its end.
  void give(Memory memory, std::size_t touched) {
    Unused freed;  // after the lock
    const std::lock_guard lock(mutex);
    if (touched > memory.touched) {
      allBytes += (touched - memory.touched) * kPixelBytes;
      memory.touched = touched;
      report();
    }
    const std::size_t pixels = memory.pixels;
    unusedBytes += pixels * kPixelBytes;
    unused.push_front(std::move(memory));
    bySize.emplace(pixels, unused.begin());
    // Sizes that nobody wants any more must not keep out those that every frame wants.
    while (unusedBytes > maxBytes) freed.splice(freed.begin(), unused, forgetOldest());
  }

  void freeUnused() {
    Unused freed;  // after the lock
    const std::lock_guard lock(mutex);
    while (!unused.empty()) freed.splice(freed.begin(), unused, forgetOldest());
  }

  /// The oldest unused memory, which is still in the list.
  Unused::iterator forgetOldest() {
    const auto oldest = std::prev(unused.end());
    bySize.erase(std::ranges::find(bySize, oldest, [](const auto& each) { return each.second; }));
    unusedBytes -= oldest->pixels * kPixelBytes;
    allBytes -= oldest->touched * kPixelBytes;
    report();
    return oldest;
  }

  /// The total changes only on allocation and release, so frames that reuse memory report nothing.
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

/// Memory in use.
struct ImagePool::Held {
  std::size_t used = 0;  ///< of the memory's pixels
  Store::Memory memory;
  std::shared_ptr<Store> store;
  Image image;  ///< of acquire()

  Held() = default;
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;
  ~Held() { store->give(std::move(memory), image.spans.empty() ? used : touchedPixels(image)); }
};

std::shared_ptr<ImagePool::Held> ImagePool::hold(std::size_t pixels) {
  auto held = std::make_shared<Held>();
  held->store = store_;
  held->used = pixels;
  held->memory = store_->take(roundedPixels(pixels));
  return held;
}

std::shared_ptr<Image> ImagePool::acquire(const world::Rect& rect) {
  const std::size_t used = pixelsOf(rect);
  const std::shared_ptr<Held> held = hold(used);
  std::uint32_t* const words = held->memory.words.get();
  held->image.rect = rect;
  held->image.colour = std::span(words, used);
  held->image.depth = std::span(reinterpret_cast<float*>(words + held->memory.pixels), used);
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
