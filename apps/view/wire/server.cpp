#include "apps/view/wire/server.h"

#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/rfc7230.hpp>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <thread>

#include "apps/view/wire/websocket.h"

namespace hookpoint::view {
namespace {

namespace asio = boost::asio;
namespace http = boost::beast::http;
using asio::ip::tcp;
using Failure = boost::system::error_code;
using Bytes = std::shared_ptr<const std::string>;
using std::chrono::milliseconds;

constexpr std::size_t longest_request = std::size_t{32} << 10;  ///< with the cookies of others
constexpr std::size_t longest_rest = std::size_t{1} << 20;  ///< read behind an answer, unlooked at
constexpr milliseconds goodbye_time{2000};                  ///< for a client to close its end
constexpr milliseconds farewell_time{250};                  ///< the same, when the server ends
/// What the kernel may keep for a client: a slow one sees what is not much older.
constexpr int kernel_buffer = 256 << 10;
/// Events that nobody has taken, in bytes.
constexpr std::size_t most_event_bytes = std::size_t{8} << 20;

/// Programs that are started, a browser say, do not inherit the socket.
void keep_to_ourselves(int socket) { fcntl(socket, F_SETFD, FD_CLOEXEC); }

struct Resource {
  std::string content_type;
  Bytes bytes;
};

struct Answer {
  http::status status = http::status::ok;
  Resource resource;
  std::string more_fields;  ///< each with its line end
};

Answer refusal(http::status status, std::string why, std::string more_fields = "") {
  return {status,
          {"text/plain; charset=utf-8", std::make_shared<const std::string>(std::move(why) + "\n")},
          std::move(more_fields)};
}

/// The page is one file, so its script and styles stand in it; what they may reach is this server,
/// by `host`, the name that it was called by. Some browsers do not count a WebSocket as 'self'.
std::string content_security_policy(const std::string& host) {
  return "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
         "img-src 'self' data: blob:; font-src data:; media-src 'self' blob:; worker-src blob:; "
         "connect-src 'self' ws://" +
         host + "; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
}

std::string status_line_and_fields(const Answer& answer, const std::string& host) {
  std::string text = "HTTP/1.1 " + std::to_string(static_cast<unsigned>(answer.status)) + " ";
  text += std::string(http::obsolete_reason(answer.status)) + "\r\n";
  text += "Content-Type: " + answer.resource.content_type + "\r\n";
  text += "Content-Length: " + std::to_string(answer.resource.bytes->size()) + "\r\n";
  if (!host.empty()) text += "Content-Security-Policy: " + content_security_policy(host) + "\r\n";
  text +=
      "Cache-Control: no-store\r\nReferrer-Policy: no-referrer\r\n"
      "X-Content-Type-Options: nosniff\r\nCross-Origin-Resource-Policy: same-origin\r\n"
      "Connection: close\r\n";
  return text + answer.more_fields + "\r\n";
}

std::string error_message(const char* what) { return std::string(R"({"error": ")") + what + "\"}"; }

/// What is to be written to a client, in its order.
struct Outgoing {
  Opcode opcode;
  Bytes payload;
  bool newest_wins = false;  ///< a published frame
};

class Connection;

/// What connections and the calls of Server share. Connections live in the one thread that runs
/// `context`; the members under `mutex` are everybody's.
struct Shared {
  explicit Shared(const ServerOptions& given) : options(given) {}

  const ServerOptions options;
  asio::io_context context{1};
  Listening listening;
  Resource index;  ///< the page
  std::map<Server::ClientId, std::shared_ptr<Connection>> connections;
  std::set<Server::ClientId> waiting;  ///< for room for their events
  bool ending = false;
  std::atomic<std::size_t> clients{0};

  std::mutex mutex;
  std::condition_variable happened;
  std::vector<Server::Event> events;
  std::size_t event_bytes = 0;
  bool woken = false;
  /// The published frame that no connection has seen and no later message follows.
  std::shared_ptr<Bytes> newest;

