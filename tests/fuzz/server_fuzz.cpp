// Any bytes to the window's server. The first chooses: a request, what a client says once it has
// joined, or frames for the reader alone. HOST and TOKEN in a request stand for the server's own.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "apps/view/wire/server.h"
#include "apps/view/wire/websocket.h"
#include "tests/fuzz/fuzz.h"
#include "text/utf8.h"

namespace hookpoint {
namespace {

constexpr std::string_view page = "<!doctype html><title>the page</title>";

view::Server& server() {
  static view::Server only({}, page);
  return only;
}

std::string token() {
  const std::string url = server().url();
  return url.substr(url.find('=') + 1);
}

void replace(std::string& text, std::string_view name, const std::string& value) {
  for (std::size_t at = text.find(name); at != std::string::npos;
       at = text.find(name, at + value.size()))
    text.replace(at, name.size(), value);
}

std::string completed(std::string request) {
  replace(request, "HOST", "127.0.0.1:" + std::to_string(server().port()));
  replace(request, "TOKEN", token());
  return request;
}

/// Says all of `bytes`, and hears the server out: it ends every connection of which nothing more
/// comes.
std::string exchange(const std::string& bytes) {
  const int file = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(server().port());
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  fuzz::require(connect(file, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0,
                "nobody listens any more");
  std::string_view rest = bytes;
  while (!rest.empty()) {
    const ssize_t count = send(file, rest.data(), rest.size(), MSG_NOSIGNAL);
    if (count <= 0) break;
    rest.remove_prefix(static_cast<std::size_t>(count));
  }
  shutdown(file, SHUT_WR);
  std::string heard;
  while (true) {
    pollfd ready{file, POLLIN, 0};
    fuzz::require(poll(&ready, 1, 20'000) == 1, "a connection that does not end");
    char buffer[4096];
    const ssize_t count = recv(file, buffer, sizeof buffer, 0);
    if (count <= 0) break;
    heard.append(buffer, static_cast<std::size_t>(count));
  }
  close(file);
  return heard;
}

/// What came of it: clients that join before they say something, and say UTF-8.
void require_events() {
  for (const view::Server::Event& event : server().take_events()) {
    if (event.kind != view::Server::Event::Kind::said) continue;
    fuzz::require(event.text.size() <= view::Server::longest_message, "a message too long");
    fuzz::require(text::repaired(event.text) == event.text, "a message that is not UTF-8");
  }
}

void require_answer(const std::string& answer) {
  fuzz::require(answer.empty() || answer.starts_with("HTTP/1.1 "), "no answer of HTTP");
}

void ask(const std::string& bytes) {
  const std::string request = completed(bytes);
  const std::string answer = exchange(request);
  require_answer(answer);
  const bool knows = request.find(token()) != std::string::npos;
  fuzz::require(knows || answer.find(page) == std::string::npos, "the page, without the token");
  fuzz::require(knows || answer.find(" 101 ") == std::string::npos, "a client, without the token");
}

void say(const std::string& bytes) {
  const std::string answer =
      exchange(completed("GET /socket?token=TOKEN HTTP/1.1\r\nHost: HOST\r\nConnection: Upgrade\r\n"
                         "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
                         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n") +
               bytes);
  require_answer(answer);
}

using Message = view::MessageReader::Message;

/// The messages of bytes that come in pieces of `size`.
std::vector<Message> messages(const std::string& bytes, std::size_t size) {
  constexpr std::size_t bound = 100;
  view::MessageReader reader(bound);
  std::vector<Message> all;
  for (std::size_t at = 0; at < bytes.size(); at += size) {
    std::string_view piece = std::string_view(bytes).substr(at, size);
    while (auto message = reader.next(piece)) {
      fuzz::require(message->payload.size() <= bound + 25, "more than the bound");
      all.push_back(std::move(*message));
    }
    fuzz::require(piece.empty(), "bytes that are neither read nor a message");
  }
  return all;
}

void read(const std::string& bytes) {
  const std::vector<Message> whole = messages(bytes, bytes.size() + 1);
  for (const std::size_t size : {1, 7}) {
    const std::vector<Message> pieces = messages(bytes, size);
    fuzz::require(pieces.size() == whole.size(), "messages that depend on how the bytes came");
    for (std::size_t i = 0; i < whole.size(); ++i)
      fuzz::require(pieces[i].kind == whole[i].kind && pieces[i].payload == whole[i].payload,
                    "a message that depends on how the bytes came");
  }
}

void run(char kind, const std::string& bytes) {
  switch (static_cast<unsigned char>(kind) % 3) {
    case 0:
      ask(bytes);
      break;
    case 1:
      say(bytes);
      break;
    default:
      read(bytes);
  }
  require_events();
  static unsigned count = 0;
  if (++count % 100 == 0)
    fuzz::require(
        exchange(completed("GET /?token=TOKEN HTTP/1.1\r\nHost: HOST\r\n\r\n")).ends_with(page),
        "a server that no longer gives its page");
}

}  // namespace
}  // namespace hookpoint

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 0)
    hookpoint::run(static_cast<char>(data[0]), {reinterpret_cast<const char*>(data) + 1, size - 1});
  return 0;
}
