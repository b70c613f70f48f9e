#include "apps/view/session/movie_traces.h"

#include <algorithm>
#include <limits>

#include "simulation/wiring/ports.h"

namespace hookpoint::view {

void MovieTraces::want(const std::vector<std::string>& trails,
                       const std::function<bool(const std::string& trail)>& is_port) {
  for (const std::string& trail : trails)
    if (pass_of(trail) == nullptr && !is_waiting(trail) && columns() < Traces::most_columns &&
        is_port(trail))
      waiting_.push_back(trail);
}

bool MovieTraces::is_waiting(const std::string& trail) const {
  return std::ranges::find(waiting_, trail) != waiting_.end();
}

std::size_t MovieTraces::columns() const {
  std::size_t count = waiting_.size();
  for (const Pass& pass : passes_) count += pass.traces.trails().size();
  return count;
}

std::set<const MovieTraces::Pass*> MovieTraces::passes_of(
    const std::vector<std::string>& trails) const {
  std::set<const Pass*> passes;
  for (const std::string& trail : trails)
    if (const Pass* pass = pass_of(trail); pass != nullptr || is_waiting(trail))
      passes.insert(pass);
  return passes;
}

const MovieTraces::Pass* MovieTraces::pass_of(const std::string& trail) const {
  for (const Pass& pass : passes_)
    if (std::ranges::find(pass.traces.trails(), trail) != pass.traces.trails().end()) return &pass;
  return nullptr;
}

void MovieTraces::begin_pass() {
  Pass& pass = passes_.emplace_back();
  for (const std::string& trail : waiting_) pass.traces.add(trail);
  waiting_.clear();
  pass.reel = std::make_unique<Reel>(movie_);
  look_up(pass);
}

void MovieTraces::look_up(Pass& pass) {
  const std::vector<simulation::Port> ports = pass.reel->world().ports();
  for (const std::string& trail : pass.traces.trails()) {
    const auto port = simulation::look_up_port(movie_.experiment, ports, trail);
    if (port && port->lazy != nullptr) port->lazy->begin();
    pass.sources.push_back(port ? port->value : nullptr);
  }
}

void MovieTraces::sample(Pass& pass) {
  values_.clear();
  for (const double* source : pass.sources)
    values_.push_back(source == nullptr ? std::numeric_limits<double>::quiet_NaN() : *source);
  pass.read = pass.reel->time();
  pass.traces.sample(pass.read, values_);
}

void MovieTraces::work(Reel::Clock::time_point until) {
  while (busy() && Reel::Clock::now() < until) {
    if (!under_way()) begin_pass();
    Pass& pass = passes_.back();
    Reel& reel = *pass.reel;
    if (!reel.there()) {
      reel.go_on();
      if (!reel.there()) continue;
    }
    sample(pass);
    if (reel.step() < reel.last())
      reel.aim(reel.step() + 1);
    else
      pass.reel.reset();
  }
}

double MovieTraces::progress() const {
  if (!under_way()) return 1.;
  const Reel& reel = *passes_.back().reel;
  const auto steps = static_cast<double>(reel.last() - reel.first());
  return steps > 0. ? static_cast<double>(reel.step() - reel.first()) / steps : 0.;
}

bool MovieTraces::known(const std::vector<std::string>& trails, double time) const {
  const std::set<const Pass*> needed = passes_of(trails);
  return std::ranges::all_of(needed, [&](const Pass* pass) {
    // Several passes have the same row of instants once they are complete.
    return pass != nullptr && (pass->reel == nullptr || (needed.size() == 1 && pass->read >= time));
  });
}

Traces::Extract MovieTraces::extract(const std::vector<std::string>& trails, double from, double to,
                                     std::size_t points) const {
  const std::set<const Pass*> needed = passes_of(trails);
  const bool comparable = needed.size() == 1 || known(trails, to);
  if (needed.empty() || needed.contains(nullptr) || !comparable)
    return {{}, std::vector<std::vector<double>>(trails.size())};
  Traces::Extract all;
  for (const Pass* pass : needed) {
    Traces::Extract own = pass->traces.extract(trails, from, to, points);
    if (all.values.empty()) {
      all = std::move(own);
      continue;
    }
    for (std::size_t i = 0; i < trails.size(); ++i)
      if (pass_of(trails[i]) == pass) all.values[i] = std::move(own.values[i]);
  }
  return all;
}

}  // namespace hookpoint::view
