// The server of the window: gives the page by HTTP and speaks with it by WebSocket, in a thread of
// its own. Nobody waits for a browser: every call here is cheap, and a browser that is slow or gone
// costs a bounded amount of memory.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "apps/view/wire/admission.h"

namespace hookpoint::view {

struct ServerOptions {
  std::string address = "127.0.0.1";  ///< an IP address; 0.0.0.0 or :: for every network
  std::uint16_t port = 0;             ///< 0: a free one
  std::string token = fresh_token();  ///< letters, digits, - and _
  std::chrono::milliseconds request_time{10'000};  ///< for a request to come in whole
  std::chrono::milliseconds answer_time{60'000};   ///< for a file to be taken
  /// Between two pings. A client that has been silent for two of these has vanished.
  std::chrono::milliseconds ping_interval{20'000};
};

/// Why it cannot listen, and what to do.
struct ServerError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Server {
 public:
  /// What a message from a client may have, in bytes.
  static constexpr std::size_t longest_message = std::size_t{1} << 20;
  /// Unsent text and answers of a client, in bytes, beyond which it is given up.
  static constexpr std::size_t most_unsent = std::size_t{16} << 20;
  /// Connections at a time. The oldest that only fetches files makes room for another.
  static constexpr std::size_t most_connections = 64;
  /// Events that nobody has taken, beyond which clients are read no further.
  static constexpr std::size_t most_events = 256;

  /// Of one connection; never given twice.
  using ClientId = std::uint64_t;
  struct Event {
    enum class Kind {
      joined,
      said,  ///< UTF-8 of at most longest_message
      left
    };
    Kind kind;
    ClientId client;
    std::string text;
  };

  /// Listens. `page` is given at `/` and `/index.html`; the WebSocket is at `/socket`.
  Server(const ServerOptions& options, std::string_view page);
  /// Says goodbye to clients, which have a moment to take what was sent before.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  std::uint16_t port() const;
  /// What to open, with the token.
  std::string url() const;

  /// What has happened since the last call, in its order. Oversized, binary and ill-coded messages
  /// are answered by the server itself.
  std::vector<Event> take_events();
  /// Waits for an event or wake(), until a time; true if there was one.
  bool wait(std::chrono::steady_clock::time_point until);
  void wake();

  /// A message to one client, or to all that are there. What is sent arrives in its order. Unknown
  /// clients have left.
  void send(ClientId client, std::string json);
  void send_binary(ClientId client, std::string bytes);
  void broadcast(const std::string& json);
  /// A binary message to all, of which only the newest counts: each client has room for one that
  /// waits. It comes behind what was sent before it, and ahead of what is sent after it.
  void publish(std::shared_ptr<const std::string> frame);

  std::size_t clients() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace hookpoint::view
