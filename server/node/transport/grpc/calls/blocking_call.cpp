#include "node/transport/grpc/calls/blocking_call.h"

#include <grpcpp/client_context.h>
#include <grpcpp/generic/generic_stub.h>

#include <memory>

#include "node/transport/grpc/byte_message.h"
#include "node/transport/grpc/library_hold.h"
#include "node/transport/grpc/node_channel.h"
#include "node/transport/grpc/tls/link_credentials.h"

namespace grove::node {
namespace {

/// A queue for one operation at a time; each ends by the call's deadline.
class Operations {
 public:
  Operations() = default;
  ~Operations() { queue_.Shutdown(); }
  Operations(const Operations&) = delete;
  Operations& operator=(const Operations&) = delete;

  [[nodiscard]] grpc::CompletionQueue* queue() noexcept { return &queue_; }
  /// Waits for the operation in progress; returns whether it succeeded.
  [[nodiscard]] bool wait() {
    void* tag = nullptr;
    bool ok = false;
    return queue_.Next(&tag, &ok) && ok;
  }

 private:
  grpc::CompletionQueue queue_;
};

}  // namespace

CallEnd ask(const BlockingCall& call, const std::string& question, const LinkTls& tls) {
  const LibraryHold library;
  CallEnd end;
  Operations operations;
  grpc::GenericStub stub(channelTo(call.address, tls));
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + call.deadline);
  const auto stream = stub.PrepareCall(&context, call.method, operations.queue());
  grpc::ByteBuffer answer;
  stream->StartCall(nullptr);
  bool ok = operations.wait();
  if (ok) {
    // Before anything is sent: the node's certificate arrives with its metadata.
    stream->ReadInitialMetadata(nullptr);
    ok = end.wasOpen = operations.wait();
  }
  if (ok) end.complaint = complaintOfNode(*context.auth_context(), tls, call.address);
  if (end.complaint) {
    context.TryCancel();
  } else if (ok) {
    stream->WriteLast(messageOf(question), grpc::WriteOptions(), nullptr);
    ok = operations.wait();
    stream->Read(&answer, nullptr);
    ok = operations.wait() && ok;
  }
  stream->Finish(&end.status, nullptr);
  (void)operations.wait();
  if (end.status.ok() && ok) end.answer = bytesOf(answer);
  return end;
}

}  // namespace grove::node
