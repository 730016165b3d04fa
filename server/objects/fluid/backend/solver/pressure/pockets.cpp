#include "objects/fluid/backend/solver/pressure/pockets.h"

#include <cstring>
#include <numeric>

namespace grove::objects::fluid {

namespace {

/// Disjoint sets with path halving.
class Sets {
 public:
  int add() {
    parent_.push_back(static_cast<int>(parent_.size()));
    return parent_.back();
  }
  int root(int i) {
    while (parent_[at(i)] != i) {
      parent_[at(i)] = parent_[at(parent_[at(i)])];
      i = parent_[at(i)];
    }
    return i;
  }
  void join(int a, int b) { parent_[at(root(a))] = root(b); }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  std::vector<int> parent_;
};

struct LabelledRun {
  int begin = 0;  ///< first cell
  int end = 0;    ///< after the last cell
  int label = 0;
};

/// Joins overlapping runs of two adjacent rows.
void joinRows(const LabelledRun* a, const LabelledRun* aEnd, const LabelledRun* b, const LabelledRun* bEnd,
              Sets& sets) {
  while (a != aEnd && b != bEnd) {
    if (a->begin < b->end && b->begin < a->end) sets.join(a->label, b->label);
    if (a->end < b->end) {
      ++a;
    } else {
      ++b;
    }
  }
}

}  // namespace

void Pockets::find(const SolidGrid& solids) {
  const Layout& layout = solids.layout();
  const Sides& sides = solids.sides();
  const Array<std::uint8_t>& air = solids.air();
  const int n = layout.cells;
  Sets sets;
  const int outside = sets.add();
  std::vector<LabelledRun> runs;
  std::vector<std::size_t> firstOfRow{0};
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      const std::uint8_t* row = air.data() + layout.index(0, y, z);
      for (int x = 0; x < n;) {
        if (row[x] == 0) {
          ++x;
          continue;
        }
        const void* wall = std::memchr(row + x, 0, static_cast<std::size_t>(n - x));
        const int end = wall == nullptr ? n : static_cast<int>(static_cast<const std::uint8_t*>(wall) - row);
        runs.push_back({x, end, sets.add()});
        const bool open = (x == 0 && sides.lowX) || (end == n && sides.highX) || (y == 0 && sides.lowY) ||
                          (y == n - 1 && sides.highY) || (z == 0 && sides.lowZ) || (z == n - 1 && sides.highZ);
        if (open) sets.join(runs.back().label, outside);
        x = end;
      }
      firstOfRow.push_back(runs.size());
      const std::size_t row0 = firstOfRow.size() - 2;
      const auto join = [&](std::size_t other) {
        joinRows(runs.data() + firstOfRow[row0], runs.data() + runs.size(), runs.data() + firstOfRow[other],
                 runs.data() + firstOfRow[other + 1], sets);
      };
      if (y > 0) join(row0 - 1);
      if (z > 0) join(row0 - static_cast<std::size_t>(n));
    }
  }

  pockets_.clear();
  const int open = sets.root(outside);
  std::vector<int> pocketOf(runs.size() + 1, -1);
  for (std::size_t row = 0; row + 1 < firstOfRow.size(); ++row) {
    const int y = static_cast<int>(row) % n;
    const int z = static_cast<int>(row) / n;
    for (std::size_t i = firstOfRow[row]; i < firstOfRow[row + 1]; ++i) {
      const int root = sets.root(runs[i].label);
      if (root == open) continue;
      int& pocket = pocketOf[static_cast<std::size_t>(root)];
      if (pocket < 0) {
        pocket = static_cast<int>(pockets_.size());
        pockets_.emplace_back();
      }
      pockets_[static_cast<std::size_t>(pocket)].push_back(
          {layout.index(runs[i].begin, y, z), runs[i].end - runs[i].begin});
    }
  }
}

void Pockets::removeMeans(Field& values) const {
  for (const std::vector<Run>& pocket : pockets_) {
    double sum = 0.0;
    std::size_t cells = 0;
    for (const Run& run : pocket) {
      const float* row = values.data() + run.begin;
      sum += static_cast<double>(std::accumulate(row, row + run.length, 0.0F));
      cells += static_cast<std::size_t>(run.length);
    }
    const float mean = static_cast<float>(sum / static_cast<double>(cells));
    for (const Run& run : pocket) {
      float* row = values.data() + run.begin;
      for (int i = 0; i < run.length; ++i) row[i] -= mean;
    }
  }
}

}  // namespace grove::objects::fluid
