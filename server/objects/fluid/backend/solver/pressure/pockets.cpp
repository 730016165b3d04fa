#include "objects/fluid/backend/solver/pressure/pockets.h"

#include <cstring>
#include <numeric>
#include <span>

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
void joinRows(std::span<const LabelledRun> first, std::span<const LabelledRun> second, Sets& sets) {
  auto a = first.begin();
  auto b = second.begin();
  while (a != first.end() && b != second.end()) {
    if (a->begin < b->end && b->begin < a->end) sets.join(a->label, b->label);
    if (a->end < b->end) {
      ++a;
    } else {
      ++b;
    }
  }
}

/// All runs of air along x, joined where they touch.
class LabelledRuns {
 public:
  explicit LabelledRuns(const SolidGrid& solids) {
    const int n = solids.layout().cells;
    for (int z = 0; z < n; ++z) {
      for (int y = 0; y < n; ++y) {
        addRow(solids, y, z);
        if (y > 0) joinLast(1);
        if (z > 0) joinLast(static_cast<std::size_t>(n));
      }
    }
  }

  [[nodiscard]] std::size_t count() const noexcept { return runs_.size(); }
  [[nodiscard]] std::span<const LabelledRun> row(std::size_t number) const {
    return std::span(runs_).subspan(firstOfRow_[number], firstOfRow_[number + 1] - firstOfRow_[number]);
  }
  [[nodiscard]] bool isOpen(const LabelledRun& run) { return rootOf(run) == sets_.root(outside_); }
  [[nodiscard]] int rootOf(const LabelledRun& run) { return sets_.root(run.label); }

 private:
  void addRow(const SolidGrid& solids, int y, int z) {
    const Sides& sides = solids.sides();
    const int n = solids.layout().cells;
    const std::uint8_t* row = solids.air().data() + solids.layout().index(0, y, z);
    for (int x = 0; x < n;) {
      if (row[x] == 0) {
        ++x;
        continue;
      }
      const void* wall = std::memchr(row + x, 0, static_cast<std::size_t>(n - x));
      const int end = wall == nullptr ? n : static_cast<int>(static_cast<const std::uint8_t*>(wall) - row);
      runs_.push_back({x, end, sets_.add()});
      const bool open = (x == 0 && sides.lowX) || (end == n && sides.highX) || (y == 0 && sides.lowY) ||
                        (y == n - 1 && sides.highY) || (z == 0 && sides.lowZ) || (z == n - 1 && sides.highZ);
      if (open) sets_.join(runs_.back().label, outside_);
      x = end;
    }
    firstOfRow_.push_back(runs_.size());
  }

  /// Joins the last row with the one `back` rows before it.
  void joinLast(std::size_t back) {
    const std::size_t last = firstOfRow_.size() - 2;
    joinRows(row(last), row(last - back), sets_);
  }

  Sets sets_;
  const int outside_ = sets_.add();
  std::vector<LabelledRun> runs_;
  std::vector<std::size_t> firstOfRow_{0};
};

}  // namespace

void Pockets::find(const SolidGrid& solids) {
  const auto n = static_cast<std::size_t>(solids.layout().cells);
  LabelledRuns runs(solids);
  pockets_.clear();
  std::vector<int> pocketOf(runs.count() + 1, -1);
  for (std::size_t row = 0; row < n * n; ++row) {
    for (const LabelledRun& run : runs.row(row)) {
      if (runs.isOpen(run)) continue;
      int& pocket = pocketOf[static_cast<std::size_t>(runs.rootOf(run))];
      if (pocket < 0) {
        pocket = static_cast<int>(pockets_.size());
        pockets_.emplace_back();
      }
      pockets_[static_cast<std::size_t>(pocket)].push_back(
          {solids.layout().index(run.begin, static_cast<int>(row % n), static_cast<int>(row / n)),
           run.end - run.begin});
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
