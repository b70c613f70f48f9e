#include "apps/view/session/film_session.h"

#include <fmt/format.h>

#include <utility>

namespace hookpoint::view {
namespace {

using namespace std::chrono_literals;

constexpr auto between_looks = 200ms;
/// A page that says nothing for so long draws nothing any more.
constexpr auto patience = 120s;

}  // namespace

FilmSession::FilmSession(const ShownMovie& movie, Audience& audience, FilmSessionRequest request)
    : movie_(movie), audience_(audience), request_(std::move(request)), reel_(movie) {
  show();
}

void FilmSession::show() {
  generation_ = reel_.generation();
  const std::vector<simulation::Port> ports = reel_.world().ports();
  Shown shown = request_.describe(ports);
  audience_.show(std::move(shown.description), movie_.experiment, ports, std::move(shown.trails));
}

/// A picture is a file; a video is one.
std::size_t FilmSession::files() const {
  return request_.film.format == FilmFormat::png ? request_.film.steps.size() : 1;
}

bool FilmSession::run(const std::atomic<bool>& stop) {
  heard_ = Clock::now();
  while (!stop && file_ < files()) {
    audience_.hear();
    while (const std::optional<PageRequest> request = audience_.next()) {
      heard_ = Clock::now();
      carry_out(*request);
    }
    look_after_page();
    if (file_ < files()) audience_.wait(Clock::now() + between_looks);
  }
  if (file_ == files()) audience_.tell_ended("the film is complete");
  return file_ == files();
}

void FilmSession::look_after_page() {
  if (const std::string lost = request_.lost(); !lost.empty()) throw DrawingError(lost);
  if (Clock::now() - heard_ > patience)
    throw DrawingError(audience_.joined() == 0 ? "the browser did not open the page"
                                               : "the browser has stopped drawing");
}

void FilmSession::carry_out(const PageRequest& request) {
  std::visit(
      [&](const auto& command) {
        if constexpr (requires { carry_out(request, command); })
          carry_out(request, command);
        else
          audience_.refuse(request, "this page only makes a film");
      },
      request.command);
}

/// Pictures go forwards, so that little is computed twice.
void FilmSession::carry_out(const PageRequest& request, const AskFrame& command) {
  if (command.index >= request_.film.steps.size())
    return audience_.refuse(request,
                            fmt::format("the film has {} pictures", request_.film.steps.size()));
  reel_.aim(request_.film.steps[command.index]);
  if (generation_ != reel_.generation()) show();
  while (!reel_.there()) reel_.go_on();
  SessionState state;
  state.number = ++snapshots_;
  state.paused = true;
  state.history_first = static_cast<double>(reel_.first()) * movie_.experiment.deltat;
  state.history_last = static_cast<double>(reel_.last()) * movie_.experiment.deltat;
  audience_.answer(request, [&](text::JsonWriter& json) {
    json.member("snapshot", state.number).member("time", reel_.time());
  });
  reel_.publish(audience_, state);
  for (; frames_ <= command.index; ++frames_) request_.advance();
}

void FilmSession::carry_out(const PageRequest& request, const FilmPart& command) {
  if (command.file != file_ || command.file >= files())
    return audience_.refuse(request, "files are written one after the other");
  if (!writing_) writing_ = std::make_unique<FilmFile>(picture_file(request_.film, command.file));
  writing_->write_at(command.at, command.bytes);
  audience_.answer(request);
}

void FilmSession::carry_out(const PageRequest& request, const FilmEnd& command) {
  if (command.file != file_ || !writing_)
    return audience_.refuse(request, "nothing has been written of that file");
  writing_->complete();
  writing_.reset();
  ++file_;
  audience_.answer(request);
}

void FilmSession::carry_out(const PageRequest& /*request*/, const FilmFailed& command) {
  throw DrawingError("the browser cannot make the film: " + command.text);
}

}  // namespace hookpoint::view
