#pragma once

#include <gtest/gtest.h>

#include <span>
#include <tuple>
#include <vector>

#include "stream/load/load_visitor.h"
#include "yuv_pictures.h"

namespace grove::stream {

/// A visitor of `grove load` who has been welcomed, and the frames that he gets.
class LoadVisitorTest : public testing::Test {
 protected:
  LoadVisitorTest() : plan_(smallPlan()), visitor_(0, plan_, decoder_) {
    std::ignore = visitor_.nextMessage(0.0);
    visitor_.receive(encode(Welcome{}), 0.0);
  }
  static LoadPlan smallPlan() {
    LoadPlan plan;
    plan.width = 64;
    plan.height = 48;
    return plan;
  }
  static std::vector<std::uint8_t> frame(std::uint32_t number, std::uint32_t lastInput) {
    std::vector<std::uint32_t> pixels(std::size_t{64} * 48, 0xFF808080U);
    raster::Image image;
    image.rect = {0, 0, 64, 48};
    image.colour = pixels;
    std::vector<std::uint8_t> bytes(kFrameHeaderBytes);
    FrameHeader header;
    header.width = 64;
    header.height = 48;
    header.frame = number;
    header.lastInput = lastInput;
    encode(header, std::span(bytes).first<kFrameHeaderBytes>());
    JpegEncoder(80).encode(*tests::yuvOf(image), {}, bytes);
    return bytes;
  }
  void sendInput(double now) {
    visitor_.inputDue();
    const ClientMessage message = parseClientMessage(visitor_.nextMessage(now));
    EXPECT_TRUE(std::holds_alternative<world::Input>(message));
  }

  const LoadPlan plan_;
  JpegDecoder decoder_;
  LoadVisitor visitor_;
};

}  // namespace grove::stream
