// A browser's end of a window, without a browser: speaks docs/view_protocol.md by a plain socket
// (RFC 6455), so that tests see what the program tells.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "text/json_reader.h"

namespace hookpoint::testing {

class WindowClient {
 public:
  /// `url`: as the program prints it, "http://127.0.0.1:PORT/?token=T".
  explicit WindowClient(const std::string& url) : file_(socket(AF_INET, SOCK_STREAM, 0)) {
    if (url.find('?') == std::string::npos) return;
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
    connected_ = head.starts_with("HTTP/1.1 101");
    EXPECT_TRUE(connected_) << head;
  }
  ~WindowClient() { close(file_); }
  WindowClient(const WindowClient&) = delete;
  WindowClient& operator=(const WindowClient&) = delete;

  bool connected() const { return connected_; }

  /// One text message.
  void say(const std::string& text) {
    constexpr char last_text = '\x81';
    write(frame(last_text, text));
  }
  /// The next text message. Nothing, here and below: the connection has ended, or it took minutes.
  std::optional<std::string> hear() {
    return text_that([](const std::string&) { return true; });
  }
  /// The next message in which `text` stands, or "".
  std::string wait_for(const std::string& text) {
    const auto has = [&](const std::string& said) { return said.find(text) != said.npos; };
    return text_that(has).value_or("");
  }
  /// The answer to `{"id": N, "do": "NAME", MEMBERS}`, as JSON; what comes before it is dropped.
  std::string ask(const std::string& name, const std::string& members = "") {
    return wait_for("\"id\": " + request(name, members));
  }
  /// The numbers of the answer to `trace`, after its kind and its id.
  std::vector<double> ask_trace(const std::string& members) {
    const double id = std::stod(request("trace", members));
    const auto answer = next_that([&](const Message& message) {
      return message.doubles.size() > 2 && message.doubles[0] == 2. && message.doubles[1] == id;
    });
    if (!answer) return {};
    return {answer->doubles.begin() + 2, answer->doubles.end()};
  }
  /// The next snapshot's numbers, from its kind on.
  std::vector<double> snapshot() {
    const auto answer = next_that([](const Message& message) {
      return !message.doubles.empty() && message.doubles[0] == 1.;
    });
    return answer ? answer->doubles : std::vector<double>();
  }

 private:
  using Clock = std::chrono::steady_clock;
  /// Generous: a sanitizer and other work on the machine make a program slow.
  static constexpr std::chrono::seconds patience{120};
  struct Message {
    std::string text;
    std::vector<double> doubles;
  };

  static std::string frame(char head, const std::string& payload) {
    std::string bytes{head};
    const bool is_short = payload.size() < 126;
    bytes += static_cast<char>(0x80 | (is_short ? payload.size() : 126));
    if (!is_short) bytes += static_cast<char>(payload.size() >> 8);
    if (!is_short) bytes += static_cast<char>(payload.size());
    return bytes + std::string(4, '\0') + payload;  // a mask of zeros
  }

  /// Its id.
  std::string request(const std::string& name, const std::string& members) {
    const std::string id = std::to_string(++last_id_);
    say("{\"id\": " + id + ", \"do\": \"" + name + "\"" + (members.empty() ? "" : ", " + members) +
        "}");
    return id;
  }

  template <class Wanted>
  std::optional<Message> next_that(const Wanted& wanted) {
    for (const auto until = Clock::now() + patience; Clock::now() < until;) {
      auto message = next();
      if (!message || wanted(*message)) return message;
    }
    return std::nullopt;
  }
  template <class Wanted>
  std::optional<std::string> text_that(const Wanted& wanted) {
    auto message =
        next_that([&](const Message& said) { return !said.text.empty() && wanted(said.text); });
    if (!message) return std::nullopt;
    return std::move(message->text);
  }

  std::optional<Message> next() {
    const std::string head = read(2);
    if (head.size() < 2) return std::nullopt;
    std::uint64_t size = static_cast<unsigned char>(head[1]);
    if (size >= 126) {
      const std::string length = read(size == 126 ? 2 : 8);
      size = 0;
      for (const char byte : length) size = size << 8 | static_cast<unsigned char>(byte);
    }
    const std::string payload = read(size);
    const int opcode = head[0] & 0x0f;
    constexpr int text = 1, binary = 2, close = 8, ping = 9;
    constexpr char pong = '\x8a';
    if (payload.size() < size || opcode == close) return std::nullopt;
    // Who says nothing for long is taken for gone.
    if (opcode == ping) write(frame(pong, payload));
    if (opcode == text) return Message{payload, {}};
    if (opcode != binary) return next();
    Message message;
    message.doubles.resize(payload.size() / sizeof(double));
    std::memcpy(message.doubles.data(), payload.data(), payload.size());
    return message;
  }

  void write(const std::string& bytes) const {
    EXPECT_EQ(::send(file_, bytes.data(), bytes.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(bytes.size()));
  }
  /// Fewer where the other end closes, or says nothing.
  std::string read(std::size_t count) {
    while (read_.size() < count) {
      pollfd ready{file_, POLLIN, 0};
      char buffer[65536];
      const int milliseconds = static_cast<int>(patience.count()) * 1000;
      const bool there = poll(&ready, 1, milliseconds) == 1;
      const ssize_t got = there ? recv(file_, buffer, sizeof buffer, 0) : 0;
      if (got <= 0) break;
      read_.append(buffer, static_cast<std::size_t>(got));
    }
    const std::string result = read_.substr(0, count);
    read_.erase(0, count);
    return result;
  }

  int file_;
  int last_id_ = 0;
  bool connected_ = false;
  std::string read_;
};

}  // namespace hookpoint::testing
