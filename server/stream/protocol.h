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

/// Close codes of PROTOCOL.md.
enum class CloseCode : std::uint16_t {
  kGoingAway = 1001,
  kProtocolError = 4000,
  kWrongVersion = 4001,
  kFull = 4002,
  kNoHello = 4003,
  kFlood = 4004,
  kNoAcknowledgement = 4005,
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

using ClientMessage = std::variant<Hello, world::Input, Ack, Resize, Refusal>;

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
inline constexpr std::size_t kFrameHeaderBytes = 20;

struct FrameHeader {
  std::uint8_t codec = kCodecJpeg;
  std::uint16_t width = 0;
  std::uint16_t height = 0;
  std::uint16_t visitors = 0;
  std::uint32_t frame = 0;
  std::uint32_t lastInput = 0;
  std::uint32_t serverMicroseconds = 0;
};

[[nodiscard]] std::vector<std::uint8_t> encode(const Welcome& welcome);
[[nodiscard]] std::vector<std::uint8_t> encode(const Waiting& waiting);
/// Writes the header of a Frame message; the picture follows it.
void encode(const FrameHeader& header, std::span<std::uint8_t, kFrameHeaderBytes> out);

/// The client's side, for `grove load` and tests.
[[nodiscard]] std::vector<std::uint8_t> encode(const Hello& hello);
[[nodiscard]] std::vector<std::uint8_t> encode(const world::Input& input);
[[nodiscard]] std::vector<std::uint8_t> encode(const Ack& ack);
[[nodiscard]] std::vector<std::uint8_t> encode(const Resize& resize);

struct FrameMessage {
  FrameHeader header;
  std::span<const std::uint8_t> picture;
};
using ServerMessage = std::variant<Welcome, Waiting, FrameMessage, Refusal>;
[[nodiscard]] ServerMessage parseServerMessage(std::span<const std::uint8_t> bytes);

}  // namespace grove::stream