  bool has_room() {
    const std::lock_guard lock(mutex);
    return events.size() < Server::most_events && event_bytes < most_event_bytes;
  }
  void tell(Server::Event event) {
    {
      const std::lock_guard lock(mutex);
      event_bytes += event.text.size();
      events.push_back(std::move(event));
    }
    happened.notify_all();
  }
};

/// One connection: a request, then its answer, or a WebSocket for as long as both ends wish.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Shared& shared, Server::ClientId id, tcp::socket socket)
      : shared_(shared), id_(id), socket_(std::move(socket)), timer_(shared.context) {
    Failure ignored;
    keep_to_ourselves(socket_.native_handle());
    socket_.set_option(tcp::no_delay(true), ignored);
    socket_.set_option(tcp::socket::send_buffer_size(kernel_buffer), ignored);
    request_.header_limit(longest_request);
  }

  void start() {
    give(shared_.options.request_time);
    read_request();
  }

  bool is_client() const { return state_ == State::open; }

  void send(Opcode opcode, Bytes payload, bool newest_wins = false) {
    if (state_ != State::open) return;
    if (unsent_ > Server::most_unsent) return finish();
    if (newest_wins) {
      std::erase_if(outgoing_, [](const Outgoing& waiting) { return waiting.newest_wins; });
    } else {
      unsent_ += payload->size();
    }
    outgoing_.push_back({opcode, std::move(payload), newest_wins});
    write();
  }

  /// Says goodbye behind what waits to be sent; a connection that is no WebSocket just ends.
  void say_goodbye(milliseconds time) {
    if (state_ != State::open) return finish();
    close(CloseCode::going_away, time);
  }

  /// Goes on with what was read while there was no room for events.
  void resume() {
    if (state_ == State::open) read_messages();
  }

  /// The connection is over, now.
  void finish() {
    if (state_ == State::over) return;
    leave();
    state_ = State::over;
    Failure ignored;
    socket_.close(ignored);
    timer_.cancel();
    shared_.waiting.erase(id_);
    shared_.connections.erase(id_);
  }

 private:
  enum class State {
    request,    ///< is being read
    answering,  ///< by a file or a refusal
    open,       ///< a WebSocket
    closing,    ///< our last bytes are on their way; what still comes is not looked at
    over
  };

  /// A member as handler: it keeps the connection, and is not called once that is over.
  template <class Member, class... Arguments>
  auto handler(Member member) {
    return [self = shared_from_this(), member](const Failure& failure, auto... count) {
      if (self->state_ != State::over) (self.get()->*member)(failure, count...);
    };
  }

  void give(milliseconds time) {
    timer_.expires_after(time);
    timer_.async_wait(handler(&Connection::time_is_up));
  }
  void time_is_up(const Failure& failure) {
    if (!failure && timer_.expiry() <= std::chrono::steady_clock::now()) finish();
  }

  // The request.

  void read_request() {
    socket_.async_read_some(asio::buffer(buffer_), handler(&Connection::have_request));
  }
  void have_request(const Failure& failure, std::size_t count) {
    if (failure) return finish();
    request_bytes_.append(buffer_.data(), count);
    Failure wrong;
    const std::size_t used = request_.put(asio::buffer(request_bytes_), wrong);
    request_bytes_.erase(0, used);
    if (wrong == http::error::header_limit || request_bytes_.size() > longest_request)
      return answer(refusal(http::status::request_header_fields_too_large, "a request too long"));
    if (wrong && wrong != http::error::need_more)
      return answer(refusal(http::status::bad_request, "no request of HTTP"));
    if (!request_.is_header_done()) return read_request();
    decide();
  }

  /// A field that stands once; "" without, nothing where it is repeated.
  std::optional<std::string> field(http::field name) const {
    const auto& fields = request_.get();
    if (fields.count(name) > 1) return std::nullopt;
    return std::string(fields[name]);
  }

