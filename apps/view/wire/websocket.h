// The WebSocket protocol (RFC 6455) as a server reads and writes it: bytes in, messages out. No
// network and no library; permessage-deflate is not spoken.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace hookpoint::view {

/// What a server answers to a handshake's Sec-WebSocket-Key (section 4.2.2).
std::string websocket_accept(std::string_view key);

/// Whether a Sec-WebSocket-Key is 16 bytes in base64.
bool is_websocket_key(std::string_view key);

enum class Opcode : std::uint8_t {
  continuation = 0,
  text = 1,
  binary = 2,
  close = 8,
  ping = 9,
  pong = 10
};

/// Why a connection is closed (section 7.4.1).
enum class CloseCode : std::uint16_t { normal = 1000, going_away = 1001, protocol_error = 1002 };

/// What a server writes ahead of `size` bytes of payload: one frame, the last of its message,
/// unmasked.
std::string frame_header(Opcode opcode, std::uint64_t size);

/// The payload of a close frame.
std::string close_payload(CloseCode code);

/// Joins a client's frames to messages.
class MessageReader {
 public:
  enum class Kind {
    text,
    binary,
    oversized,  ///< reported once, when a message exceeds the bound; the rest of it is skipped
    not_utf8,   ///< a text that is none
    ping,
    pong,
    close,     ///< the client says goodbye
    violation  ///< of the protocol: the connection is to be closed, and nothing more can be read
  };
  struct Message {
    Kind kind;
    std::string payload;
  };

  /// Keeps at most `bound` bytes of a message, whatever its frames claim.
  explicit MessageReader(std::size_t bound) : bound_(bound) {}

  /// The next message in `bytes`, from whose front all that was read is removed; none until more
  /// bytes have come, when `bytes` is empty. To be called until then: it keeps what was read.
  std::optional<Message> next(std::string_view& bytes);

 private:
  std::optional<Message> begin_frame();
  std::optional<Message> end_frame();
  std::optional<Message> violation();

  const std::size_t bound_;
  std::string header_;             ///< of the frame that is being read, as far as it has come
  bool in_payload_ = false;        ///< the header is whole
  Opcode opcode_{};                ///< of this frame
  bool last_ = false;              ///< this frame ends its message
  std::uint64_t remaining_ = 0;    ///< bytes of this frame's payload still to come
  std::uint64_t masked_ = 0;       ///< bytes of it that have come
  std::optional<Opcode> message_;  ///< text or binary, while its frames are coming
  std::string payload_;            ///< of that message
  bool skipping_ = false;          ///< it was too long
  std::string control_;            ///< payload of a control frame, which may stand between them
  bool violated_ = false;
};

}  // namespace hookpoint::view
