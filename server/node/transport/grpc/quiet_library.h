#pragma once

namespace grove::node {

/// Keeps gRPC from writing to stderr in its own format: links report their states and errors.
void silenceLibrary();

/// The same, but logs failed TLS handshakes, one line per second at most: a listening process gets no other report of
/// them from the library.
void reportHandshakesOnly();

}  // namespace grove::node