  void decide() {
    const auto& request = request_.get();
    const auto host = field(http::field::host), origin = field(http::field::origin);
    const auto target = parse_target({request.target().data(), request.target().size()});
    const bool to_us = host && names_server(*host, shared_.listening);
    const bool from_us = origin && (request.find(http::field::origin) == request.end() ||
                                    (to_us && same_origin(*origin, *host)));
    if (!to_us || !from_us)
      return answer(refusal(http::status::forbidden,
                            "This window is opened by the address that hookpoint printed, not from "
                            "another site or by another name."));
    if (!same_token(target.token, shared_.options.token))
      return answer(refusal(http::status::forbidden,
                            "This window needs the token that is in the address that hookpoint "
                            "printed when it started."));
    host_ = *host;
    head_ = request.method() == http::verb::head;
    if (!head_ && request.method() != http::verb::get)
      return answer(
          refusal(http::status::method_not_allowed, "only GET and HEAD", "Allow: GET, HEAD\r\n"));
    if (target.path == "/socket") return join();
    if (target.path != "/" && target.path != "/index.html")
      return answer(refusal(http::status::not_found, "there is no such file"));
    answer({http::status::ok, shared_.index, ""});
  }

  void answer(const Answer& given) {
    state_ = State::answering;
    give(shared_.options.answer_time);
    const bool page = given.resource.content_type.starts_with("text/html");
    head_bytes_ = status_line_and_fields(given, page ? host_ : "");
    payload_ = head_ ? std::make_shared<const std::string>() : given.resource.bytes;
    write_bytes();
  }

  // The WebSocket.

  /// RFC 6455, section 4.2.
  void join() {
    const auto& request = request_.get();
    const auto key = field(http::field::sec_websocket_key);
    const bool asked = http::token_list(request[http::field::upgrade]).exists("websocket") &&
                       http::token_list(request[http::field::connection]).exists("upgrade");
    if (!asked || field(http::field::sec_websocket_version) != "13")
      return answer(refusal(http::status::upgrade_required, "here is a WebSocket of version 13",
                            "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"));
    if (head_ || request.version() < 11 || !key || !is_websocket_key(*key) ||
        request.find(http::field::content_length) != request.end() ||
        request.find(http::field::transfer_encoding) != request.end())
      return answer(refusal(http::status::bad_request, "no handshake of a WebSocket"));
    if (!shared_.has_room())
      return answer(refusal(http::status::service_unavailable, "too much is happening"));
    state_ = State::open;
    ++shared_.clients;
    shared_.tell({Server::Event::Kind::joined, id_, ""});
    head_bytes_ =
        "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        "Sec-WebSocket-Accept: " +
        websocket_accept(*key) + "\r\n\r\n";
    payload_ = std::make_shared<const std::string>();
    write_bytes();
    timer_.expires_after(shared_.options.ping_interval);
    timer_.async_wait(handler(&Connection::tick));
    unread_ = request_bytes_;
    read_messages();
  }

  void leave() {
    if (state_ != State::open) return;
    --shared_.clients;
    shared_.tell({Server::Event::Kind::left, id_, ""});
  }

  void tick(const Failure& failure) {
    if (failure || state_ != State::open) return;
    // Of one that waits for room, nothing is heard that it may have said.
    silent_ticks_ = shared_.waiting.contains(id_) ? 0 : silent_ticks_ + 1;
    if (silent_ticks_ > 2) return finish();
    if (!ping_waits_) {
      ping_waits_ = true;
      outgoing_.push_back({Opcode::ping, std::make_shared<const std::string>(), false});
      write();
    }
    timer_.expires_after(shared_.options.ping_interval);
    timer_.async_wait(handler(&Connection::tick));
  }

  void read_messages() {
    while (state_ == State::open) {
      if (!shared_.has_room()) {
        shared_.waiting.insert(id_);
        return;
      }
      auto message = reader_.next(unread_);
      if (!message) break;
      take(std::move(*message));
    }
    if (state_ != State::over)
      socket_.async_read_some(asio::buffer(buffer_), handler(&Connection::have_bytes));
  }

