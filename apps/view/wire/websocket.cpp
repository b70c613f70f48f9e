#include "apps/view/wire/websocket.h"

#include <algorithm>
#include <array>
#include <bit>

#include "apps/view/wire/base64.h"
#include "text/utf8.h"

namespace hookpoint::view {
namespace {

/// FIPS 180-4, section 6.1. The handshake asks for this hash; nothing is kept secret with it.
std::string sha1(std::string_view text) {
  std::string padded(text);
  padded += '\x80';
  padded.resize((padded.size() + 8 + 63) / 64 * 64 - 8, '\0');
  const std::uint64_t bits = 8 * text.size();
  for (int shift = 56; shift >= 0; shift -= 8) padded += static_cast<char>(bits >> shift);

  std::array<std::uint32_t, 5> hash{0x67452301, 0xefcdab89, 0x98badcfe, 0x10325476, 0xc3d2e1f0};
  for (std::size_t block = 0; block < padded.size(); block += 64) {
    std::array<std::uint32_t, 80> w{};
    for (std::size_t t = 0; t < 64; ++t)
      w[t / 4] = w[t / 4] << 8 | static_cast<unsigned char>(padded[block + t]);
    for (std::size_t t = 16; t < 80; ++t)
      w[t] = std::rotl(w[t - 3] ^ w[t - 8] ^ w[t - 14] ^ w[t - 16], 1);
    auto [a, b, c, d, e] = hash;
    for (std::size_t t = 0; t < 80; ++t) {
      const std::uint32_t mixed = t < 20   ? ((b & c) ^ (~b & d)) + 0x5a827999
                                  : t < 40 ? (b ^ c ^ d) + 0x6ed9eba1
                                  : t < 60 ? ((b & c) ^ (b & d) ^ (c & d)) + 0x8f1bbcdc
                                           : (b ^ c ^ d) + 0xca62c1d6;
      const std::uint32_t next = std::rotl(a, 5) + mixed + e + w[t];
      e = d;
      d = c;
      c = std::rotl(b, 30);
      b = a;
      a = next;
    }
    hash = {hash[0] + a, hash[1] + b, hash[2] + c, hash[3] + d, hash[4] + e};
  }
  std::string digest;
  for (std::size_t i = 0; i < 20; ++i)
    digest += static_cast<char>(hash[i / 4] >> (24 - 8 * (i % 4)) & 0xffU);
  return digest;
}

constexpr std::size_t longest_control = 125;  // section 5.5

/// How many bytes a frame's header has, from its first two: with the mask that a client must use.
std::size_t header_size(unsigned char second) {
  const unsigned length = second & 0x7fU;
  return 2U + (length == 126 ? 2U : length == 127 ? 8U : 0U) + 4U;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const bool ascii = static_cast<unsigned char>(text[0]) < 0x80;
    const std::size_t length = ascii ? 1 : text::first_character(text).length;
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

/// Section 7.4: what may stand in a close frame.
bool is_close_payload(std::string_view payload) {
  if (payload.empty()) return true;
  if (payload.size() == 1) return false;
  const unsigned code =
      static_cast<unsigned char>(payload[0]) << 8U | static_cast<unsigned char>(payload[1]);
  const bool known = (code >= 1000 && code <= 1003) || (code >= 1007 && code <= 1014) ||
                     (code >= 3000 && code <= 4999);
  return known && is_utf8(payload.substr(2));
}

}  // namespace

std::string websocket_accept(std::string_view key) {
  return to_base64(sha1(std::string(key) + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11"));
}

bool is_websocket_key(std::string_view key) {
  return key.size() == 24 && key.ends_with("==") &&
         key.substr(0, 22).find_first_not_of(base64_alphabet) == std::string_view::npos;
}

std::string frame_header(Opcode opcode, std::uint64_t size) {
  std::string header;
  header += static_cast<char>(0x80U | static_cast<unsigned>(opcode));
  int bytes = 0;
  if (size < 126) {
    header += static_cast<char>(size);
  } else if (size < 0x10000) {
    header += '\x7e';
    bytes = 2;
  } else {
    header += '\x7f';
    bytes = 8;
  }
  for (int i = bytes - 1; i >= 0; --i) header += static_cast<char>(size >> (8 * i));
  return header;
}

std::string close_payload(CloseCode code) {
  const auto number = static_cast<unsigned>(code);
  return {static_cast<char>(number >> 8), static_cast<char>(number)};
}

std::optional<MessageReader::Message> MessageReader::next(std::string_view& bytes) {
  while (!violated_) {
    if (!in_payload_) {
      const std::size_t wanted =
          header_.size() < 2 ? 2 : header_size(static_cast<unsigned char>(header_[1]));
      const std::size_t taken = std::min(wanted - header_.size(), bytes.size());
      header_ += bytes.substr(0, taken);
      bytes.remove_prefix(taken);
      if (header_.size() < wanted) return std::nullopt;
      // A client that does not mask is told so at once: no mask will follow.
      if (wanted == 2 && (static_cast<unsigned char>(header_[1]) & 0x80U) == 0) return violation();
      if (wanted == 2) continue;
      if (auto message = begin_frame()) return message;
    }
    const auto taken = static_cast<std::size_t>(std::min<std::uint64_t>(remaining_, bytes.size()));
    const bool control = opcode_ >= Opcode::close;
    if (control || !skipping_) {
      std::string& payload = control ? control_ : payload_;
      const std::size_t begin = payload.size();
      const char* mask = header_.data() + header_.size() - 4;
      payload += bytes.substr(0, taken);
      for (std::size_t i = 0; i < taken; ++i)
        payload[begin + i] = static_cast<char>(payload[begin + i] ^ mask[(masked_ + i) % 4]);
    }
    bytes.remove_prefix(taken);
    masked_ += taken;
    remaining_ -= taken;
    if (remaining_ > 0) return std::nullopt;
    in_payload_ = false;
    header_.clear();
    if (auto message = end_frame()) return message;
    if (bytes.empty()) return std::nullopt;
  }
  bytes = {};
  return std::nullopt;
}

/// Section 5.2: what the header says, and whether it may.
std::optional<MessageReader::Message> MessageReader::begin_frame() {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(header_[i]); };
  last_ = (byte(0) & 0x80U) != 0;
  opcode_ = static_cast<Opcode>(byte(0) & 0x0fU);
  remaining_ = byte(1) & 0x7fU;
  masked_ = 0;
  in_payload_ = true;
  const bool reserved = (byte(0) & 0x70U) != 0;
  if (remaining_ >= 126) {
    const std::size_t end = header_.size() - 4;
    const std::uint64_t least = remaining_ == 126 ? 126 : 0x10000;
    remaining_ = 0;
    for (std::size_t i = 2; i < end; ++i) remaining_ = remaining_ << 8 | byte(i);
    if (remaining_ < least || remaining_ >> 63 != 0) return violation();
  }
  if (reserved) return violation();
  switch (opcode_) {
    case Opcode::close:
    case Opcode::ping:
    case Opcode::pong:
      control_.clear();
      if (!last_ || remaining_ > longest_control) return violation();
      return std::nullopt;
    case Opcode::text:
    case Opcode::binary:
      if (message_) return violation();
      message_ = opcode_;
      payload_.clear();
      skipping_ = false;
      break;
    case Opcode::continuation:
      if (!message_) return violation();
      break;
    default:
      return violation();
  }
  if (!skipping_ && remaining_ > bound_ - payload_.size()) {
    skipping_ = true;
    payload_ = std::string();
    return Message{Kind::oversized, ""};
  }
  return std::nullopt;
}

std::optional<MessageReader::Message> MessageReader::end_frame() {
  switch (opcode_) {
    case Opcode::ping:
      return Message{Kind::ping, std::move(control_)};
    case Opcode::pong:
      return Message{Kind::pong, std::move(control_)};
    case Opcode::close:
      if (!is_close_payload(control_)) return violation();
      violated_ = true;  // nothing is read behind a close frame
      return Message{Kind::close, std::move(control_)};
    default:
      break;
  }
  if (!last_) return std::nullopt;
  const Opcode kind = *message_;
  message_.reset();
  if (skipping_) return std::nullopt;
  if (kind == Opcode::binary) return Message{Kind::binary, std::move(payload_)};
  return Message{is_utf8(payload_) ? Kind::text : Kind::not_utf8, std::move(payload_)};
}

std::optional<MessageReader::Message> MessageReader::violation() {
  violated_ = true;
  return Message{Kind::violation, ""};
}

}  // namespace hookpoint::view
