#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "world/players.h"

/// The messages of PROTOCOL.md. Parsing never throws and never reads past the end.
namespace grove::stream {

inline constexpr std::uint8_t kProtocolVersion = 1;
inline constexpr std::size_t kLargestClientMessage = 256;

/// Sub-protocols of the websocket.
inline constexpr const char* kSubProtocol = "grove.v1";
/// The same, of pages that know Waiting.
inline constexpr const char* kSubProtocolWithWaiting = "grove.v1.1";
/// The same, of pages that besides choose a codec, adapt to their line and know the messages below "since v1.2".
inline constexpr const char* kSubProtocolWithVideo = "grove.v1.2";
/// The same, of pages that besides report where a frame's time goes and know the messages below "since v1.3".
inline constexpr const char* kSubProtocolWithTimes = "grove.v1.3";
/// The same, of pages that besides write names over the picture, make sounds and know what is "since v1.4".
inline constexpr const char* kSubProtocolWithNames = "grove.v1.4";

/// Close codes of PROTOCOL.md.
enum class CloseCode : std::uint16_t {
  kGoingAway = 1001,
  kProtocolError = 4000,
  kWrongVersion = 4001,
  kFull = 4002,
  kNoHello = 4003,
  kFlood = 4004,
  kNoAcknowledgement = 4005,
  kHidden = 4006,
};

/// Why a connection is to be closed.
struct Refusal {
  CloseCode code = CloseCode::kProtocolError;
  std::string reason;  ///< at most 100 bytes, for the close frame and the log
};

struct Hello {
  std::string name;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

struct Ack {
  std::uint32_t frame = 0;
};

struct Resize {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

/// Since v1.2: the codecs that the page can decode, the best first. Before Hello, and again when that changes.
struct Offer {
  std::vector<std::uint8_t> codecs;  ///< 1 to kMaxCodecs
};

/// Since v1.2: what the visitor wants at most; 0 is no limit.
struct Limits {
  bool hidden = false;  ///< nobody looks: nothing is to be sent
  bool border = false;  ///< pictures may be larger than the window, for late look
  std::uint8_t framesPerSecond = 0;
  std::uint32_t kilobitsPerSecond = 0;
  std::uint16_t lines = 0;  ///< height of the picture, pixels
};

/// Since v1.2: this frame cannot be decoded, and none that depends on it.
struct Broken {
  std::uint32_t frame = 0;
};

/// Since v1.2: an Ack that says when the frame arrived.
struct Presented {
  std::uint32_t frame = 0;
  std::uint16_t heldTenthsOfMilliseconds = 0;  ///< from arrival to here; the largest: that or more
  std::uint32_t arrivedMicroseconds = 0;       ///< by the page's clock, modulo 2^32
};

/// Since v1.3: a Presented that reports what the browser spent on the frame.
struct Painted : Presented {
  std::uint16_t decodeTenthsOfMilliseconds = 0;  ///< from arrival until the image came out of the decoder
  std::uint16_t paintTenthsOfMilliseconds = 0;   ///< that drawing took; 0 if it was skipped
};

/// Since v1.3: asks for one whole picture of the wanted size, as fine as JPEG gets.
struct Capture {
  std::uint32_t number = 0;  ///< comes back with the answer
};

using ClientMessage =
    std::variant<Hello, world::Input, Ack, Resize, Offer, Limits, Broken, Presented, Painted, Capture, Refusal>;

[[nodiscard]] ClientMessage parseClientMessage(std::span<const std::uint8_t> bytes);

struct Welcome {
  std::uint16_t framesPerSecond = 30;
  std::uint32_t visitor = 0;
  std::uint32_t colour = 0;  ///< 0x00BBGGRR
  float yaw = 0.0F;
  float pitch = 0.0F;
  std::string world;
};

/// One's world is not ready; only where every visitor has his own.
struct Waiting {
  std::uint16_t place = 1;   ///< in line; 1: it is being made
  std::uint8_t percent = 0;  ///< of the step, 0 to 100
  std::string step;          ///< what is being made; cut to 64 bytes, empty if nothing is yet
};

inline constexpr std::uint8_t kCodecJpeg = 1;
inline constexpr std::uint8_t kCodecH264 = 2;
inline constexpr std::size_t kMaxCodecs = 8;
inline constexpr std::size_t kFrameHeaderBytes = 20;
inline constexpr std::size_t kPictureHeaderBytes = 40;

struct FrameHeader {
  std::uint8_t codec = kCodecJpeg;
  std::uint16_t width = 0;
  std::uint16_t height = 0;
  std::uint16_t visitors = 0;
  std::uint32_t frame = 0;
  std::uint32_t lastInput = 0;
  std::uint32_t serverMicroseconds = 0;
};

/// Since v1.4: where a visitor's name belongs in a picture. People has the name.
struct Label {
  std::uint32_t visitor = 0;
  std::uint16_t x = 0;  ///< of the picture's width, 0 left, 65535 right: the middle of the name
  std::uint16_t y = 0;  ///< of the picture's height, 0 top, 65535 bottom: the name's lower edge
  std::uint8_t opacity = 255;

