#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "stream/protocol/space.h"
#include "world/players.h"

/// The messages of PROTOCOL.md. Parsing never throws and never reads past the end.
namespace grove::stream {

inline constexpr std::uint8_t kProtocolVersion = 1;
inline constexpr std::size_t kLargestClientMessage = 256;

/// Sub-protocols of the websocket.
inline constexpr const char* kSubProtocol = "grove.v1";
/// For pages that understand Waiting.
inline constexpr const char* kSubProtocolWithWaiting = "grove.v1.1";
/// For pages that also choose a codec, adapt to their line and understand the messages below "since v1.2".
inline constexpr const char* kSubProtocolWithVideo = "grove.v1.2";
/// For pages that also report where a frame's time goes and understand the messages below "since v1.3".
inline constexpr const char* kSubProtocolWithTimes = "grove.v1.3";
/// For pages that also write names over the picture, make sounds and understand what is "since v1.4".
inline constexpr const char* kSubProtocolWithNames = "grove.v1.4";
/// For pages that also move pictures to where their visitor walks and understand what is "since v1.5".
inline constexpr const char* kSubProtocolWithNearness = "grove.v1.5";

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

/// Since v1.2: the codecs that the page can decode, the best first. Sent before Hello, and again when that changes.
struct Offer {
  std::vector<std::uint8_t> codecs;  ///< 1 to kMaxCodecs
};

/// Since v1.2: the visitor's limits; 0 is no limit.
struct Limits {
  bool hidden = false;    ///< the page is hidden: no pictures are sent
  bool border = false;    ///< pictures may be larger than the window, for late look
  bool nearness = false;  ///< since v1.5: pictures come with a Space, for late walk
  std::uint8_t framesPerSecond = 0;
  std::uint32_t kilobitsPerSecond = 0;
  std::uint16_t lines = 0;  ///< height of the picture, pixels
};

/// Since v1.2: this frame cannot be decoded, nor can any that depends on it.
struct Broken {
  std::uint32_t frame = 0;
};

/// Since v1.2: an Ack with the time at which the frame arrived.
struct Presented {
  std::uint32_t frame = 0;
  std::uint16_t heldTenthsOfMilliseconds = 0;  ///< from arrival to this message; saturates
  std::uint32_t arrivedMicroseconds = 0;       ///< by the page's clock, modulo 2^32
};

/// Since v1.3: a Presented with the time that the browser spent on the frame.
struct Painted : Presented {
  std::uint16_t decodeTenthsOfMilliseconds = 0;  ///< from arrival until the image came out of the decoder
  std::uint16_t paintTenthsOfMilliseconds = 0;   ///< for drawing; 0 if it was skipped
};

/// Since v1.3: requests one complete picture of the wanted size, in the best JPEG quality.
struct Capture {
  std::uint32_t number = 0;  ///< repeated in CapturedHeader
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

/// The visitor's world is not ready yet: it is private, or the server prepares the shared one.
struct Waiting {
  std::uint16_t place = 1;   ///< in the queue; 1: the world is being made
  std::uint8_t percent = 0;  ///< of the step, 0 to 100
  std::string step;          ///< name of the current step; cut to 64 bytes, empty before the first
};

inline constexpr std::uint8_t kCodecJpeg = 1;
inline constexpr std::uint8_t kCodecH264 = 2;
inline constexpr std::uint8_t kCodecJpegPatches = 3;
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

/// Since v1.4: where another visitor's name belongs in a picture. People has the names.
struct Label {
  std::uint32_t visitor = 0;
  std::uint16_t x = 0;  ///< middle of the name in the picture's width, 0 left, 65535 right
  std::uint16_t y = 0;  ///< lower edge of the name in the picture's height, 0 top, 65535 bottom
  std::uint8_t opacity = 255;

