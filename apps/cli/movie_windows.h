// A movie in the windows of its experiment, for who shows it and who films it.
#pragma once

#include <string>
#include <vector>

#include "apps/cli/opened_movie.h"
#include "apps/view/session/film.h"
#include "apps/view/session/reel.h"
#include "apps/view/session/shown.h"

namespace hookpoint::cli {

class MovieWindows {
 public:
  /// Throws output::MovieError.
  MovieWindows(const std::filesystem::path& file, application::Consent consent);

  const simulation::Experiment& experiment() const { return experiment_; }
  /// It refers to this.
  view::ShownMovie movie();
  /// Of a world with these ports; as a film where there is one.
  view::Shown show(const std::vector<simulation::Port>& ports, const view::Film* film = nullptr);
  /// Trails of the cameras. A file without windows has one, "camera".
  std::vector<std::string> cameras();

 private:
  OpenedMovie opened_;
  simulation::Experiment experiment_;
  std::string title_;
};

}  // namespace hookpoint::cli
