#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "node/transport/grpc/byte_message.h"
#include "node/transport/grpc/link_limits.h"
#include "node/transport/grpc/links_fixture.h"
#include "node/transport/grpc/packet_frame.h"

namespace grove::node {
namespace {

using testing::FrontendSide;
using testing::NodeProcess;
using tests::eventually;

/// A client that says what it likes, one call at a time.
class RawClient {
 public:
  explicit RawClient(const std::string& address)
      : stub_(grpc::CreateChannel(address, grpc::InsecureChannelCredentials())) {}

  /// Writes all of it, hangs up when `done` is so, and waits for the call's end, as the server sees it.
  grpc::Status stream(
      const std::string& method, const std::vector<grpc::ByteBuffer>& messages,
      const std::function<bool()>& done = [] { return true; }) {
    grpc::ClientContext context;
    grpc::CompletionQueue queue;
    const auto call = stub_.PrepareCall(&context, method, &queue);
    const auto wait = [&] {
      void* tag = nullptr;
      bool ok = false;
      queue.Next(&tag, &ok);
      return ok;
    };
    call->StartCall(nullptr);
    wait();
    for (const grpc::ByteBuffer& message : messages) {
      call->Write(message, nullptr);
      if (!wait()) break;
    }
    EXPECT_TRUE(eventually(done));
    call->WritesDone(nullptr);
    wait();
    // The status comes after all that was said.
    grpc::ByteBuffer said;
    do {
      call->Read(&said, nullptr);
    } while (wait());
    grpc::Status status;
    call->Finish(&status, nullptr);
    wait();
    return status;
  }

  std::string unary(const std::string& method) {
    grpc::ClientContext context;
    grpc::CompletionQueue queue;
    const grpc::ByteBuffer nothing = messageOf("");
    const auto call = stub_.PrepareUnaryCall(&context, method, nothing, &queue);
    grpc::ByteBuffer answer;
    grpc::Status status;
    call->StartCall();
    call->Finish(&answer, &status, nullptr);
    void* tag = nullptr;
    bool ok = false;
    queue.Next(&tag, &ok);
    return status.ok() ? bytesOf(answer) : status.error_message();
  }

 private:
  grpc::GenericStub stub_;
};

class RawCalls : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(side.isWelcomed()); }
  void TearDown() override {
    const std::size_t before = node.end()->count();
    EXPECT_EQ(side.send(Quality{1}), pipeline::PushResult::kAccepted);
    EXPECT_TRUE(eventually([&] { return node.end()->count() == before + 1; })) << "the neighbour's link stands";
  }
  std::int64_t refused() { return node.timeline.counters()["refused messages"]; }

  NodeProcess node;
  FrontendSide side{node.address()};
  RawClient client{node.address()};
};

TEST_F(RawCalls, AnUnknownMethodIsRefused) {
  EXPECT_EQ(client.stream("/grove.node.v1.Node/Other", {}).error_code(), grpc::StatusCode::UNIMPLEMENTED);
}

TEST_F(RawCalls, HealthServiceReportsServing) {
  EXPECT_EQ(client.unary("/grpc.health.v1.Health/Check"), "\x08\x01") << "status = SERVING";
}

TEST_F(RawCalls, OversizedMessageEndsOnlyItsStream) {
  const grpc::ByteBuffer giant = frameOf({std::string(kMaxMessageBytes + 1, 'x'), nullptr});
  const grpc::Status status = client.stream(kLinkMethod, {giant});
  EXPECT_TRUE(eventually([&] { return node.end(1) == nullptr; }));
  EXPECT_EQ(refused(), 0) << "it did not even arrive";
}

TEST_F(RawCalls, MalformedPacketCostsOnlyItself) {
  std::vector<grpc::ByteBuffer> messages;
  using namespace std::string_literals;
  for (const std::string& bytes : {""s, "\1"s, "\1\0\0\0"s, "\2\0\0\0\0x"s, "\0\0\0\0\2"s, "\1\0\0\0\0xy"s,
                                   "\xFF\xFF\xFF\xFF\0x"s, "\1\0\0\0\0x"s}) {
    messages.push_back(messageOf(bytes));
  }
  messages.push_back(frameOf(encode(ToBackend(examples::hello()))));
  const auto isHeard = [&] { return node.end(1) && node.end(1)->count() == 1; };
  EXPECT_TRUE(client.stream(kLinkMethod, messages, isHeard).ok());
  EXPECT_EQ(refused(), 8);
}

TEST_F(RawCalls, LinksAreLimited) {
  std::vector<std::unique_ptr<FrontendSide>> sides;
  for (int i = 1; i < GrpcServer::kMaxLinks; ++i) {
    sides.push_back(std::make_unique<FrontendSide>(node.address()));
    ASSERT_TRUE(sides.back()->link().waitUntilOpen(std::chrono::seconds(30)));
  }
  EXPECT_EQ(client.stream(kLinkMethod, {}).error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  sides.pop_back();
  EXPECT_TRUE(eventually([&] { return client.stream(kLinkMethod, {}).ok(); })) << "a place is free again";
}

TEST(PacketFrames, RoundTrip) {
  for (const Packet& packet :
       {Packet{"", nullptr}, Packet{"header", nullptr}, Packet{"header", std::make_shared<const PackedBytes>()},
        Packet{"", std::make_shared<const PackedBytes>(3, std::byte{9})}, Packet{"header", examples::bulk()}}) {
    const std::optional<Packet> read = packetOf(frameOf(packet));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->header, packet.header);
    ASSERT_EQ(read->bulk == nullptr, packet.bulk == nullptr);
    if (packet.bulk) {
      EXPECT_EQ(*read->bulk, *packet.bulk);
    }
  }
}

TEST(PacketFrames, ReferenceTheBulkWithoutCopy) {
  auto bulk = std::make_shared<const PackedBytes>(100'000);
  std::vector<grpc::Slice> slices;
  grpc::ByteBuffer frame = frameOf({"header", bulk});
  ASSERT_TRUE(frame.Dump(&slices).ok());
  ASSERT_EQ(slices.size(), 2U);
  EXPECT_EQ(static_cast<const void*>(slices[1].begin()), static_cast<const void*>(bulk->data()));
  slices.clear();
  frame.Clear();
  EXPECT_EQ(bulk.use_count(), 1);
}

}  // namespace
}  // namespace grove::node