  friend bool operator==(const Label&, const Label&) = default;
};
inline constexpr std::size_t kMaxLabels = 24;
inline constexpr std::size_t kLabelBytes = 10;

/// Header of a Picture, which replaces Frame since v1.2.
struct PictureHeader : FrameHeader {
  bool independent = true;  ///< can be decoded without earlier ones
  std::uint8_t border = 0;  ///< on each side, percent of half the window's width and height
  float yaw = 0.0F;         ///< radians; where the camera looked
  float pitch = 0.0F;
  float tanHalfX = 1.0F;  ///< of the picture including its border
  float tanHalfY = 1.0F;
  std::uint8_t fire = 0;           ///< since v1.4: nearness of the nearest fire, 0 inaudible to 255 beside it
  std::vector<Label> labels = {};  ///< since v1.4: nearest first, at most kMaxLabels
  std::optional<Space> space = std::nullopt;  ///< since v1.5
};
[[nodiscard]] constexpr std::size_t pictureHeaderBytes(std::size_t labels) {
  return kPictureHeaderBytes + labels * kLabelBytes;
}
[[nodiscard]] inline std::size_t pictureHeaderBytes(const PictureHeader& header) {
  return pictureHeaderBytes(header.labels.size()) + (header.space ? spaceBytes(*header.space) : 0);
}

/// What limits the stream's quality.
enum class LimitedBy : std::uint8_t {
  kNothing = 0,
  kLine = 1,
  kMachine = 2,  ///< the server
  kVisitor = 3,  ///< the visitor's own limits
  kBrowser = 4,  ///< since v1.3
};

/// Since v1.2: state of the stream, sent at each change, and twice a second while no picture is sent.
struct Status {
  LimitedBy limitedBy = LimitedBy::kNothing;
  std::uint8_t framesPerSecond = 0;  ///< target
  std::uint8_t quality = 0;          ///< of the newest picture, percent of the best
  std::uint16_t width = 0;           ///< of the pictures
  std::uint16_t height = 0;
  std::uint16_t roundTripMilliseconds = 0;  ///< of the idle line
  std::uint16_t visitors = 0;               ///< in the world
  std::uint32_t kilobitsPerSecond = 0;      ///< estimated rate of the line; 0: not known yet
  std::uint32_t lastInput = 0;              ///< newest input that the picture on the screen shows
};

/// Since v1.2: the world is shown while it is being refined.
struct Refining {
  static constexpr std::uint16_t kUnknownSeconds = 0xFFFF;
  std::uint8_t percent = 0;                     ///< 100: done
  std::uint16_t secondsLeft = kUnknownSeconds;  ///< estimate
  std::string step;                             ///< what is being made; cut to 64 bytes
};

/// Since v1.3: where frames spend their time before they reach the page, medians of the last second; sent once a second
/// while pictures are sent.
struct Times {
  std::uint16_t queuedTenthsOfMilliseconds = 0;   ///< from due to the begin of work on a worker
  std::uint16_t drawnTenthsOfMilliseconds = 0;    ///< from reading the camera to the finished picture
  std::uint16_t encodedTenthsOfMilliseconds = 0;  ///< from there to the encoded picture
  std::uint16_t socketTenthsOfMilliseconds = 0;   ///< from there until the socket has taken all of it
  std::uint16_t lineTenthsOfMilliseconds = 0;     ///< from there to the page, if the clocks allow an estimate
};

struct Person {
  std::uint32_t visitor = 0;
  std::uint32_t colour = 0;  ///< of the lantern, 0x00BBGGRR
  std::string name;          ///< cut to 64 bytes

  friend bool operator==(const Person&, const Person&) = default;
};

/// Since v1.4: the visitors in the world; sent after Welcome and at each change, at most once a second.
struct People {
  bool othersAreLost = false;  ///< visitors of other servers with this world are unreachable
  std::vector<Person> people;
};

/// Since v1.5: what decides where visitors walk, see world::Players; sent once, after Welcome.
struct Ground {
  float radius = 0.0F;  ///< metres around the origin within which visitors stay
  std::vector<world::Hill> hills;
  std::vector<world::Obstacle> obstacles;  ///< at most kMaxGroundObstacles
};
inline constexpr std::size_t kMaxGroundObstacles = 4096;

/// Since v1.3: header of the response to Capture; the picture follows it.
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
[[nodiscard]] std::vector<std::uint8_t> encode(const Ground& ground);
/// Writes the header of a Frame message; the picture follows it.
void encode(const FrameHeader& header, std::span<std::uint8_t, kFrameHeaderBytes> out);
/// Writes the header of a Picture message of pictureHeaderBytes(); the picture follows it.
void encode(const PictureHeader& header, std::span<std::uint8_t> out);
/// Writes the header of a Captured message; the picture follows it.
void encode(const CapturedHeader& header, std::span<std::uint8_t, kCapturedHeaderBytes> out);

/// Client messages, for `grove load` and tests.
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
                                   Times, People, Ground, Refusal>;
[[nodiscard]] ServerMessage parseServerMessage(std::span<const std::uint8_t> bytes);

}  // namespace grove::stream