  void have_bytes(const Failure& failure, std::size_t count) {
    if (failure) return finish();
    silent_ticks_ = 0;
    unread_ = {buffer_.data(), count};
    if (state_ == State::open) return read_messages();
    rest_ += count;
    if (rest_ > longest_rest) return finish();
    socket_.async_read_some(asio::buffer(buffer_), handler(&Connection::have_bytes));
  }

  void take(MessageReader::Message message) {
    using Kind = MessageReader::Kind;
    const auto refuse = [&](const char* why) {
      send(Opcode::text, std::make_shared<const std::string>(error_message(why)));
    };
    switch (message.kind) {
      case Kind::text:
        shared_.tell({Server::Event::Kind::said, id_, std::move(message.payload)});
        break;
      case Kind::binary:
        refuse("a binary message: requests are JSON in text messages");
        break;
      case Kind::oversized:
        refuse("a message of more than 1 MiB");
        break;
      case Kind::not_utf8:
        refuse("a text message that is not UTF-8");
        break;
      case Kind::ping:
        // Section 5.5.3: of several that wait, the newest alone needs an answer.
        std::erase_if(outgoing_, [](const Outgoing& o) { return o.opcode == Opcode::pong; });
        outgoing_.push_front(
            {Opcode::pong, std::make_shared<const std::string>(std::move(message.payload)), false});
        write();
        break;
      case Kind::pong:
        break;
      case Kind::close:
        outgoing_.clear();
        close(CloseCode::normal, goodbye_time);
        break;
      case Kind::violation:
        outgoing_.clear();
        close(CloseCode::protocol_error, goodbye_time);
        break;
    }
  }

  /// Writes what waits, a close frame, and the end of our half; then the client closes its own.
  void close(CloseCode code, milliseconds time) {
    leave();
    state_ = State::closing;
    if (shared_.waiting.erase(id_) > 0)
      socket_.async_read_some(asio::buffer(buffer_), handler(&Connection::have_bytes));
    outgoing_.push_back(
        {Opcode::close, std::make_shared<const std::string>(close_payload(code)), false});
    give(time);
    write();
  }

  // Writing.

  void write() {
    if (writing_ || outgoing_.empty()) return;
    Outgoing next = std::move(outgoing_.front());
    outgoing_.pop_front();
    if (next.opcode == Opcode::ping) ping_waits_ = false;
    if (!next.newest_wins && (next.opcode == Opcode::text || next.opcode == Opcode::binary))
      unsent_ -= next.payload->size();
    last_ = next.opcode == Opcode::close;
    head_bytes_ = frame_header(next.opcode, next.payload->size());
    payload_ = std::move(next.payload);
    write_bytes();
  }

  void write_bytes() {
    writing_ = true;
    const std::array<asio::const_buffer, 2> both{asio::buffer(head_bytes_),
                                                 asio::buffer(*payload_)};
    asio::async_write(socket_, both, handler(&Connection::written));
  }

  void written(const Failure& failure, std::size_t) {
    if (failure) return finish();
    writing_ = false;
    payload_.reset();
    if (state_ != State::answering && !last_) return write();
    // What was written arrives only if nothing that came is left unread when the socket is closed.
    Failure ignored;
    socket_.shutdown(tcp::socket::shutdown_send, ignored);
    if (state_ != State::answering) return;
    state_ = State::closing;
    give(goodbye_time);
    socket_.async_read_some(asio::buffer(buffer_), handler(&Connection::have_bytes));
  }

  Shared& shared_;
  const Server::ClientId id_;
  State state_ = State::request;
  tcp::socket socket_;
  asio::steady_timer timer_;
  std::array<char, 16384> buffer_;

  http::request_parser<http::empty_body> request_;
  std::string request_bytes_;  ///< not yet parsed, or behind the request
  std::string host_;           ///< of the request, once it is known to name us
  bool head_ = false;          ///< the request is HEAD

  MessageReader reader_{Server::longest_message};
  std::string_view unread_;  ///< in buffer_ or request_bytes_
  std::size_t rest_ = 0;     ///< bytes that came after our last
  int silent_ticks_ = 0;     ///< pings since anything came