  friend bool operator==(const Label&, const Label&) = default;
};
inline constexpr std::size_t kMaxLabels = 24;
inline constexpr std::size_t kLabelBytes = 10;

/// Of a Picture, which is a Frame since v1.2.
struct PictureHeader : FrameHeader {
  bool independent = true;  ///< can be decoded without those before it
  std::uint8_t border = 0;  ///< so many percent beyond the window on each side, of half its width and height
  float yaw = 0.0F;         ///< radians; where the camera looked
  float pitch = 0.0F;
  float tanHalfX = 1.0F;  ///< of the whole picture, border included
  float tanHalfY = 1.0F;
  std::uint8_t fire = 0;           ///< since v1.4: how near the nearest fire is, 0 out of hearing to 255 beside it
  std::vector<Label> labels = {};  ///< since v1.4: nearest first, at most kMaxLabels
};
[[nodiscard]] constexpr std::size_t pictureHeaderBytes(std::size_t labels) {
  return kPictureHeaderBytes + labels * kLabelBytes;
}

/// What keeps the stream from being all that the visitor could want.
enum class LimitedBy : std::uint8_t {
  kNothing = 0,
  kLine = 1,
  kMachine = 2,  ///< the server
  kVisitor = 3,  ///< the visitor's own limits
  kBrowser = 4,  ///< since v1.3
};

/// Since v1.2: how the stream stands, at each change and twice a second when no picture is sent.
struct Status {
  LimitedBy limitedBy = LimitedBy::kNothing;
  std::uint8_t framesPerSecond = 0;  ///< aimed at
  std::uint8_t quality = 0;          ///< of the newest picture, percent of the best
  std::uint16_t width = 0;           ///< of the pictures
  std::uint16_t height = 0;
  std::uint16_t roundTripMilliseconds = 0;  ///< of the idle line
  std::uint16_t visitors = 0;               ///< in the world
  std::uint32_t kilobitsPerSecond = 0;      ///< that the line is thought to carry; 0: not known yet
  std::uint32_t lastInput = 0;              ///< the newest that would not change the picture on the screen
};

/// Since v1.2: the world is shown, and gets better meanwhile.
struct Refining {
  static constexpr std::uint16_t kUnknownSeconds = 0xFFFF;
  std::uint8_t percent = 0;                     ///< 100: done
  std::uint16_t secondsLeft = kUnknownSeconds;  ///< about
  std::string step;                             ///< what is being made; cut to 64 bytes
};

/// Since v1.3: where a frame's time goes before the page has it, medians of the last second; once a second while
/// pictures are sent.
struct Times {
  std::uint16_t queuedTenthsOfMilliseconds = 0;   ///< a due frame waits for a worker
  std::uint16_t drawnTenthsOfMilliseconds = 0;    ///< from reading the camera to the finished picture
  std::uint16_t encodedTenthsOfMilliseconds = 0;  ///< from there to the encoded picture
  std::uint16_t socketTenthsOfMilliseconds = 0;   ///< from there until the socket has taken all of it
  std::uint16_t lineTenthsOfMilliseconds = 0;     ///< from there to the page, as far as the clocks allow to say
};

struct Person {
  std::uint32_t visitor = 0;
  std::uint32_t colour = 0;  ///< of the lantern, 0x00BBGGRR
  std::string name;          ///< cut to 64 bytes

  friend bool operator==(const Person&, const Person&) = default;
};

/// Since v1.4: who is here, after Welcome and at each change, once a second at most.
struct People {
  bool othersAreLost = false;  ///< visitors of other servers that show this world are out of reach
  std::vector<Person> people;
};

/// Since v1.3: the answer to Capture; the picture follows it.
struct CapturedHeader {
  std::uint8_t codec = kCodecJpeg;
  std::uint16_t width = 0;
  std::uint16_t height = 0;
  std::uint32_t number = 0;
};
inline constexpr std::size_t kCapturedHeaderBytes = 12;

[[nodiscard]] std::vector<std::uint8_t> encode(const Welcome& welcome);
[[nodiscard]] std::vector<std::uint8_t> encode(const Waiting& waiting);
[[nodiscard]] std::vector<std::uint8_t> encode(const Status& status);
[[nodiscard]] std::vector<std::uint8_t> encode(const Refining& refining);
[[nodiscard]] std::vector<std::uint8_t> encode(const Times& times);
[[nodiscard]] std::vector<std::uint8_t> encode(const People& people);
/// Writes the header of a Frame message; the picture follows it.
void encode(const FrameHeader& header, std::span<std::uint8_t, kFrameHeaderBytes> out);
/// Writes the header of a Picture message into pictureHeaderBytes(); the picture follows it.
void encode(const PictureHeader& header, std::span<std::uint8_t> out);
/// Writes the header of a Captured message; the picture follows it.
void encode(const CapturedHeader& header, std::span<std::uint8_t, kCapturedHeaderBytes> out);

/// The client's side, for `grove load` and tests.
[[nodiscard]] std::vector<std::uint8_t> encode(const Hello& hello);
[[nodiscard]] std::vector<std::uint8_t> encode(const world::Input& input);
[[nodiscard]] std::vector<std::uint8_t> encode(const Ack& ack);
[[nodiscard]] std::vector<std::uint8_t> encode(const Resize& resize);
[[nodiscard]] std::vector<std::uint8_t> encode(const Offer& offer);
[[nodiscard]] std::vector<std::uint8_t> encode(const Limits& limits);
[[nodiscard]] std::vector<std::uint8_t> encode(const Broken& broken);
[[nodiscard]] std::vector<std::uint8_t> encode(const Presented& presented);
[[nodiscard]] std::vector<std::uint8_t> encode(const Painted& painted);
[[nodiscard]] std::vector<std::uint8_t> encode(const Capture& capture);

struct FrameMessage {
  FrameHeader header;
  std::span<const std::uint8_t> picture;
};
struct PictureMessage {
  PictureHeader header;
  std::span<const std::uint8_t> picture;
};
struct CapturedMessage {
  CapturedHeader header;
  std::span<const std::uint8_t> picture;
};
using ServerMessage = std::variant<Welcome, Waiting, FrameMessage, PictureMessage, CapturedMessage, Status, Refining,
                                   Times, People, Refusal>;
[[nodiscard]] ServerMessage parseServerMessage(std::span<const std::uint8_t> bytes);

}  // namespace grove::stream
