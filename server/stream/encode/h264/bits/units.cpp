#include "stream/encode/h264/bits/units.h"

#include <algorithm>
#include <array>
#include <bit>

namespace grove::stream::h264 {
namespace {

constexpr std::uint32_t kBaseline = 66;
constexpr int kFrameNumberBits = std::bit_width(kFrameNumbers) - 1;

/// A level's number and the macroblocks of a picture and of a second that it allows (table A-1).
struct Level {
  std::uint32_t number;
  int picture;
  int second;
};
constexpr std::array<Level, 8> kLevels{{{30, 1620, 40500},
                                        {31, 3600, 108000},
                                        {32, 5120, 216000},
                                        {40, 8192, 245760},
                                        {42, 8704, 522240},
                                        {50, 22080, 589824},
                                        {51, 36864, 983040},
                                        {52, 36864, 2073600}}};
/// What a page may ask for.
constexpr int kMaxFramesPerSecond = 60;

std::uint32_t levelOf(const PictureSize& size) {
  const int picture = size.macroblocksAcross() * size.macroblocksDown();
  const auto* const found = std::ranges::find_if(kLevels, [&](const Level& level) {
    return picture <= level.picture && picture * kMaxFramesPerSecond <= level.second;
  });
  return found == kLevels.end() ? kLevels.back().number : found->number;
}

/// Annex E.
void writeUsability(BitWriter& out) {
  constexpr std::uint32_t kUnspecifiedFormat = 5;
  constexpr std::uint32_t kBt601 = 6;
  out.put(0, 2);  // aspect_ratio_info_present_flag, overscan_info_present_flag
  out.put(1, 1);  // video_signal_type_present_flag
  out.put(kUnspecifiedFormat, 3);
  out.put(1, 1);  // video_full_range_flag
  out.put(1, 1);  // colour_description_present_flag
  for (int i = 0; i < 3; ++i) out.put(kBt601, 8);
  out.put(0, 5);  // chroma location, timing, both HRDs, pic_struct
  out.put(1, 1);  // bitstream_restriction_flag
  out.put(1, 1);  // motion_vectors_over_pic_boundaries_flag
  out.putUnsigned(0);
  out.putUnsigned(0);
  out.putUnsigned(16);
  out.putUnsigned(16);
  out.putUnsigned(0);  // max_num_reorder_frames
  out.putUnsigned(1);  // max_dec_frame_buffering
}

}  // namespace

BitWriter sequenceParameters(const PictureSize& size) {
  BitWriter out;
  out.put(kBaseline, 8);
  out.put(0b11000000, 8);  // constraint_set0_flag and constraint_set1_flag
  out.put(levelOf(size), 8);
  out.putUnsigned(0);  // seq_parameter_set_id
  out.putUnsigned(kFrameNumberBits - 4);
  out.putUnsigned(2);  // pic_order_cnt_type: the order of decoding
  out.putUnsigned(1);  // max_num_ref_frames
  out.put(0, 1);       // gaps_in_frame_num_value_allowed_flag
  out.putUnsigned(static_cast<std::uint32_t>(size.macroblocksAcross() - 1));
  out.putUnsigned(static_cast<std::uint32_t>(size.macroblocksDown() - 1));
  out.put(1, 1);  // frame_mbs_only_flag
  out.put(1, 1);  // direct_8x8_inference_flag
  const int beyond = 16 * size.macroblocksAcross() - size.width;
  const int below = 16 * size.macroblocksDown() - size.height;
  out.put(beyond > 0 || below > 0 ? 1 : 0, 1);
  if (beyond > 0 || below > 0) {
    out.putUnsigned(0);
    out.putUnsigned(static_cast<std::uint32_t>(beyond / 2));
    out.putUnsigned(0);
    out.putUnsigned(static_cast<std::uint32_t>(below / 2));
  }
  out.put(1, 1);  // vui_parameters_present_flag
  writeUsability(out);
  out.finish();
  return out;
}

BitWriter pictureParameters() {
  BitWriter out;
  out.putUnsigned(0);  // pic_parameter_set_id
  out.putUnsigned(0);  // seq_parameter_set_id
  out.put(0, 2);       // entropy_coding_mode_flag: CAVLC; bottom_field_pic_order_in_frame_present_flag
  out.putUnsigned(0);  // num_slice_groups_minus1
  out.putUnsigned(0);  // num_ref_idx_l0_default_active_minus1
  out.putUnsigned(0);
  out.put(0, 3);  // weighted_pred_flag, weighted_bipred_idc
  out.putSigned(0);
  out.putSigned(0);
  out.putSigned(0);  // chroma_qp_index_offset
  out.put(0, 3);  // deblocking_filter_control_present_flag, constrained_intra_pred_flag, redundant_pic_cnt_present_flag
  out.finish();
  return out;
}

void writeHeader(const SliceHeader& header, BitWriter& out) {
  constexpr std::uint32_t kAllDependent = 5;
  constexpr std::uint32_t kAllIndependent = 7;
  out.putUnsigned(0);  // first_mb_in_slice
  out.putUnsigned(header.independent ? kAllIndependent : kAllDependent);
  out.putUnsigned(0);  // pic_parameter_set_id
  out.put(header.frameNumber, kFrameNumberBits);
  if (header.independent) {
    out.putUnsigned(header.independentId);
    out.put(0, 2);  // no_output_of_prior_pics_flag, long_term_reference_flag
  } else {
    // num_ref_idx_active_override_flag, ref_pic_list_modification_flag_l0, adaptive_ref_pic_marking_mode_flag
    out.put(0, 3);
  }
  out.putSigned(header.quantiser - kFirstQuantiser);
}

void appendUnit(UnitType type, std::span<const std::uint8_t> payload, std::vector<std::uint8_t>& out) {
  constexpr std::uint32_t kReferenced = 3;
  out.insert(out.end(), {0, 0, 0, 1, static_cast<std::uint8_t>(kReferenced << 5 | static_cast<std::uint32_t>(type))});
  int zeros = 0;
  for (const std::uint8_t byte : payload) {
    if (zeros == 2 && byte <= 3) {
      out.push_back(3);
      zeros = 0;
    }
    out.push_back(byte);
    zeros = byte == 0 ? zeros + 1 : 0;
  }
}

}  // namespace grove::stream::h264
