#include <gmock/gmock.h>
#include <grpcpp/generic/async_generic_service.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "base/tls/certificates.h"
#include "node/transport/grpc/byte_message.h"
#include "node/transport/grpc/link_limits.h"
#include "node/transport/grpc/obstacle_fixture.h"

namespace grove::node {
namespace {

using testing::errorOf;
using ::testing::HasSubstr;
using testing::kScene;
using testing::TellingNode;

/// Says the same to whoever asks.
class Liar final : public grpc::CallbackGenericService {
 public:
  explicit Liar(std::string answer) : answer_(std::move(answer)) {
    grpc::ServerBuilder builder;
    builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port_);
    builder.RegisterCallbackGenericService(this);
    server_ = builder.BuildAndStart();
  }
  [[nodiscard]] std::string address() const { return "127.0.0.1:" + std::to_string(port_); }

 private:
  class Lie final : public grpc::ServerGenericBidiReactor {
   public:
    explicit Lie(const std::string& answer) : answer_(messageOf(answer)) {
      StartSendInitialMetadata();
      StartRead(&question_);
    }
    void OnReadDone(bool /*ok*/) override { StartWriteAndFinish(&answer_, grpc::WriteOptions(), grpc::Status::OK); }
    void OnDone() override { delete this; }

   private:
    grpc::ByteBuffer question_;
    const grpc::ByteBuffer answer_;
  };
  grpc::ServerGenericBidiReactor* CreateReactor(grpc::GenericCallbackServerContext* /*context*/) override {
    return new Lie(answer_);
  }

  const std::string answer_;
  int port_ = 0;
  std::unique_ptr<grpc::Server> server_;
};

TEST(UntrustedObstacles, MismatchedAnswerIsAnError) {
  for (const int edge : {16, 24}) {
    const CubeCells cells(static_cast<std::size_t>(edge) * edge * edge, 1);
    const Liar liar(encodeCells(cells));
    EXPECT_THAT(errorOf(RemoteObstacles(liar.address(), kScene, {})),
                HasSubstr(liar.address() + ": the node with the obstacles is broken: response with obstacles:"));
  }
  for (const std::string& bytes : {std::string(), std::string("lies"), std::string(kMaxHeaderBytes + 1, '\x0A')}) {
    const Liar liar(bytes);
    EXPECT_THAT(errorOf(RemoteObstacles(liar.address(), kScene, {})), HasSubstr("broken: response with obstacles:"));
  }
  const Liar giant(std::string(kMaxMessageBytes + 1, 'x'));
  EXPECT_THAT(errorOf(RemoteObstacles(giant.address(), kScene, {})), HasSubstr("larger"));
}

TEST(UntrustedObstacles, RequiresATrustedNode) {
  const TestFolder folder;
  const TlsFiles own{folder.file("own.pem"), folder.file("own.key"), "--tls"};
  const TlsFiles other{folder.file("other.pem"), folder.file("other.key"), "--tls"};
  writePair(own);
  writePair(other);
  const TellingNode node(0, readLinkTls(own, ""));
  const auto localhost = [](const TellingNode& at) { return "localhost:" + std::to_string(at.server.port()); };
  const auto trusting = [](const TlsFiles& files) { return readLinkTls({"", "", "--link-tls"}, files.certificate); };
  EXPECT_EQ(errorOf(RemoteObstacles(localhost(node), kScene, trusting(own))), "no error");
  const int answered = node.obstacles.answered;
  EXPECT_THAT(errorOf(RemoteObstacles(localhost(node), kScene, trusting(other))),
              HasSubstr("the node with the obstacles is not trusted: its certificate"));
  EXPECT_EQ(node.obstacles.answered, answered) << "it was asked nothing";
  EXPECT_THAT(errorOf(RemoteObstacles(localhost(node), kScene, {})), HasSubstr("does it require TLS?"));
  const TellingNode plain;
  EXPECT_THAT(errorOf(RemoteObstacles(localhost(plain), kScene, trusting(own))), HasSubstr("does not speak TLS"));
  const TellingNode wantsCertificates(0, readLinkTls(own, own.certificate));
  EXPECT_THAT(errorOf(RemoteObstacles(localhost(wantsCertificates), kScene, trusting(own))),
              HasSubstr("the node with the obstacles refuses: it shows no certificate"));
}

}  // namespace
}  // namespace grove::node
