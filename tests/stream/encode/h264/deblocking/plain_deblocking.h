#pragma once

#include <array>
#include <cstddef>

#include "stream/encode/h264/macroblock.h"
#include "stream/encode/h264/reference_picture.h"

namespace grove::tests {

/// How often each case of the filter occurred, in samples of an edge.
struct DeblockingCases {
  std::array<int, 5> strengths = {};                    ///< of luma
  std::array<std::array<int, 2>, 2> filtered = {};      ///< [chroma][filterSamplesFlag], of strengths above 0
  std::array<std::array<int, 2>, 2> strongSmooth = {};  ///< luma of strength 4: [p or q][filtered by the long filter]
  std::array<std::array<int, 2>, 2> normalSmooth = {};  ///< luma below strength 4: [p or q][ap or aq below beta]
  std::array<int, 2> clipped = {};                      ///< luma below strength 4: [delta was beyond tC]

  void add(const DeblockingCases& other);
};

/// The deblocking filter of whole pictures, sample by sample in the words and order of ITU-T H.264, 8.7.
class PlainDeblocking {
 public:
  PlainDeblocking(const stream::h264::MacroblockGrid& grid, stream::h264::ReferencePicture& picture)
      : grid_(grid), picture_(picture) {}

  void run();

  [[nodiscard]] const DeblockingCases& cases() const { return cases_; }

 private:
  /// A sample's place in its plane.
  struct Place {
    int x;
    int y;
  };
  /// The samples around one place of an edge, p[0] and q[0] being beside it.
  struct Samples {
    std::array<int, 4> p;
    std::array<int, 4> q;
  };
  /// What the filter of one place depends on.
  struct Setting {
    bool chroma;
    int strength;
    int alpha;
    int beta;
    int tC0;
  };

  void filterMacroblock(int column, int row);
  /// All samples of one edge; `plane` as in ReferencePicture. `q0`: its first sample.
  void filterEdge(std::size_t plane, bool vertical, Place q0);
  void filterSamples(std::size_t plane, bool vertical, Place q0);
  [[nodiscard]] int strengthAt(Place p0, Place q0) const;
  [[nodiscard]] Setting settingAt(std::size_t plane, Place p0, Place q0);
  [[nodiscard]] Samples filtered(const Samples& from, const Setting& setting);
  [[nodiscard]] Samples filteredBelow4(const Samples& from, const Setting& setting);
  [[nodiscard]] Samples filteredWith4(const Samples& from, const Setting& setting);
  [[nodiscard]] const stream::h264::Macroblock& macroblockAt(Place luma) const;

  const stream::h264::MacroblockGrid& grid_;
  stream::h264::ReferencePicture& picture_;
  DeblockingCases cases_;
};

}  // namespace grove::tests
