// The connected pages: what each wants to see, what they request, and what they are sent. Between a
// session, which knows the run, and the server, which knows the network.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/view/wire/commands.h"
#include "apps/view/wire/server.h"
#include "apps/view/wire/snapshot.h"
#include "apps/view/wire/value_layout.h"
#include "simulation/wiring/ports.h"
#include "text/json.h"

namespace hookpoint::view {

/// A request that only the session can carry out.
struct PageRequest {
  Server::ClientId client = 0;
  std::int64_t id = 0;
  Command command;
};

class Audience {
 public:
  /// It outlives this.
  explicit Audience(Server& server) : server_(server) {}

  /// From now on this is what is shown: to those who are there, and to whoever joins.
  /// `description`: the JSON text (docs/view_protocol.md). `ports`: all that can be read, which
  /// live until the next call. `always`: trails watched whoever asks. Trails that are no longer
  /// there are NaN.
  void show(std::string description, const simulation::Experiment& experiment,
            std::vector<simulation::Port> ports, std::vector<std::string> always);

  /// Takes in who has come and gone, and what has been requested. Never waits.
  void hear();
  /// The first of what was heard that only the session can carry out, none where all is done. What
  /// comes before it and needs no session is answered on the way: read, trails, watch, and messages
  /// that are none. So each is answered by the state that those before it have left.
  std::optional<PageRequest> next();
  /// Waits until a request comes, or the time has come.
  void wait(std::chrono::steady_clock::time_point until) { server_.wait(until); }
  bool empty() const { return server_.clients() == 0; }
  /// How many have joined so far.
  std::size_t joined() const { return joined_; }

  /// `members` writes what the answer holds beside `id` and `ok`.
  void answer(
      const PageRequest& request,
      const std::function<void(text::JsonWriter&)>& members = [](text::JsonWriter&) {});
  void refuse(const PageRequest& request, const std::string& problem);
  void answer_trace(const PageRequest& request, std::string bytes);

  void tell_notice(std::string_view level, const std::string& text);
  void tell_changed(std::int64_t step, double time, const std::string& trail,
                    const std::string& value);
  /// Of long work: how far it has come, from 0 to 1.
  void tell_progress(std::string_view work, double done);
  void tell_ended(const std::string& reason);

  /// The newest instant; `state.layout` is filled in.
  void publish(SessionState state, std::span<const SubjectState> subjects);

 private:
  void answer_own(Server::ClientId client, std::int64_t id, const ReadPorts& request);
  void answer_own(Server::ClientId client, std::int64_t id, const ListPorts& request);
  void answer_own(Server::ClientId client, std::int64_t id, const WatchPorts& request);
  void refuse(Server::ClientId client, std::optional<std::int64_t> id, const std::string& problem);
  void lay_out();

  Server& server_;
  const simulation::Experiment* experiment_ = nullptr;
  std::string description_;
  std::vector<simulation::Port> ports_;
  std::vector<std::string> always_;
  std::map<Server::ClientId, std::vector<std::string>> wishes_;
  std::size_t joined_ = 0;
  std::deque<Server::Event> heard_;
  ValueLayout layout_;  ///< of what snapshots carry
};

}  // namespace hookpoint::view
