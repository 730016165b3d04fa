#pragma once

namespace grove::node {

/// Keeps gRPC from writing to stderr in its own format: links report their states and errors.
void silenceLibrary();

/// The same, but logs failed TLS handshakes, one line per second at most: the library reports them to a listening
/// process in no other way.
void reportHandshakesOnly();

}  // namespace grove::node
