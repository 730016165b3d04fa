export class ProtocolError extends Error {
  name = 'ProtocolError';
}