  std::deque<Outgoing> outgoing_;
  std::size_t unsent_ = 0;  ///< bytes of it, but for frames of which the newest wins
  bool ping_waits_ = false;
  std::string head_bytes_;  ///< with payload_, what is being written
  Bytes payload_;
  bool writing_ = false;
  bool last_ = false;  ///< the close frame is being written, or was
};

std::string machine_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

/// Why it cannot listen there, and what to do.
std::string listening_problem(const Failure& failure, const ServerOptions& options) {
  const std::string port = std::to_string(options.port);
  if (failure == asio::error::address_in_use)
    return "port " + port +
           " is taken, by another window or another program; --port 0 takes a free one";
  if (failure == asio::error::access_denied)
    return "port " + port + " is the system's own; take one above 1023, or --port 0 for a free one";
  if (failure.value() == EADDRNOTAVAIL)
    return "this machine has no address " + options.address +
           "; --bind takes one of its own, or 0.0.0.0 for all of them";
  return "cannot listen at " + options.address + ", port " + port + ": " + failure.message();
}

}  // namespace

class Server::Implementation : public Shared {
 public:
  Implementation(const ServerOptions& given, std::string_view page) : Shared(given) {
    check(given);
    listen();
    index = {"text/html; charset=utf-8", std::make_shared<const std::string>(page)};
    accept();
    // Signals are for the thread that steps.
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    thread_ = std::thread([this] { context.run(); });
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
  }

  ~Implementation() {
    asio::post(context, [this] { end(); });
    thread_.join();
    connections.clear();
  }

  /// Has `call` done in the server's thread, behind what was sent and published before.
  template <class Call>
  void later(Call call) {
    const std::lock_guard lock(mutex);
    newest.reset();
    asio::post(context, std::move(call));
  }

  void send_to(ClientId client, Opcode opcode, Bytes payload) {
    later([this, client, opcode, payload = std::move(payload)] {
      if (const auto connection = find(client)) connection->send(opcode, payload);
    });
  }

  void send_to_all(Opcode opcode, const Bytes& payload, bool newest_wins) {
    for (const auto& connection : all()) connection->send(opcode, payload, newest_wins);
  }

  void publish(Bytes frame) {
    const std::lock_guard lock(mutex);
    if (newest) {
      *newest = std::move(frame);
      return;
    }
    newest = std::make_shared<Bytes>(std::move(frame));
    asio::post(context, [this, slot = newest] {
      Bytes chosen;
      {
        const std::lock_guard relock(mutex);
        chosen = std::move(*slot);
        if (newest == slot) newest.reset();
      }
      send_to_all(Opcode::binary, chosen, true);
    });
  }

  std::vector<Event> take_events() {
    std::vector<Event> taken;
    {
      const std::lock_guard lock(mutex);
      taken.swap(events);
      event_bytes = 0;
      if (taken.empty()) return taken;
    }
    asio::post(context, [this] {
      const std::set<ClientId> resumed = std::exchange(waiting, {});
      for (const ClientId client : resumed) {
        if (const auto connection = find(client)) connection->resume();
      }
    });
    return taken;
  }

 private:
  /// Held, since a connection that fails takes itself out of the list.
  std::shared_ptr<Connection> find(ClientId client) const {
    const auto found = connections.find(client);
    return found == connections.end() ? nullptr : found->second;
  }
  std::vector<std::shared_ptr<Connection>> all() const {
    std::vector<std::shared_ptr<Connection>> list;
    for (const auto& [id, connection] : connections) list.push_back(connection);
    return list;
  }

  static void check(const ServerOptions& given) {
    const bool plain = given.token.find_first_not_of(
                           "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_") ==
                       std::string::npos;
    if (given.token.empty() || !plain)
      throw ServerError("the window's token is made of letters, digits, - and _");
  }

