#include "node/transport/grpc/node_channel.h"

#include <grpcpp/create_channel.h>
#include <grpcpp/support/channel_arguments.h>

#include "node/transport/grpc/link_limits.h"
#include "node/transport/grpc/quiet_library.h"
#include "node/transport/grpc/tls/link_credentials.h"

namespace grove::node {
namespace {

/// For a connection and its handshake: several round trips.
constexpr int kConnectMilliseconds = 3000;

}  // namespace

std::shared_ptr<grpc::Channel> channelTo(const std::string& address, const LinkTls& tls) {
  silenceLibrary();
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(static_cast<int>(kMaxMessageBytes));
  arguments.SetMaxSendMessageSize(static_cast<int>(kMaxMessageBytes));
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, kKeepAliveMilliseconds);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, kKeepAliveTimeoutMilliseconds);
  arguments.SetInt(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  // Despite its name, this is not a pause but the minimum time before an attempt is given up.
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, kConnectMilliseconds);
  // One connection per link, so that no link waits behind the pictures of another.
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  // Connects directly even if the environment names an HTTP proxy.
  arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);
  return grpc::CreateCustomChannel(address, channelCredentials(tls), arguments);
}

}  // namespace grove::node
