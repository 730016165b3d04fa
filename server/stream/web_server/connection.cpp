#include "stream/web_server/connection.h"

#include <utility>

#include "base/log.h"
#include "pipeline/clocks.h"
#include "stream/protocol/printable.h"

namespace grove::stream {
namespace {

constexpr double kHelloSeconds = 10.0;
constexpr double kAcknowledgementSeconds = 25.0;
constexpr double kPingSeconds = 10.0;
constexpr double kAnswerSeconds = kAcknowledgementSeconds - kPingSeconds;
constexpr int kMaxPiecesPerSecond = 500;
/// Minimum time between two People messages.
constexpr double kPeopleSeconds = 1.0;

Refusal protocolError(std::string reason) { return {CloseCode::kProtocolError, std::move(reason)}; }

Ground groundOf(const world::Players& players) {
  Ground ground{.radius = players.radius(), .hills = players.hills(), .obstacles = players.obstacles()};
  if (ground.obstacles.size() > kMaxGroundObstacles) ground.obstacles.resize(kMaxGroundObstacles);
  return ground;
}

PageLevel levelOf(std::string_view subProtocol) {
  if (subProtocol == kSubProtocolWithNearness) return PageLevel::kMoving;
  if (subProtocol == kSubProtocolWithNames) return PageLevel::kNaming;
  if (subProtocol == kSubProtocolWithTimes) return PageLevel::kTimed;
  return subProtocol == kSubProtocolWithVideo ? PageLevel::kAdaptive : PageLevel::kBasic;
}

}  // namespace

Connection::Connection(Host& host, std::string peer, double now, std::function<void()> wake, Door door,
                       std::string_view subProtocol)
    : host_(host),
      peer_(std::move(peer)),
      opened_(now),
      outbox_(std::make_shared<Outbox>(std::move(wake))),
      door_(std::move(door)),
      page_(levelOf(subProtocol)),
      secondBegan_(now),
      heard_(now) {
  message_.reserve(kLargestClientMessage);
}

Connection::~Connection() { leave("the connection was dropped"); }

std::optional<Refusal> Connection::receive(const MessagePiece& piece, double now) {
  if (ended_) return std::nullopt;
  heard_ = now;
  pinged_.reset();
  if (auto why = takePiece(piece, now)) return refuse(std::move(*why));
  if (!piece.last) return std::nullopt;
  const ClientMessage message = parseClientMessage(message_);
  message_.clear();
  if (auto why = act(message)) return refuse(std::move(*why));
  return std::nullopt;
}

std::optional<Refusal> Connection::overdue(double now) {
  if (ended_) return std::nullopt;
  if (!session_) {
    if (now - opened_ < kHelloSeconds) return std::nullopt;
    return refuse({CloseCode::kNoHello, "no Hello within 10 seconds"});
  }
  watchPeople(now);
  if (auto why = session_->refusal()) return refuse(std::move(*why));
  if (isDead(now)) return refuse({CloseCode::kNoAcknowledgement, "no answer to a ping"});
  if (session_->secondsUnacknowledged(now) < kAcknowledgementSeconds) return std::nullopt;
  return refuse({CloseCode::kNoAcknowledgement, "no frame acknowledged for 25 seconds"});
}

bool Connection::isDead(double now) {
  if (pinged_) return now - *pinged_ >= kAnswerSeconds;
  if (now - heard_ < kPingSeconds) return false;
  pinged_ = heard_ = now;
  pingIsDue_ = true;
  return false;
}

void Connection::watchPeople(double now) {
  if (page_ < PageLevel::kNaming || now < peopleReportedAt_ + kPeopleSeconds) return;
  if (host_.players().changes() == peopleReported_ && host_.hasLostOthers() == othersReportedLost_) return;
  peopleReportedAt_ = now;
  peopleAreDue_ = true;
}

People Connection::people() {
  // Read before the list: a visitor who arrives in between is sent twice, rather than never.
  peopleReported_ = host_.players().changes();
  People people{.othersAreLost = host_.hasLostOthers(), .people = {}};
  othersReportedLost_ = people.othersAreLost;
  for (const world::Player& player : host_.players().all(pipeline::wallSeconds())) {
    people.people.push_back({node::shortIdOf(player.id, host_.options().process), player.colour, player.name});
  }
  return people;
}

std::vector<std::uint8_t> Connection::takeMessage() {
  if (!welcome_.empty()) return std::exchange(welcome_, {});
  if (!ground_.empty()) return std::exchange(ground_, {});
  if (std::exchange(peopleAreDue_, false)) return encode(people());
  if (const auto status = outbox_->takeStatus()) return encode(*status);
  if (const auto times = outbox_->takeTimes()) return encode(*times);
  if (auto captured = outbox_->takeCaptured()) return std::move(*captured);
  if (!hasRefiningToSend()) return {};
  const auto [number, refining] = host_.refining();
  const bool reportedNothing = std::exchange(refiningReported_, number) == 0;
  // A visitor who arrives when all is done has seen no coarser picture.
  return reportedNothing && refining.percent == 100 ? std::vector<std::uint8_t>{} : encode(refining);
}

void Connection::written(const EncodedFrame& frame, double now) {
  const double reached = std::exchange(reached_, std::nullopt).value_or(now);
  if (session_) session_->written(frame.header.frame, reached, now);
  reach(now);
}

void Connection::end(const Refusal& why) { leave(std::to_string(static_cast<int>(why.code)) + " " + why.reason); }

void Connection::leave(const std::string& why) {
  if (std::exchange(ended_, true)) return;
  welcome_.clear();
  ground_.clear();
  place_.reset();
  if (const auto session = std::exchange(session_, nullptr)) {
    session->close();
    door_.log.info(peer_ + " left: " + why);
  } else {
    door_.log.warning(peer_ + " left before becoming a visitor: " + why);
  }
}

std::optional<Refusal> Connection::refuse(Refusal why) {
  end(why);
  return why;
}

std::optional<Refusal> Connection::takePiece(const MessagePiece& piece, double now) {
  if (isFlood(now)) return Refusal{CloseCode::kFlood, "more than 500 messages in a second"};
  if (!piece.binary) return protocolError("a text message");
  if (piece.first) message_.clear();
  if (message_.size() + piece.bytes.size() > kLargestClientMessage) {
    return protocolError("a message of more than 256 bytes");
  }
  message_.insert(message_.end(), piece.bytes.begin(), piece.bytes.end());
  return std::nullopt;
}

std::optional<Refusal> Connection::act(const ClientMessage& message) {
  if (const auto* refusal = std::get_if<Refusal>(&message)) return *refusal;
  if (const auto* hello = std::get_if<Hello>(&message)) return greet(*hello);
  if (page_ != PageLevel::kBasic) {
    if (const auto* offer = std::get_if<Offer>(&message); offer != nullptr && !session_) {
      offer_ = *offer;
      return std::nullopt;
    }
    if (const auto* limits = std::get_if<Limits>(&message); limits != nullptr && !session_) {
      limits_ = *limits;
      return std::nullopt;
    }
  }
  if (!session_) return protocolError("the first message is not Hello");
  if (const auto* input = std::get_if<world::Input>(&message)) return session_->input(*input);
  if (const auto* resize = std::get_if<Resize>(&message)) return session_->resize(*resize);
  if (const auto* ack = std::get_if<Ack>(&message)) return session_->acknowledge(*ack);
  return actOnStream(message);
}

std::optional<Refusal> Connection::actOnStream(const ClientMessage& message) {
  const bool isTimed = std::holds_alternative<Painted>(message) || std::holds_alternative<Capture>(message);
  if (page_ == PageLevel::kBasic || (isTimed && page_ < PageLevel::kTimed)) {
    return protocolError("a message of a newer sub-protocol");
  }
  if (const auto* painted = std::get_if<Painted>(&message)) return session_->acknowledge(*painted);
  if (const auto* presented = std::get_if<Presented>(&message)) return session_->acknowledge(*presented);
  if (const auto* offer = std::get_if<Offer>(&message)) session_->offer(*offer);
  if (const auto* limits = std::get_if<Limits>(&message)) session_->limit(*limits);
  if (std::holds_alternative<Broken>(message)) session_->broken();
  if (const auto* capture = std::get_if<Capture>(&message)) session_->capture(*capture);
  return std::nullopt;
}

std::optional<Refusal> Connection::greet(const Hello& hello) {
  if (session_) return protocolError("a second Hello");
  place_ = door_.takePlace();
  if (!place_) return Refusal{CloseCode::kFull, "your address already has the maximum number of visitors"};
  // The sink may outlive this connection in a running stage; it must not keep the frame then.
  const auto send = [outbox = std::weak_ptr(outbox_)](std::shared_ptr<const EncodedFrame> frame) {
    if (const auto to = outbox.lock()) to->put(std::move(frame));
  };
  auto opened = host_.open(hello, send, terms());
  if (auto* refusal = std::get_if<Refusal>(&opened)) return std::move(*refusal);
  session_ = std::get<std::shared_ptr<Session>>(std::move(opened));
  const Welcome welcome = session_->welcome();
  welcome_ = encode(welcome);
  if (page_ >= PageLevel::kMoving) ground_ = encode(groundOf(host_.players()));
  door_.log.info(peer_ + " is visitor " + std::to_string(welcome.visitor) +
                 (hello.name.empty() ? "" : ", " + hello.name));
  return std::nullopt;
}

StreamTerms Connection::terms() {
  StreamTerms terms{.page = page_, .status = {}, .offer = std::move(offer_), .limits = limits_};
  if (page_ != PageLevel::kBasic) {
    terms.status = [outbox = std::weak_ptr(outbox_)](const Status& status) {
      if (const auto to = outbox.lock()) to->put(status);
    };
  }
  if (page_ >= PageLevel::kTimed) {
    terms.times = [outbox = std::weak_ptr(outbox_)](const Times& times) {
      if (const auto to = outbox.lock()) to->put(times);
    };
    terms.captured = [outbox = std::weak_ptr(outbox_)](std::vector<std::uint8_t> message) {
      if (const auto to = outbox.lock()) to->putCaptured(std::move(message));
    };
  }
  return terms;
}

bool Connection::isFlood(double now) {
  if (now - secondBegan_ >= 1.0) {
    secondBegan_ = now;
    piecesThisSecond_ = 0;
  }
  return ++piecesThisSecond_ > kMaxPiecesPerSecond;
}

}  // namespace grove::stream
