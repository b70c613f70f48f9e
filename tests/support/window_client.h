// A browser's end of the window's line (docs/view_protocol.md), by a plain socket: RFC 6455 as far
// as a client of text messages needs it.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace hookpoint::testing {

class WindowClient {
 public:
  /// `url`: what the program printed, http://127.0.0.1:PORT/?token=TOKEN.
  explicit WindowClient(const std::string& url) : file_(socket(AF_INET, SOCK_STREAM, 0)) {
    const std::string start = "http://127.0.0.1:";
    const std::size_t slash = url.find('/', start.size());
    if (!url.starts_with(start) || slash == std::string::npos) return;
    const std::string port = url.substr(start.size(), slash - start.size());
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(std::stoi(port)));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (connect(file_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) return;
    send_bytes("GET /socket" + url.substr(slash + 1) + " HTTP/1.1\r\nHost: 127.0.0.1:" + port +
               "\r\nOrigin: http://127.0.0.1:" + port +
               "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
               "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n");
    while (read_.find("\r\n\r\n") == std::string::npos && read_more()) {
    }
    connected_ = read_.starts_with("HTTP/1.1 101");
    read_.erase(0, read_.find("\r\n\r\n") + 4);
  }
  ~WindowClient() { close(file_); }
  WindowClient(const WindowClient&) = delete;
  WindowClient& operator=(const WindowClient&) = delete;

  bool connected() const { return connected_; }

  /// One text message, masked with zeros: its bytes are as they are.
  void say(std::string_view text) {
    std::string frame = "\x81";
    if (text.size() < 126) {
      frame += static_cast<char>(0x80 | text.size());
    } else {
      frame += static_cast<char>(0x80 | 126);
      frame += static_cast<char>(text.size() >> 8);
      frame += static_cast<char>(text.size() & 0xff);
    }
    send_bytes(frame + std::string(4, '\0') + std::string(text));
  }

  /// The next text message; nothing when the line ends, or after half a minute of silence.
  std::optional<std::string> hear() {
    while (true) {
      const auto header = take(2);
      if (!header) return std::nullopt;
      const int opcode = (*header)[0] & 0x0f;
      std::uint64_t size = static_cast<unsigned char>((*header)[1]);
      if (size >= 126) {
        const auto bytes = take(size == 126 ? 2 : 8);
        if (!bytes) return std::nullopt;
        size = 0;
        for (const char byte : *bytes) size = size << 8 | static_cast<unsigned char>(byte);
      }
      auto payload = take(size);
      if (!payload || opcode == 8) return std::nullopt;
      if (opcode == 1) return payload;
    }
  }

 private:
  void send_bytes(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t count = send(file_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (count <= 0) return;
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
  }
  bool read_more() {
    pollfd ready{file_, POLLIN, 0};
    if (poll(&ready, 1, 30'000) != 1) return false;
    char buffer[65536];
    const ssize_t count = recv(file_, buffer, sizeof buffer, 0);
    if (count <= 0) return false;
    read_.append(buffer, static_cast<std::size_t>(count));
    return true;
  }
  std::optional<std::string> take(std::uint64_t count) {
    while (read_.size() < count)
      if (!read_more()) return std::nullopt;
    std::string bytes = read_.substr(0, count);
    read_.erase(0, count);
    return bytes;
  }

  int file_;
  bool connected_ = false;
  std::string read_;
};

}  // namespace hookpoint::testing
