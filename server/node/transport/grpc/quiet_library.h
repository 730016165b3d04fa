#pragma once

namespace grove::node {

/// Keeps gRPC from writing to stderr in a form of its own: what it has to say is in the states and errors of the links.
void silenceLibrary();

/// The same, but TLS handshakes that fail are told of in a line, once a second at most: to a process that listens, the
/// library tells them in no other way.
void reportHandshakesOnly();

}  // namespace grove::node
