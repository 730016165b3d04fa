#include "stream/encode/deflate_encoder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>

#include "pipeline/clocks.h"
#include "pipeline/worker_pool.h"
#include "stream/encode/bit_stream.h"
#include "stream/encode/encode_stage.h"
#include "stream/encode/jpeg/jpeg_decoder.h"

namespace grove::stream {
namespace {

using Samples = std::vector<std::uint8_t>;

/// The planes of a picture; empty if it is damaged.
std::optional<Samples> planesOf(std::span<const std::uint8_t> picture, std::size_t samples) {
  Samples planes(samples);
  uLongf size = samples;
  if (uncompress(planes.data(), &size, picture.data(), picture.size()) != Z_OK || size != samples) return std::nullopt;
  std::uint8_t last = 0;
  for (std::uint8_t& sample : planes) sample = last = static_cast<std::uint8_t>(last + sample);
  return planes;
}

Samples encoded(const raster::YuvImage& picture, Quantiser quantiser) {
  Samples out;
  DeflateEncoder().encode(picture, {.quantiser = quantiser}, out);
  return out;
}

// Faults: an encoder whose finest pictures lose something; one that errs by more than the step that it was ordered.
TEST(DeflateEncoder, ErrorIsBoundedByItsQuantiser) {
  const TestPicture picture(64, 48);
  const QuantiserRange range = DeflateEncoder().range();
  for (const auto& [quantiser, most] : {std::pair(range.finest, 0), std::pair(range.coarsest, 15)}) {
    const auto planes = planesOf(encoded(picture.yuv(), quantiser), picture.yuv().bytes.size());
    ASSERT_TRUE(planes.has_value());
    int worst = 0;
    for (std::size_t i = 0; i < planes->size(); ++i)
      worst = std::max(worst, std::abs(picture.yuv().bytes[i] - (*planes)[i]));
    EXPECT_LE(worst, most);
  }
}

// Fault: a quantiser without effect, with which no line could be kept to.
TEST(DeflateEncoder, CoarserIsSmaller) {
  Samples planes(64 * 48 * 3 / 2);
  std::minstd_rand grain;
  for (std::uint8_t& sample : planes) sample = static_cast<std::uint8_t>(100 + grain() % 64);
  raster::YuvImage picture;
  picture.rect = {0, 0, 64, 48};
  picture.bytes = planes;
  const QuantiserRange range = DeflateEncoder().range();
  EXPECT_LT(encoded(picture, range.usual).size(), encoded(picture, range.finest).size());
  EXPECT_LT(encoded(picture, range.coarsest).size(), encoded(picture, range.usual).size());
}

// Fault: a decoder in JavaScript that reads other bytes than the encoder writes; both read this picture.
TEST(DeflateEncoder, DecodesInThePage) {
  std::ifstream file(GROVE_DEFLATE_PICTURE);
  const auto golden = nlohmann::json::parse(file);
  auto planes = golden.at("planes").get<Samples>();
  raster::YuvImage picture;
  picture.rect = {0, 0, golden.at("width"), golden.at("height")};
  picture.bytes = planes;
  const Samples bytes = encoded(picture, DeflateEncoder().range().finest);
  EXPECT_EQ(planesOf(bytes, planes.size()), planes);
  const auto hex = golden.at("bytes").get<std::string>();
  Samples known;
  for (std::size_t i = 0; i < hex.size(); i += 2) {
    known.push_back(static_cast<std::uint8_t>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  }
  EXPECT_EQ(planesOf(known, planes.size()), planes);
}

/// A picture on its way through the last stage of a visitor whose page offers these codecs.
std::shared_ptr<const EncodedFrame> throughTheStage(std::shared_ptr<const raster::YuvImage> picture,
                                                    std::vector<std::uint8_t> offer) {
  const EncoderRegistry encoders = encodersWithDeflate();
  const auto control = std::make_shared<StreamControl>(encoders, std::make_shared<Governor>([] { return 0.0; }),
                                                       PageLevel::kTimed, 30.0, picture->width(), picture->height());
  control->offer(std::move(offer));
  pipeline::Timeline timeline;
  pipeline::MemoryLedger memory;
  pipeline::WorkerPool workers(1);
  std::shared_ptr<const EncodedFrame> made;
  EncodeStage::Outputs outputs{.frame = [&](std::shared_ptr<const EncodedFrame> frame) { made = std::move(frame); }};
  const auto stage = std::make_shared<EncodeStage>(control, PageLevel::kTimed, std::vector<world::Vec3>{},
                                                   std::move(outputs), memory, workers, timeline);
  node::View view;
  view.time = pipeline::wallSeconds();
  stage->push({std::make_shared<const node::View>(view), std::move(picture)});
  workers.drain();
  return made;
}

// Faults: an encoder that is registered and never chosen; a picture that is not the one that was drawn; a page of
// before that gets pictures which it cannot read.
TEST(DeflateEncoder, IsChosenIfOffered) {
  const TestPicture picture(320, 180);
  const auto yuv = tests::yuvOf(picture.image);
  const auto sent = throughTheStage(yuv, {kCodecDeflate, kCodecJpeg});
  ASSERT_NE(sent, nullptr);
  EXPECT_EQ(sent->header.codec, kCodecDeflate);
  EXPECT_TRUE(sent->header.independent);
  const auto planes = planesOf(sent->message().subspan(pictureHeaderBytes(0)), picture.yuv().bytes.size());
  ASSERT_TRUE(planes.has_value());
  for (std::size_t i = 0; i < planes->size(); ++i) ASSERT_NEAR(picture.yuv().bytes[i], (*planes)[i], 15) << i;

  const auto other = throughTheStage(yuv, {kCodecJpeg});
  ASSERT_NE(other, nullptr);
  EXPECT_EQ(other->header.codec, kCodecJpeg);
  EXPECT_NE(JpegDecoder().decode(other->message().subspan(pictureHeaderBytes(0))), nullptr);
}

}  // namespace
}  // namespace grove::stream
