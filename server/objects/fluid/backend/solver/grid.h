#pragma once

#include <sys/mman.h>

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <utility>

namespace grove::objects::fluid {

/// Memory layout of a cube's cells: x fastest, then y (up), then z. One ghost layer below index 0 and two above the
/// last cell, so that cell centres (0..n-1) and faces (0..n) of every direction share one layout. Face i is the low
/// face of cell i.
struct Layout {
  explicit Layout(int cellsPerEdge)
      : cells(cellsPerEdge), stride((cellsPerEdge + 15) / 16 * 16 + 16), plane(stride * (cellsPerEdge + 3)) {}

  [[nodiscard]] std::ptrdiff_t index(int x, int y, int z) const noexcept {
    return kLead + x + std::ptrdiff_t{stride} * (y + 1) + std::ptrdiff_t{plane} * (z + 1);
  }
  [[nodiscard]] std::size_t size() const noexcept {
    return static_cast<std::size_t>(2 * kLead + std::ptrdiff_t{plane} * (cells + 3));
  }
  /// Offset of the next cell along an axis.
  [[nodiscard]] std::ptrdiff_t step(int axis) const noexcept { return axis == 0 ? 1 : axis == 1 ? stride : plane; }

  static constexpr int kLead = 16;

  int cells;
  int stride;  ///< between rows; the ghosts in x lie in the gap
  int plane;   ///< between planes of constant z
};

/// One value per cell or face of a Layout, initially zero, aligned for vectors. Move-only: copies are megabytes.
template <class T>
class Array {
 public:
  explicit Array(std::size_t size) : size_(size), block_(allocate(bytes())), data_(place(block_.get(), bytes())) {}

  [[nodiscard]] T* data() noexcept { return data_; }
  [[nodiscard]] const T* data() const noexcept { return data_; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] T& operator[](std::ptrdiff_t i) noexcept { return data_[i]; }
  [[nodiscard]] T operator[](std::ptrdiff_t i) const noexcept { return data_[i]; }

  void copyFrom(const Array& other) noexcept {
    assert(size_ == other.size_);
    std::memcpy(data_, other.data_, size_ * sizeof(T));
  }
  /// Memory use.
  [[nodiscard]] std::size_t heldBytes() const noexcept { return wholeBytes(bytes()); }
  void clear() noexcept { std::memset(data_, 0, size_ * sizeof(T)); }

 private:
  static constexpr std::size_t kHugePage = std::size_t{2} << 20;
  static constexpr std::size_t kSmallPage = 4096;
  static constexpr std::size_t kVector = 64;
  struct Free {
    std::size_t mapped = 0;  ///< 0: on the heap
    void operator()(void* p) const noexcept {
      if (mapped > 0) {
        static_cast<void>(::munmap(p, mapped));
      } else {
        std::free(p);
      }
    }
  };
  using Block = std::unique_ptr<void, Free>;

  [[nodiscard]] std::size_t bytes() const noexcept { return size_ * sizeof(T); }
  [[nodiscard]] static bool isLarge(std::size_t bytes) noexcept { return bytes >= kHugePage / 2; }
  [[nodiscard]] static std::uintptr_t roundUp(std::uintptr_t value, std::size_t to) noexcept {
    return (value + to - 1) / to * to;
  }

  /// Bytes that are used, less than the mapped size.
  [[nodiscard]] static std::size_t wholeBytes(std::size_t bytes) noexcept {
    return isLarge(bytes) ? roundUp(bytes + kSmallPage, kHugePage) : roundUp(bytes, kVector);
  }

  static Block allocate(std::size_t bytes) {
    if (isLarge(bytes)) return map(bytes);
    const std::size_t whole = wholeBytes(bytes);
    Block block(std::aligned_alloc(kVector, whole), Free{});
    if (!block) throw std::bad_alloc();
    std::memset(block.get(), 0, whole);
    return block;
  }

