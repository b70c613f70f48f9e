// Makes a film: gives a page one moment after the other, and writes what it makes of them.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include "apps/view/session/film.h"
#include "apps/view/session/reel.h"
#include "apps/view/session/shown.h"
#include "apps/view/wire/audience.h"

namespace hookpoint::view {

struct FilmSessionRequest {
  Film film;
  std::function<Shown(const std::vector<simulation::Port>&)> describe;
  /// Called now and then: why the page is gone, or "" while it is there.
  std::function<std::string()> lost;
  /// Called with each picture that is done.
  std::function<void()> advance;
};

class FilmSession {
 public:
  /// All outlive it.
  FilmSession(const ShownMovie& movie, Audience& audience, FilmSessionRequest request);

  /// Until the film is complete, or `stop`; whether it is complete. Throws DrawingError,
  /// output::MovieError, output::FileError.
  bool run(const std::atomic<bool>& stop);

 private:
  using Clock = Reel::Clock;

  void show();
  void look_after_page();
  void carry_out(const PageRequest& request);
  void carry_out(const PageRequest& request, const AskFrame& command);
  void carry_out(const PageRequest& request, const FilmPart& command);
  void carry_out(const PageRequest& request, const FilmEnd& command);
  void carry_out(const PageRequest& request, const FilmFailed& command);
  std::size_t files() const;

  const ShownMovie movie_;
  Audience& audience_;
  FilmSessionRequest request_;
  Reel reel_;
  std::uint64_t generation_ = 0;
  std::int64_t snapshots_ = 0;
  std::size_t frames_ = 0, file_ = 0;  ///< that were shown; that is being written
  std::unique_ptr<FilmFile> writing_;
  Clock::time_point heard_;
};

}  // namespace hookpoint::view
