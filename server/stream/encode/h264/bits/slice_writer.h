#pragma once

#include <cstdint>
#include <span>

#include "stream/encode/h264/bits/bit_writer.h"
#include "stream/encode/h264/bits/units.h"
#include "stream/encode/h264/coded_macroblock.h"
#include "stream/encode/h264/macroblock.h"

namespace grove::stream::h264 {

/// Writes a picture's only slice, macroblock by macroblock (ITU-T H.264, sections 7.3.4 and 7.3.5), and what later
/// macroblocks need of each into the grid.
class SliceWriter {
 public:
  /// `grid` and `out` outlive it.
  SliceWriter(const SliceHeader& header, MacroblockGrid& grid, BitWriter& out);

  /// Macroblocks come row by row.
  void write(const CodedMacroblock& macroblock, int quantiser, int column, int row);
  void finish();

 private:
  void writeKind(const CodedMacroblock& macroblock, int column, int row);
  void writeVectors(const CodedMacroblock& macroblock, int column, int row);
  void writeResidual(const CodedMacroblock& macroblock, int column, int row);
  void writeLuma(const CodedMacroblock& macroblock, int column, int row);
  void writeChroma(const CodedMacroblock& macroblock, int column, int row);

  MacroblockGrid& grid_;
  BitWriter& out_;
  const bool independent_;
  int quantiser_;              ///< of the last macroblock
  std::uint32_t skipped_ = 0;  ///< macroblocks since the last one that was written
};

}  // namespace grove::stream::h264
