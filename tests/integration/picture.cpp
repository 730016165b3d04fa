#include "integration/picture.h"

#include <cmath>
#include <stdexcept>
#include <thread>
#include <utility>

#include "stream/encode/jpeg/jpeg_decoder.h"

namespace grove::integration {

double Picture::light(int x, int y) const {
  const std::uint32_t c =
      colour[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  return (c & 0xFFU) + (c >> 8U & 0xFFU) + (c >> 16U & 0xFFU);
}

double Picture::mean() const {
  double sum = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) sum += light(x, y);
  }
  return sum / width / height;
}

double Picture::middle(double from, double to) const {
  double sum = 0;
  double moment = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = static_cast<int>(from * width); x < static_cast<int>(to * width); ++x) {
      sum += light(x, y);
      moment += light(x, y) * x;
    }
  }
  return moment / sum / width;
}

Picture decode(const std::shared_ptr<const stream::EncodedFrame>& frame) {
  stream::JpegDecoder decoder;
  const auto* picture = decoder.decode(frame->message().subspan(stream::kFrameHeaderBytes));
  if (picture == nullptr) throw std::runtime_error("a frame is no picture");
  return {picture->width, picture->height, picture->colour};
}

double difference(const Picture& a, const Picture& b) {
  double sum = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) sum += std::abs(a.light(x, y) - b.light(x, y));
  }
  return sum / a.width / a.height;
}

Picture pictureAfter(stream::HeadlessSession& visitor, std::uint8_t keys, float yaw, float pitch) {
  const auto frame = visitor.frameShowing(visitor.control(keys, yaw, pitch), kPatience);
  if (frame == nullptr) throw std::runtime_error("no frame showed the input");
  return decode(frame);
}

Picture settledPicture(stream::HeadlessSession& visitor, std::uint32_t input, int looks) {
  auto frame = visitor.frameShowing(input, kPatience);
  Picture picture = decode(frame);
  int alike = 0;
  for (int i = 0; i < looks && alike < 3; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    frame = visitor.frameAfter(frame->header.frame, kPatience);
    Picture next = decode(frame);
    alike = difference(picture, next) == 0.0 ? alike + 1 : 0;
    picture = std::move(next);
  }
  return picture;
}

}  // namespace grove::integration
