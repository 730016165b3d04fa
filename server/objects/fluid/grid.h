#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <utility>

namespace grove::objects::fluid {

/// How the cells of a cube lie in memory: x fastest, then y (up), then z; one ghost layer below index 0 and two above
/// the last cell, so that cell centres (0..n-1) and faces (0..n) of every direction share one layout. Face i is the low
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
  /// Distance in memory to the next cell along an axis.
  [[nodiscard]] std::ptrdiff_t step(int axis) const noexcept { return axis == 0 ? 1 : axis == 1 ? stride : plane; }

  static constexpr int kLead = 16;

  int cells;
  int stride;  ///< between rows; the ghosts of x lie in the gap
  int plane;   ///< between planes of constant z
};

/// One value a cell or face in a Layout, zero at first, aligned for vectors. Move-only: copies are megabytes.
template <class T>
class Array {
 public:
  explicit Array(std::size_t size) : size_(size), data_(static_cast<T*>(::operator new(size * sizeof(T), kAlignment))) {
    std::memset(data_.get(), 0, size * sizeof(T));
  }

  [[nodiscard]] T* data() noexcept { return data_.get(); }
  [[nodiscard]] const T* data() const noexcept { return data_.get(); }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] T& operator[](std::ptrdiff_t i) noexcept { return data_.get()[i]; }
  [[nodiscard]] T operator[](std::ptrdiff_t i) const noexcept { return data_.get()[i]; }

  void copyFrom(const Array& other) noexcept {
    assert(size_ == other.size_);
    std::memcpy(data_.get(), other.data_.get(), size_ * sizeof(T));
  }
  void clear() noexcept { std::memset(data_.get(), 0, size_ * sizeof(T)); }

 private:
  static constexpr std::align_val_t kAlignment{64};
  struct Free {
    void operator()(T* p) const noexcept { ::operator delete(p, kAlignment); }
  };
  std::size_t size_;
  std::unique_ptr<T, Free> data_;
};

using Field = Array<float>;

/// Staggered velocity in metres a second (marker-and-cell, Harlow and Welch 1965): component a at the low face of axis
/// a.
struct Velocity {
  explicit Velocity(const Layout& layout) : x(layout.size()), y(layout.size()), z(layout.size()) {}

  [[nodiscard]] Field& axis(int a) noexcept { return a == 0 ? x : a == 1 ? y : z; }
  [[nodiscard]] const Field& axis(int a) const noexcept { return a == 0 ? x : a == 1 ? y : z; }

  Field x, y, z;
};

/// Which of the cube's sides are open to the air (pressure 0, anything may flow); the others are walls.
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

/// Half-open box of cells.
struct CellBox {
  int low[3] = {0, 0, 0};
  int high[3] = {0, 0, 0};

  [[nodiscard]] static CellBox whole(int cells) noexcept { return {{0, 0, 0}, {cells, cells, cells}}; }
  [[nodiscard]] bool empty() const noexcept { return high[0] <= low[0] || high[1] <= low[1] || high[2] <= low[2]; }
  /// Smallest box that holds both.
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
  /// Grown by one cell everywhere, within the cube.
  [[nodiscard]] CellBox grown(int cells) const noexcept {
    CellBox box = *this;
    for (int a = 0; a < 3; ++a) {
      box.low[a] = box.low[a] > 0 ? box.low[a] - 1 : 0;
      box.high[a] = box.high[a] < cells ? box.high[a] + 1 : cells;
    }
    return box;
  }
};

}  // namespace grove::objects::fluid
