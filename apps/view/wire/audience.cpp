#include "apps/view/wire/audience.h"

#include <algorithm>
#include <set>
#include <utility>

#include "simulation/wiring/port_search.h"
#include "simulation/wiring/ports.h"

namespace hookpoint::view {
namespace {

using simulation::Port;
using text::JsonWriter;

JsonWriter begin_answer(std::int64_t id) {
  JsonWriter json;
  json.begin_object().member("id", id).member("ok", true);
  return json;
}

std::string notice_text(std::string_view level, const std::string& text) {
  JsonWriter json;
  json.begin_object().member("tell", "notice").member("level", level).member("text", text);
  return json.end_object().text();
}

}  // namespace

void Audience::show(std::string description, const simulation::Experiment& experiment,
                    std::vector<Port> ports, std::vector<std::string> always) {
  description_ = std::move(description);
  experiment_ = &experiment;
  ports_ = std::move(ports);
  always_ = std::move(always);
  server_.broadcast(description_);
  lay_out();
}

void Audience::hear() {
  using Kind = Server::Event::Kind;
  bool wishes_changed = false;
  for (Server::Event& event : server_.take_events()) {
    if (event.kind == Kind::joined) {
      ++joined_;
      wishes_[event.client];
      server_.send(event.client, description_);
      server_.send(event.client, layout_.text());
    } else if (event.kind == Kind::left) {
      wishes_changed = wishes_.erase(event.client) > 0 || wishes_changed;
    } else {
      heard_.push_back(std::move(event));
    }
  }
  if (wishes_changed) lay_out();
}

std::optional<PageRequest> Audience::next() {
  while (!heard_.empty()) {
    const Server::Event event = std::move(heard_.front());
    heard_.pop_front();
    Request message = parse_request(event.text);
    if (!message.command) {
      refuse(event.client, message.id, message.problem);
      continue;
    }
    std::optional<PageRequest> request;
    std::visit(
        [&](auto& command) {
          if constexpr (requires { answer_own(event.client, *message.id, command); })
            answer_own(event.client, *message.id, command);
          else
            request = {event.client, *message.id, std::move(command)};
        },
        *message.command);
    if (request) return request;
  }
  return std::nullopt;
}

void Audience::answer(const PageRequest& request, const std::function<void(JsonWriter&)>& members) {
  JsonWriter json = begin_answer(request.id);
  members(json);
  server_.send(request.client, json.end_object().text());
}

void Audience::refuse(const PageRequest& request, const std::string& problem) {
  refuse(request.client, request.id, problem);
}

void Audience::refuse(Server::ClientId client, std::optional<std::int64_t> id,
                      const std::string& problem) {
  JsonWriter json;
  json.begin_object();
  if (id) json.member("id", *id);
  server_.send(client, json.member("error", problem).end_object().text());
}

void Audience::answer_trace(const PageRequest& request, std::string bytes) {
  server_.send_binary(request.client, std::move(bytes));
}

void Audience::answer_own(Server::ClientId client, std::int64_t id, const ReadPorts& request) {
  std::vector<Port> found;
  for (const std::string& trail : request.trails) {
    auto port = begin_port(*experiment_, ports_, trail);
    if (!port) return refuse(client, id, "there is no port `" + trail + "`");
    found.push_back(std::move(*port));
  }
  JsonWriter json = begin_answer(id);
  json.key("values").begin_array();
  for (std::size_t i = 0; i < found.size(); ++i)
    json.begin_object()
        .member("trail", request.trails[i])
        .member("value", *found[i].value)
        .member("unit", found[i].unit)
        .end_object();
  server_.send(client, json.end_array().end_object().text());
}

void Audience::answer_own(Server::ClientId client, std::int64_t id, const ListPorts& request) {
  const std::string world = experiment_->world + ".";
  JsonWriter json = begin_answer(id);
  json.key("ports").begin_array();
  std::set<std::string_view> listed;
  for (const Port& port : ports_) {
    const std::string_view trail = port.trail;
    // A value that the engine computes hides the one that the file gave it.
    if (!listed.insert(trail).second) continue;
    const bool inside = trail.starts_with(world);
    if (!simulation::glob_fits(request.pattern, trail) &&
        !(inside && simulation::glob_fits(request.pattern, trail.substr(world.size()))))
      continue;
    json.begin_object()
        .member("trail", port.trail)
        .member("unit", port.unit)
        .member("writable", port.writable != nullptr)
        .member("minimum", port.minimum)
        .member("maximum", port.maximum)
        .member("doc", port.doc)
        .end_object();
  }
  server_.send(client, json.end_array().end_object().text());
}

void Audience::answer_own(Server::ClientId client, std::int64_t id, const WatchPorts& request) {
  const auto there = wishes_.find(client);
  if (there == wishes_.end()) return;
  std::vector<std::string>& wish = there->second;
  JsonWriter json = begin_answer(id);
  server_.send(client, json.end_object().text());
  if (wish == request.trails) return;
  wish = request.trails;
  lay_out();
}

void Audience::lay_out() {
  std::vector<std::string> trails = always_;
  for (const auto& [client, wish] : wishes_)
    for (const std::string& trail : wish)
      if (std::ranges::find(trails, trail) == trails.end()) trails.push_back(trail);
  layout_.lay_out(std::move(trails), *experiment_, ports_);
  server_.broadcast(layout_.text());
}

void Audience::tell_notice(std::string_view level, const std::string& text) {
  server_.broadcast(notice_text(level, text));
}

void Audience::tell_changed(std::int64_t step, double time, const std::string& trail,
                            const std::string& value) {
  JsonWriter json;
  json.begin_object().member("tell", "changed").member("step", step).member("time", time);
  json.member("trail", trail).member("value", value);
  server_.broadcast(json.end_object().text());
}

void Audience::tell_progress(std::string_view work, double done) {
  JsonWriter json;
  json.begin_object().member("tell", "working").member("of", work).member("done", done);
  server_.broadcast(json.end_object().text());
}

void Audience::tell_ended(const std::string& reason) {
  JsonWriter json;
  json.begin_object().member("tell", "ended").member("reason", reason);
  server_.broadcast(json.end_object().text());
}

void Audience::publish(SessionState state, std::span<const SubjectState> subjects) {
  state.layout = layout_.number();
  server_.publish(encode_snapshot(state, layout_.read(), subjects));
}

}  // namespace hookpoint::view