  /// Mapped by the system, because the heap would keep freed memory. A stencil touches a dozen pages at a time; huge
  /// pages avoid page walks.
  static Block map(std::size_t bytes) {
    const std::size_t whole = wholeBytes(bytes) + kHugePage;
    void* const memory = ::mmap(nullptr, whole, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    Block block(memory, Free{whole});
    // Only a hint: without huge pages it is a little slower.
    static_cast<void>(::madvise(memory, whole, MADV_HUGEPAGE));
    // Touches all pages: memory use is then the same with and without huge pages.
    const auto address = reinterpret_cast<std::uintptr_t>(memory);
    std::memset(static_cast<char*>(memory) + (roundUp(address, kHugePage) - address), 0, wholeBytes(bytes));
    return block;
  }

  /// Equal indices of different arrays must differ in their low address bits: otherwise loads wait for unrelated
  /// stores.
  static T* place(void* block, std::size_t bytes) noexcept {
    const auto address = reinterpret_cast<std::uintptr_t>(block);
    if (!isLarge(bytes)) return static_cast<T*>(block);
    const std::uintptr_t aligned = roundUp(address, kHugePage);
    const std::size_t lines = aligned / kHugePage * 11 % (kSmallPage / kVector);
    return reinterpret_cast<T*>(static_cast<std::byte*>(block) + (aligned - address) + lines * kVector);
  }

  std::size_t size_;
  Block block_;
  T* data_;
};

using Field = Array<float>;

template <class... T>
[[nodiscard]] std::size_t heldBytes(const Array<T>&... arrays) noexcept {
  return (std::size_t{0} + ... + arrays.heldBytes());
}

/// Staggered velocity in metres per second (marker-and-cell, Harlow and Welch 1965): component a at the low face of
/// axis a.
struct Velocity {
  explicit Velocity(const Layout& layout) : x(layout.size()), y(layout.size()), z(layout.size()) {}

  [[nodiscard]] Field& axis(int a) noexcept { return a == 0 ? x : a == 1 ? y : z; }
  [[nodiscard]] const Field& axis(int a) const noexcept { return a == 0 ? x : a == 1 ? y : z; }

  [[nodiscard]] std::size_t bytes() const noexcept { return heldBytes(x, y, z); }

  Field x, y, z;
};

/// The open sides of the cube (pressure 0, free flow); the others are walls.
struct Sides {
  bool lowX = true, highX = true;
  bool lowY = false, highY = true;
  bool lowZ = true, highZ = true;

  [[nodiscard]] static Sides outdoors() noexcept { return {}; }
  [[nodiscard]] static Sides closed() noexcept { return {false, false, false, false, false, false}; }
  [[nodiscard]] bool open(int axis, bool high) const noexcept {
    if (axis == 0) return high ? highX : lowX;
    if (axis == 1) return high ? highY : lowY;
    return high ? highZ : lowZ;
  }
};

/// A half-open box of cells.
struct CellBox {
  int low[3] = {0, 0, 0};
  int high[3] = {0, 0, 0};

  [[nodiscard]] static CellBox whole(int cells) noexcept { return {{0, 0, 0}, {cells, cells, cells}}; }
  [[nodiscard]] bool empty() const noexcept { return high[0] <= low[0] || high[1] <= low[1] || high[2] <= low[2]; }
  /// The smallest box that contains both.
  void add(const CellBox& other) noexcept {
    if (other.empty()) return;
    if (empty()) {
      *this = other;
      return;
    }
    for (int a = 0; a < 3; ++a) {
      low[a] = low[a] < other.low[a] ? low[a] : other.low[a];
      high[a] = high[a] > other.high[a] ? high[a] : other.high[a];
    }
  }
  /// The box grown by one cell on all sides, within the cube.
  [[nodiscard]] CellBox grown(int cells) const noexcept {
    CellBox box = *this;
    for (int a = 0; a < 3; ++a) {
      box.low[a] = box.low[a] > 0 ? box.low[a] - 1 : 0;
      box.high[a] = box.high[a] < cells ? box.high[a] + 1 : cells;
    }
    return box;
  }
  /// Calls visit(x, y, z) for its cells as they lie in memory.
  template <class Visit>
  void forEach(const Visit& visit) const {
    for (int z = low[2]; z < high[2]; ++z) {
      for (int y = low[1]; y < high[1]; ++y) {
        for (int x = low[0]; x < high[0]; ++x) visit(x, y, z);
      }
    }
  }
};

}  // namespace grove::objects::fluid
