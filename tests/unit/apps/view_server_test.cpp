// The window's server, spoken to by plain sockets: what is expected stands in RFC 9112 and RFC
// 6455.
// ctest: threads, clock
#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "apps/view/wire/server.h"

namespace hookpoint::view {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Kind = Server::Event::Kind;

constexpr std::string_view page = "<!doctype html><title>the page</title>";
const std::string token = "0123456789abcdef0123456789abcdef";

ServerOptions options() {
  ServerOptions given;
  given.token = token;
  return given;
}

/// For what comes at once unless it never does: a busy machine under a sanitizer is slow.
constexpr auto patience = 120s;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// A client's end of a connection.
class Socket {
 public:
  explicit Socket(std::uint16_t port, int receive_buffer = 0)
      : file_(socket(AF_INET, SOCK_STREAM, 0)) {
    if (receive_buffer > 0)
      setsockopt(file_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = connect(file_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
  }
  ~Socket() { close(file_); }
  Socket(Socket&& other) noexcept
      : file_(std::exchange(other.file_, -1)),
        connected_(other.connected_),
        ended_(other.ended_),
        read_(std::move(other.read_)) {}
  Socket& operator=(Socket&&) = delete;

  bool connected() const { return connected_; }

  /// False where the other end is closed.
  bool write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t count = ::send(file_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (count <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return true;
  }

  /// More bytes; false at the end, or after `patience` without any.
  bool read_more() {
    pollfd ready{file_, POLLIN, 0};
    if (poll(&ready, 1, static_cast<int>(std::chrono::milliseconds(patience).count())) != 1)
      return false;
    char buffer[65536];
    const ssize_t count = recv(file_, buffer, sizeof buffer, 0);
    ended_ = count <= 0;
    if (ended_) return false;
    read_.append(buffer, static_cast<std::size_t>(count));
    return true;
  }
  /// The next bytes, as many; fewer at the end.
  std::string read(std::size_t count) {
    while (read_.size() < count && read_more()) {
    }
    const std::string result = read_.substr(0, count);
    read_.erase(0, count);
    return result;
  }
  std::string read_through(std::string_view end) {
    while (read_.find(end) == std::string::npos && read_more()) {
    }
    const std::size_t at = read_.find(end);
    return read(at == std::string::npos ? read_.size() : at + end.size());
  }
  std::string read_all() {
    while (read_more()) {
    }
    return read(read_.size());
  }
  /// Whether the other end closes; what it still says is not looked at.
  bool is_closed() {
    while (read_more()) {
    }
    return ended_;
  }
  /// A vanished machine's: the connection ends without a goodbye.
  void reset() {
    const linger hard{1, 0};
    setsockopt(file_, SOL_SOCKET, SO_LINGER, &hard, sizeof hard);
    close(std::exchange(file_, -1));
  }

 private:
  int file_;
  bool connected_ = false;
  bool ended_ = false;  ///< the other end has closed
  std::string read_;
};

std::string own_host(const Server& server) { return "127.0.0.1:" + std::to_string(server.port()); }

std::string request(const std::string& first_line, const std::string& host,
                    const std::string& more = "") {
  return first_line + " HTTP/1.1\r\nHost: " + host + "\r\n" + more + "\r\n";
}

/// The whole answer to bytes that are a request, or not quite.
std::string ask_raw(const Server& server, const std::string& bytes) {
  Socket socket(server.port());
  socket.write(bytes);
  return socket.read_all();
}
std::string ask(const Server& server, const std::string& target, const std::string& more = "") {
  return ask_raw(server, request("GET " + target, own_host(server), more));
}

/// The status of an answer; 0 without one.
int status(const std::string& answer) {
  return answer.rfind("HTTP/1.1 ", 0) == 0 ? std::stoi(answer.substr(9, 3)) : 0;
}

std::string body(const std::string& answer) { return answer.substr(answer.find("\r\n\r\n") + 4); }

const std::string with_token = "?token=" + token;
/// RFC 6455, section 1.3: its key, and what a server answers to it.
const std::string handshake =
    "Connection: keep-alive, Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
const std::string accepted = "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=";

constexpr unsigned last = 0x80, continuation = 0, text = 1, binary = 2, close_frame = 8, ping = 9,
                   pong = 10;

/// RFC 6455, section 5.2: a client's frame, masked.
std::string frame(unsigned opcode, const std::string& payload, unsigned flags = last) {
  std::string bytes{static_cast<char>(flags | opcode)};
  const std::size_t size = payload.size();
  const int length_bytes = size < 126 ? 0 : size < 65536 ? 2 : 8;
  bytes += static_cast<char>(0x80 | (length_bytes == 0 ? size : length_bytes == 2 ? 126 : 127));
  for (int i = length_bytes - 1; i >= 0; --i) bytes += static_cast<char>(size >> (8 * i));
  const std::string mask = "\x37\xfa\x21\x3d";
  bytes += mask;
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(payload[i] ^ mask[i % 4]);
  return bytes;
}

struct Frame {
  unsigned opcode = 0;
  std::string payload;
  bool operator==(const Frame&) const = default;
};
void PrintTo(const Frame& frame, std::ostream* out) {
  *out << "opcode " << frame.opcode << ", " << frame.payload.size() << " bytes "
       << ::testing::PrintToString(frame.payload.substr(0, 80));
}

/// A browser's end of a WebSocket.
class Client {
 public:
  explicit Client(const Server& server, int receive_buffer = 0)
      : socket(server.port(), receive_buffer) {
    socket.write(request("GET /socket" + with_token, own_host(server), handshake));
    answer = socket.read_through("\r\n\r\n");
  }

  void say(const std::string& message) { socket.write(frame(text, message)); }

  /// The next frame; opcode 0 where the connection ends. A server's are whole and unmasked.
  Frame next() {
    const std::string head = socket.read(2);
    if (head.size() < 2) return {};
    const auto first = static_cast<unsigned char>(head[0]),
               second = static_cast<unsigned char>(head[1]);
    EXPECT_EQ(first & 0xf0U, last);
    EXPECT_EQ(second & 0x80U, 0U);
    std::uint64_t size = second;
    if (second >= 126) {
      size = 0;
      for (const char byte : socket.read(second == 126 ? 2 : 8))
        size = size << 8 | static_cast<unsigned char>(byte);
    }
    return {first & 0x0fU, socket.read(size)};
  }

  Socket socket;
  std::string answer;  ///< to the handshake
};

/// The next `count` events, or fewer where they do not come.
std::vector<Server::Event> events(Server& server, std::size_t count) {
  std::vector<Server::Event> all;
  const auto end = Clock::now() + patience;
  while (all.size() < count && Clock::now() < end) {
    server.wait(end);
    for (Server::Event& event : server.take_events()) all.push_back(std::move(event));
  }
  return all;
}
Server::Event event(Server& server) {
  const auto all = events(server, 1);
  return all.empty() ? Server::Event{Kind::left, 0, "no event"} : all.front();
}

bool is_error(const Frame& told) {
  return told.opcode == text && told.payload.rfind("{\"error\": \"", 0) == 0;
}

/// Memory that the program holds, in MB.
double resident() {
  std::ifstream file("/proc/self/statm");
  double all = 0, held = 0;
  file >> all >> held;
  return held * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

/// Sanitizers keep what is freed, to see who still uses it.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool memory_is_given_back = false;
#else
constexpr bool memory_is_given_back = true;
#endif
void expect_growth_below(double megabytes, double before) {
  if (!memory_is_given_back) return;
  EXPECT_LT(resident() - before, megabytes);
}

TEST(ViewServer, GivesThePageToWhoHasTheToken) {
  const Server server(options(), page);
  EXPECT_EQ(server.url(), "http://127.0.0.1:" + std::to_string(server.port()) + "/" + with_token);
  for (const char* path : {"/", "/index.html"}) {
    const std::string answer = ask(server, path + with_token);
    EXPECT_EQ(status(answer), 200);
    EXPECT_EQ(body(answer), page);
    for (const char* field :
         {"Content-Type: text/html; charset=utf-8", "Content-Length: 38", "Cache-Control: no-store",
          "Referrer-Policy: no-referrer", "X-Content-Type-Options: nosniff",
          "Content-Security-Policy: default-src 'none'; ", "frame-ancestors 'none'"})
      EXPECT_NE(answer.find(field), std::string::npos) << field;
  }
  EXPECT_EQ(status(ask(server, "/" + with_token, "Origin: http://" + own_host(server) + "\r\n")),
            200);
  EXPECT_EQ(body(ask(server, "/?x=1&token=" + token + "&y")), page);
}

TEST(ViewServer, HeadIsTheSameWithoutABody) {
  const Server server(options(), page);
  const std::string answer = ask_raw(server, request("HEAD /" + with_token, own_host(server)));
  EXPECT_EQ(status(answer), 200);
  EXPECT_NE(answer.find("Content-Length: 38"), std::string::npos);
  EXPECT_EQ(body(answer), "");
}

TEST(ViewServer, RefusesEverythingWithoutTheToken) {
  const Server server(options(), page);
  std::string wrong = token;
  wrong.back() = '0';
  for (const std::string path : {"/", "/index.html", "/socket", "/nothing"}) {
    for (const std::string& query :
         std::vector<std::string>{"", "?", "?token=", "?token=" + wrong, "?token=" + token + "0",
                                  "?token=" + token.substr(1), "?Token=" + token,
                                  "?nottoken=" + token, "#token=" + token}) {
      EXPECT_EQ(status(ask(server, path + query)), 403) << path << query;
      EXPECT_EQ(status(ask(server, path + query, handshake)), 403) << path << query;
    }
  }
  EXPECT_EQ(status(ask_raw(server, request("POST /", own_host(server)))), 403);
  EXPECT_EQ(server.clients(), 0U);
}

TEST(ViewServer, RefusesForeignHostsAndOrigins) {
  const Server server(options(), page);
  const std::string port = ":" + std::to_string(server.port()), target = "GET /" + with_token;
  for (const std::string& host : {"127.0.0.1" + port, "localhost" + port, "LocalHost" + port})
    EXPECT_EQ(status(ask_raw(server, request(target, host))), 200) << host;
  for (const std::string& host :
       {"evil.example" + port, std::string("127.0.0.1"), std::string("127.0.0.1:1"), port,
        std::string(), "localhost.evil.example" + port, "192.0.2.1" + port, "[::2]" + port,
        "127.0.0.1" + port + "0", "[127.0.0.1]" + port, "127.0.0.1" + port + "\r\nHost: x"})
    EXPECT_EQ(status(ask_raw(server, request(target, host))), 403) << host;
  EXPECT_EQ(status(ask_raw(server, target + " HTTP/1.1\r\n\r\n")), 403);
  for (const std::string& origin : std::vector<std::string>{
           "http://evil.example", "null", "", "https://127.0.0.1" + port, "http://127.0.0.1:1",
           "http://localhost" + port, "http://127.0.0.1" + port + "\r\nOrigin: x"}) {
    EXPECT_EQ(status(ask(server, "/" + with_token, "Origin: " + origin + "\r\n")), 403) << origin;
    EXPECT_EQ(status(ask(server, "/socket" + with_token, handshake + "Origin: " + origin + "\r\n")),
              403)
        << origin;
  }
  EXPECT_EQ(server.clients(), 0U);
}

TEST(ViewServer, AnswersWrongRequestsByTheirStatus) {
  const Server server(options(), page);
  EXPECT_EQ(status(ask(server, "/nothing" + with_token)), 404);
  EXPECT_EQ(status(ask(server, "/../etc/passwd" + with_token)), 404);
  EXPECT_EQ(status(ask_raw(
                server, request("POST /" + with_token, own_host(server), "Content-Length: 5\r\n") +
                            "hello")),
            405);
  EXPECT_EQ(status(ask_raw(server, "no request\r\n\r\n")), 400);
  EXPECT_EQ(status(ask(server, "/" + with_token, "X: " + std::string(100'000, 'x') + "\r\n")), 431);
  EXPECT_EQ(status(ask(server, "/socket" + with_token)), 426);
  EXPECT_EQ(status(ask(server, "/socket" + with_token,
                       "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 8\r\n"
                       "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n")),
            426);
  EXPECT_EQ(
      status(ask(server, "/socket" + with_token,
                 "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n")),
      400);
}

TEST(ViewServer, GivesALargePageWhole) {
  const std::string large(3'000'000, 'x');
  Server server(options(), large);
  EXPECT_EQ(body(ask(server, "/" + with_token)), large);
  EXPECT_EQ(status(ask(server, "/picture.png" + with_token)), 404);
}

TEST(ViewServer, ShakesHandsAndPassesMessagesOn) {
  Server server(options(), page);
  Client client(server);
  EXPECT_EQ(status(client.answer), 101);
  EXPECT_NE(client.answer.find("Sec-WebSocket-Accept: " + accepted + "\r\n"), std::string::npos);
  const Server::Event joined = event(server);
  EXPECT_EQ(joined.kind, Kind::joined);
  EXPECT_EQ(server.clients(), 1U);

  client.say(R"({"id": 1, "name": "glissière"})");
  const Server::Event said = event(server);
  EXPECT_EQ(said.kind, Kind::said);
  EXPECT_EQ(said.client, joined.client);
  EXPECT_EQ(said.text, R"({"id": 1, "name": "glissière"})");

  server.send(joined.client, "one");
  server.broadcast("two");
  server.send_binary(joined.client, std::string(70'000, 'b'));
  server.publish(std::make_shared<const std::string>("frame"));
  server.send(joined.client, std::string(200, 'x'));
  EXPECT_EQ(client.next(), (Frame{text, "one"}));
  EXPECT_EQ(client.next(), (Frame{text, "two"}));
  EXPECT_EQ(client.next(), (Frame{binary, std::string(70'000, 'b')}));
  EXPECT_EQ(client.next(), (Frame{binary, "frame"}));
  EXPECT_EQ(client.next(), (Frame{text, std::string(200, 'x')}));

  client.socket.write(frame(close_frame, "\x03\xe8"));
  EXPECT_EQ(client.next(), (Frame{close_frame, "\x03\xe8"}));
  EXPECT_EQ(event(server).kind, Kind::left);
  EXPECT_EQ(server.clients(), 0U);
  server.send(joined.client, "to nobody");
}

TEST(ViewServer, JoinsFragmentsWithControlFramesBetween) {
  Server server(options(), page);
  Client client(server);
  event(server);
  // The handshake and its first frame may come in one piece, and a frame in many.
  const std::string bytes = frame(text, "a wa", 0) + frame(ping, "are you there") +
                            frame(continuation, "lking ins", 0) + frame(continuation, "", 0) +
                            frame(continuation, "ect");
  for (const char byte : bytes) client.socket.write({&byte, 1});
  EXPECT_EQ(event(server).text, "a walking insect");
  EXPECT_EQ(client.next(), (Frame{pong, "are you there"}));
  // Section 5.7's own example, with its mask.
  client.socket.write("\x81\x85\x37\xfa\x21\x3d\x7f\x9f\x4d\x51\x58");
  EXPECT_EQ(event(server).text, "Hello");
}

TEST(ViewServer, TakesAFrameThatComesWithTheHandshake) {
  Server server(options(), page);
  Socket socket(server.port());
  socket.write(request("GET /socket" + with_token, own_host(server), handshake) +
               frame(text, "early"));
  const auto both = events(server, 2);
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[1].text, "early");
}

TEST(ViewServer, AnswersWhatIsNoRequestByAnErrorAndStays) {
  Server server(options(), page);
  Client client(server);
  event(server);
  const std::string most(std::size_t{1} << 20, 'x');
  const auto still_there = [&] {
    client.say("again");
    EXPECT_EQ(event(server).text, "again");
  };
  client.say(most);
  EXPECT_EQ(event(server).text, most);

  for (const std::string& wrong :
       {frame(text, most + "x"), frame(text, most, 0) + frame(continuation, "x"),
        frame(text, most + most + most, 0) + frame(continuation, most, 0) +
            frame(continuation, most),
        frame(binary, "abc"), frame(binary, ""), frame(text, "\xff\xfe"), frame(text, "\xc0\xaf"),
        frame(text, "\xed\xa0\x80"), frame(text, "glissi\xc3")}) {
    client.socket.write(wrong);
    EXPECT_TRUE(is_error(client.next())) << ::testing::PrintToString(wrong.substr(0, 20));
    still_there();
  }
  // A character may be cut by the end of a frame, not by that of a message.
  client.socket.write(frame(text, "glissi\xc3", 0) + frame(continuation, "\xa8re"));
  EXPECT_EQ(event(server).text, "glissière");
  EXPECT_EQ(server.clients(), 1U);
}

TEST(ViewServer, ClosesAConnectionThatBreaksTheProtocol) {
  Server server(options(), page);
  using namespace std::string_literals;
  for (const std::string& wrong :
       {"\x81\x05Hello"s,                                              // not masked
        frame(3, "x"), frame(7, "x"), frame(11, "x"),                  // reserved opcodes
        frame(text, "x", last | 0x40), frame(text, "x", last | 0x10),  // no extension was agreed on
        frame(continuation, "x"),                                      // of nothing
        frame(text, "x", 0) + frame(text, "y"),                        // within another message
        frame(ping, "x", 0), frame(ping, std::string(126, 'x')),       // section 5.5
        "\x81\xfe\x00\x05"s + "\0\0\0\0Hello"s,  // a length not in its shortest form
        "\x81\xff\x80\0\0\0\0\0\0\0\0\0\0\0"s,   // a length of 64 bits
        frame(close_frame, "x"),
        frame(close_frame, "\x03\xed")}) {  // section 7.4.1: 1005 is never sent
    Client client(server);
    EXPECT_EQ(event(server).kind, Kind::joined);
    client.socket.write(wrong + frame(text, "not looked at"));
    EXPECT_EQ(client.next(), (Frame{close_frame, "\x03\xea"})) << ::testing::PrintToString(wrong);
    EXPECT_TRUE(client.socket.is_closed());
    EXPECT_EQ(event(server).kind, Kind::left);
  }
  Client client(server);
  EXPECT_EQ(event(server).kind, Kind::joined);
}

TEST(ViewServer, AFrameThatClaimsAllMemoryTakesNone) {
  Server server(options(), page);
  Client client(server);
  event(server);
  client.socket.write({"\x81\xff\x7f\xff\xff\xff\xff\xff\xff\xff\0\0\0\0", 14});
  EXPECT_TRUE(is_error(client.next()));
  const double before = resident();
  for (int i = 0; i < 64; ++i) client.socket.write(std::string(1'000'000, 'x'));
  server.send(1, "still there");
  EXPECT_EQ(client.next(), (Frame{text, "still there"}));
  expect_growth_below(32., before);
}

TEST(ViewServer, NobodyWaitsForAClientThatNeverReads) {
  Server server(options(), page);
  const Client deaf(server, 4096);
  Client hearing(server);
  events(server, 2);
  const double before = resident();
  double publishing = 0;
  for (int i = 0; i < 10'000; ++i) {
    const auto bytes =
        std::make_shared<const std::string>(100'000, static_cast<char>('a' + i % 20));
    const auto begin = Clock::now();
    server.publish(bytes);
    publishing += seconds_since(begin);
  }
  // To wait for the other, once, would take until it is given up.
  EXPECT_LT(publishing, 30.);
  expect_growth_below(64., before);
  server.publish(std::make_shared<const std::string>("newest"));
  std::size_t frames = 1;
  Frame frame = hearing.next();
  for (; frame.opcode == binary && frame.payload != "newest"; ++frames) frame = hearing.next();
  EXPECT_EQ(frame.payload, "newest");
  EXPECT_LT(frames, 10'000U);
  EXPECT_EQ(server.clients(), 2U);
}

TEST(ViewServer, AClientThatTakesNoAnswersIsGivenUp) {
  Server server(options(), page);
  const Client deaf(server, 4096);
  const Server::ClientId client = event(server).client;
  const double before = resident();
  for (int i = 0; i < 1000; ++i) server.send(client, std::string(100'000, 'x'));
  const Server::Event left = event(server);
  EXPECT_EQ(left.kind, Kind::left);
  EXPECT_EQ(left.client, client);
  expect_growth_below(64., before);
}

TEST(ViewServer, ATextBetweenFramesKeepsItsPlace) {
  Server server(options(), page);
  Client client(server);
  event(server);
  for (int i = 0; i < 100; ++i) {
    server.publish(std::make_shared<const std::string>("before"));
    server.broadcast("layout");
    server.publish(std::make_shared<const std::string>("after"));
    Frame told = client.next();
    if (told.payload == "before") told = client.next();
    EXPECT_EQ(told, (Frame{text, "layout"}));
    EXPECT_EQ(client.next(), (Frame{binary, "after"}));
  }
}

TEST(ViewServer, EventsThatNobodyTakesAreBounded) {
  Server server(options(), page);
  Client client(server);
  constexpr int count = 2000;
  const std::string message(20'000, 'x');
  const double before = resident();
  std::thread talking([&] {
    for (int i = 0; i < count; ++i) client.say(message + std::to_string(i));
  });
  std::this_thread::sleep_for(500ms);
  expect_growth_below(32., before);
  const auto first = server.take_events();
  EXPECT_LE(first.size(), Server::most_events);
  // Once they are taken, the rest comes, in its order and whole.
  const auto rest = events(server, count + 1 - first.size());
  talking.join();
  ASSERT_EQ(first.size() + rest.size(), count + 1U);
  EXPECT_EQ(rest.back().text, message + std::to_string(count - 1));
}

TEST(ViewServer, WaitsForAnEventAWakeOrATime) {
  Server server(options(), page);
  const auto begin = Clock::now();
  EXPECT_FALSE(server.wait(begin + 50ms));
  EXPECT_GE(seconds_since(begin), 0.05);
  std::thread waking([&] { server.wake(); });
  EXPECT_TRUE(server.wait(Clock::now() + patience));
  waking.join();
  EXPECT_FALSE(server.wait(Clock::now()));
  const Client client(server);
  EXPECT_TRUE(server.wait(Clock::now() + patience));
  EXPECT_TRUE(server.wait(Clock::now() + patience));  // until it is taken
}

TEST(ViewServer, ServesManyAndSurvivesThoseThatVanish) {
  Server server(options(), page);
  std::vector<std::unique_ptr<Client>> clients;
  for (int i = 0; i < 50; ++i) clients.push_back(std::make_unique<Client>(server));
  EXPECT_EQ(events(server, 50).size(), 50U);
  server.broadcast("all");
  for (const auto& client : clients) EXPECT_EQ(client->next(), (Frame{text, "all"}));
  for (std::size_t i = 0; i < 25; ++i) clients[i]->socket.reset();
  for (const Server::Event& gone : events(server, 25)) EXPECT_EQ(gone.kind, Kind::left);
  EXPECT_EQ(server.clients(), 25U);
  server.broadcast("rest");
  for (std::size_t i = 25; i < 50; ++i) EXPECT_EQ(clients[i]->next(), (Frame{text, "rest"}));
}

TEST(ViewServer, HasABoundOfConnectionsThatClientsAreNotPushedOutOf) {
  Server server(options(), page);
  std::vector<Socket> idle;
  for (std::size_t i = 0; i < Server::most_connections; ++i) idle.emplace_back(server.port());
  // They ask for nothing, so another takes the place of the oldest.
  std::vector<std::unique_ptr<Client>> clients;
  for (std::size_t i = 0; i < Server::most_connections; ++i) {
    clients.push_back(std::make_unique<Client>(server));
    ASSERT_EQ(status(clients.back()->answer), 101);
  }
  EXPECT_TRUE(idle.front().is_closed());
  EXPECT_EQ(status(Client(server).answer), 0);
  EXPECT_EQ(server.clients(), Server::most_connections);
  clients.pop_back();
  EXPECT_EQ(events(server, Server::most_connections + 1).back().kind, Kind::left);
  EXPECT_EQ(status(Client(server).answer), 101);
}

TEST(ViewServer, HalfARequestIsNotWaitedForForever) {
  ServerOptions given = options();
  given.request_time = 200ms;
  const Server server(given, page);
  Socket socket(server.port());
  const auto begin = Clock::now();
  socket.write("GET / HTTP/1.1\r\n");
  // However long lines come, one by one.
  while (seconds_since(begin) < 60. && socket.write("X: y\r\n")) std::this_thread::sleep_for(50ms);
  EXPECT_TRUE(socket.is_closed());
  EXPECT_GE(seconds_since(begin), 0.2);
  EXPECT_LT(seconds_since(begin), 60.);
}

TEST(ViewServer, AClientThatAnswersNoPingHasVanished) {
  ServerOptions given = options();
  given.ping_interval = 2s;  // a busy machine answers within it
  Server server(given, page);
  Client silent(server);
  Client answering(server);
  events(server, 2);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(answering.next(), (Frame{ping, ""}));
    answering.socket.write(frame(pong, ""));
  }
  EXPECT_EQ(event(server).kind, Kind::left);
  EXPECT_EQ(server.clients(), 1U);
  EXPECT_TRUE(silent.socket.is_closed());
}

TEST(ViewServer, EndsAtOnceAndSaysGoodbyeBehindWhatWasSent) {
  auto server = std::make_unique<Server>(options(), page);
  const Client deaf(*server, 4096);
  Client client(*server);
  const Socket idle(server->port());
  events(*server, 2);
  for (int i = 0; i < 10; ++i) server->publish(std::make_shared<const std::string>(100'000, 'x'));
  server->broadcast("ended");
  std::thread reading([&] {
    Frame told = client.next();
    while (told.opcode == binary) told = client.next();
    EXPECT_EQ(told, (Frame{text, "ended"}));
    EXPECT_EQ(client.next(), (Frame{close_frame, "\x03\xe9"}));
  });
  const auto begin = Clock::now();
  server.reset();
  EXPECT_LT(seconds_since(begin), 20.);  // `answer_time` is 60 s
  reading.join();
}

TEST(ViewServer, TellsWhyItCannotListenAndWhatToDo) {
  const auto problem = [](const ServerOptions& given) -> std::string {
    try {
      const Server server(given, page);
    } catch (const ServerError& error) {
      return error.what();
    }
    return "";
  };
  const Server first(options(), page);
  ServerOptions given = options();
  given.port = first.port();
  EXPECT_EQ(problem(given), "port " + std::to_string(first.port()) +
                                " is taken, by another window or another program; --port 0 takes a "
                                "free one");
  given = options();
  given.address = "somewhere";
  EXPECT_NE(problem(given).find("'somewhere' is no IP address"), std::string::npos);
  given.address = "192.0.2.1";
  EXPECT_NE(problem(given).find("this machine has no address 192.0.2.1"), std::string::npos);
  given = options();
  given.token = "";
  EXPECT_NE(problem(given), "");
}

TEST(ViewServer, APortIsFreeAgainOnceItsWindowIsClosed) {
  ServerOptions given = options();
  {
    const Server server(given, page);
    given.port = server.port();
    EXPECT_EQ(status(ask(server, "/" + with_token)), 200);
    const Client client(server);
  }
  const Server again(given, page);
  EXPECT_EQ(status(ask(again, "/" + with_token)), 200);
}

TEST(ViewServer, ListensWhereItIsTold) {
  ServerOptions given = options();
  given.address = "0.0.0.0";
  const Server server(given, page);
  const std::string port = ":" + std::to_string(server.port()), target = "GET /" + with_token;
  EXPECT_EQ(server.url().rfind("http://127.0.0.1:", 0), 0U);
  char machine[256] = {};
  gethostname(machine, sizeof machine - 1);
  for (const std::string& host :
       {"192.0.2.1" + port, "[2001:db8::1]" + port, "localhost" + port, machine + port})
    EXPECT_EQ(status(ask_raw(server, request(target, host))), 200) << host;
  EXPECT_EQ(status(ask_raw(server, request(target, "evil.example" + port))), 403);
}

TEST(ViewServer, ProgramsThatAreStartedDoNotKeepThePort) {
  const Server server(options(), page);
  const Client client(server);
  // Every socket of this process but the test's own.
  int inherited = 0;
  for (int file = 3; file < 100; ++file) {
    sockaddr_in address{};
    socklen_t size = sizeof address;
    if (getsockname(file, reinterpret_cast<sockaddr*>(&address), &size) != 0) continue;
    if (ntohs(address.sin_port) == server.port() && (fcntl(file, F_GETFD) & FD_CLOEXEC) == 0)
      ++inherited;
  }
  EXPECT_EQ(inherited, 0);
}

TEST(ViewServer, TokensDiffer) {
  const std::string one = fresh_token();
  EXPECT_EQ(one.size(), 32U);
  EXPECT_EQ(one.find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_NE(one, fresh_token());
  EXPECT_NE(ServerOptions().token, ServerOptions().token);
}

}  // namespace
}  // namespace hookpoint::view