  void listen() {
    Failure failure;
    const std::string numeric = options.address == "localhost" ? "127.0.0.1" : options.address;
    const auto address = asio::ip::make_address(numeric, failure);
    if (failure)
      throw ServerError("'" + options.address +
                        "' is no IP address; --bind takes 127.0.0.1 for this machine alone, or "
                        "0.0.0.0 for every network");
    const tcp::endpoint endpoint(address, options.port);
    acceptor_.open(endpoint.protocol(), failure);
    if (!failure) keep_to_ourselves(acceptor_.native_handle());
    // Else the port of a window just closed could not be taken again for a minute.
    if (!failure) acceptor_.set_option(tcp::acceptor::reuse_address(true), failure);
    if (!failure) acceptor_.bind(endpoint, failure);
    if (!failure) acceptor_.listen(asio::socket_base::max_listen_connections, failure);
    if (failure) throw ServerError(listening_problem(failure, options));
    listening = {numeric, acceptor_.local_endpoint().port(), machine_name()};
  }

  void accept() {
    acceptor_.async_accept([this](const Failure& failure, tcp::socket socket) {
      if (ending) return;
      if (failure) {
        // No file descriptor is left: somebody else's may be given back.
        pause_.expires_after(milliseconds(100));
        pause_.async_wait([this](const Failure&) {
          if (!ending) accept();
        });
        return;
      }
      if (make_room()) {
        const auto connection = std::make_shared<Connection>(*this, next_id_, std::move(socket));
        connections[next_id_++] = connection;
        connection->start();
      }
      accept();
    });
  }

  /// Whether there is room for another connection, if need be for that of one that is no client.
  bool make_room() {
    if (connections.size() < most_connections) return true;
    for (const auto& connection : all()) {
      if (connection->is_client()) continue;
      connection->finish();
      return true;
    }
    return false;
  }

  void end() {
    ending = true;
    Failure ignored;
    acceptor_.close(ignored);
    pause_.cancel();
    for (const auto& connection : all()) connection->say_goodbye(farewell_time);
  }

  tcp::acceptor acceptor_{context};
  asio::steady_timer pause_{context};  ///< before accepting again
  ClientId next_id_ = 1;
  std::thread thread_;
};

Server::Server(const ServerOptions& options, std::string_view page)
    : implementation_(std::make_unique<Implementation>(options, page)) {}

Server::~Server() = default;

std::uint16_t Server::port() const { return implementation_->listening.port; }

std::string Server::url() const {
  const Listening& listening = implementation_->listening;
  // From this machine, whatever network it listens at besides.
  std::string host = listening.address;
  if (host == "0.0.0.0") host = "127.0.0.1";
  if (host == "::") host = "::1";
  if (host.find(':') != std::string::npos) host = "[" + host + "]";
  return "http://" + host + ":" + std::to_string(listening.port) +
         "/?token=" + implementation_->options.token;
}

std::vector<Server::Event> Server::take_events() { return implementation_->take_events(); }

bool Server::wait(std::chrono::steady_clock::time_point until) {
  std::unique_lock lock(implementation_->mutex);
  const bool something = implementation_->happened.wait_until(
      lock, until, [&] { return implementation_->woken || !implementation_->events.empty(); });
  implementation_->woken = false;
  return something;
}

void Server::wake() {
  {
    const std::lock_guard lock(implementation_->mutex);
    implementation_->woken = true;
  }
  implementation_->happened.notify_all();
}

void Server::send(ClientId client, std::string json) {
  implementation_->send_to(client, Opcode::text,
                           std::make_shared<const std::string>(std::move(json)));
}

void Server::send_binary(ClientId client, std::string bytes) {
  implementation_->send_to(client, Opcode::binary,
                           std::make_shared<const std::string>(std::move(bytes)));
}

void Server::broadcast(const std::string& json) {
  implementation_->later(
      [server = implementation_.get(), text = std::make_shared<const std::string>(json)] {
        server->send_to_all(Opcode::text, text, false);
      });
}

void Server::publish(std::shared_ptr<const std::string> frame) {
  implementation_->publish(std::move(frame));
}

std::size_t Server::clients() const { return implementation_->clients; }

}  // namespace hookpoint::view
