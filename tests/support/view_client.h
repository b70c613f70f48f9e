// A browser's end of a window, without a browser: speaks docs/view_protocol.md by a plain socket
// (RFC 6455), so that tests see what the program tells.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "output/text/json_reader.h"

namespace hookpoint::testing {

class ViewClient {
 public:
  /// `url`: as the program prints it, "http://127.0.0.1:PORT/?token=T".
  explicit ViewClient(const std::string& url) : file_(socket(AF_INET, SOCK_STREAM, 0)) {
    const std::size_t host_begin = url.find("//") + 2, path = url.find('/', host_begin);
    const std::string host = url.substr(host_begin, path - host_begin);
    const std::string query = url.substr(url.find('?'));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port =
        htons(static_cast<std::uint16_t>(std::stoi(host.substr(host.find(':') + 1))));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(file_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0) << url;
    write("GET /socket" + query.substr(0, query.find_first_of("&\n")) +
          " HTTP/1.1\r\nHost: " + host +
          "\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
          "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
    std::string head;
    while (!head.ends_with("\r\n\r\n")) {
      const std::string letter = read(1);
      if (letter.empty()) break;
      head += letter;
    }
    EXPECT_TRUE(head.starts_with("HTTP/1.1 101")) << head;
  }
  ~ViewClient() { close(file_); }
  ViewClient(const ViewClient&) = delete;
  ViewClient& operator=(const ViewClient&) = delete;

  /// The answer to `{"id": N, "do": "NAME", MEMBERS}`, as JSON; what comes before it is dropped.
  std::string ask(const std::string& name, const std::string& members = "") {
    const std::string id = say(name, members);
    while (true) {
      const Message message = next();
      if (message.text.empty() && message.doubles.empty()) return "";
      if (message.text.find("\"id\": " + id) != std::string::npos) return message.text;
    }
  }
  /// The numbers of the answer to `trace`, after its kind and its id.
  std::vector<double> ask_trace(const std::string& members) {
    const std::string id = say("trace", members);
    while (true) {
      const Message message = next();
      if (message.text.empty() && message.doubles.empty()) return {};
      if (message.doubles.size() > 2 && message.doubles[0] == 2. &&
          message.doubles[1] == std::stod(id))
        return {message.doubles.begin() + 2, message.doubles.end()};
    }
  }
  /// The next message in which `text` stands; "" when the connection ends.
  std::string wait_for(const std::string& text) {
    while (true) {
      const Message message = next();
      if (message.text.empty() && message.doubles.empty()) return "";
      if (message.text.find(text) != std::string::npos) return message.text;
    }
  }
  /// The next snapshot's numbers, from its kind on.
  std::vector<double> snapshot() {
    while (true) {
      const Message message = next();
      if (message.text.empty() && message.doubles.empty()) return {};
      if (!message.doubles.empty() && message.doubles[0] == 1.) return message.doubles;
    }
  }

 private:
  struct Message {
    std::string text;
    std::vector<double> doubles;
  };

  std::string say(const std::string& name, const std::string& members) {
    const std::string id = std::to_string(++last_id_);
    const std::string text = "{\"id\": " + id + ", \"do\": \"" + name + "\"" +
                             (members.empty() ? "" : ", " + members) + "}";
    constexpr char last_text = '\x81';
    std::string frame{last_text};
    const bool is_short = text.size() < 126;
    frame += static_cast<char>(0x80 | (is_short ? text.size() : 126));
    if (!is_short) frame += static_cast<char>(text.size() >> 8);
    if (!is_short) frame += static_cast<char>(text.size());
    write(frame + std::string(4, '\0') + text);  // a mask of zeros
    return id;
  }

  Message next() {
    const std::string head = read(2);
    if (head.size() < 2) return {};
    std::uint64_t size = static_cast<unsigned char>(head[1]);
    if (size >= 126) {
      const std::string length = read(size == 126 ? 2 : 8);
      size = 0;
      for (const char byte : length) size = size << 8 | static_cast<unsigned char>(byte);
    }
    const std::string payload = read(size);
    if ((head[0] & 0x0f) == 1) return {payload, {}};
    if ((head[0] & 0x0f) != 2) return next();
    Message message;
    message.doubles.resize(payload.size() / sizeof(double));
    std::memcpy(message.doubles.data(), payload.data(), payload.size());
    return message;
  }

  void write(const std::string& bytes) const {
    EXPECT_EQ(::send(file_, bytes.data(), bytes.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(bytes.size()));
  }
  /// Fewer where the other end closes, or says nothing for a minute.
  std::string read(std::size_t count) {
    while (read_.size() < count) {
      pollfd ready{file_, POLLIN, 0};
      char buffer[65536];
      const ssize_t got = poll(&ready, 1, 60'000) == 1 ? recv(file_, buffer, sizeof buffer, 0) : 0;
      if (got <= 0) break;
      read_.append(buffer, static_cast<std::size_t>(got));
    }
    const std::string result = read_.substr(0, count);
    read_.erase(0, count);
    return result;
  }

  int file_;
  int last_id_ = 0;
  std::string read_;
};

}  // namespace hookpoint::testing
