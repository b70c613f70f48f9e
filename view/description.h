// What a page is told of a run once: its windows, its scene, its subjects.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "view/film.h"
#include "view/panel.h"
#include "view/subjects.h"

namespace hookpoint::view {

enum class Kind { run, movie, film };

/// What is shown, of whatever kind.
struct Described {
  const simulation::Experiment& experiment;
  std::string no_history;  ///< why one cannot go back, "" if one can
  std::vector<std::pair<std::string, std::string>> subjects;  ///< name and colour
  /// What a drag begins with; zeros where nothing can be dragged.
  struct {
    double stiffness = 0.;  ///< [N/m]
    double damping = 0.;    ///< [N s/m]
  } pull{};
  const Film* film = nullptr;
};

/// The "description" of docs/view_protocol.md. `title`: of the window.
std::string describe(Kind kind, const std::string& title, const Panel& panel,
                     const Described& described);
/// Of a live run; `ports`: all of it.
std::string describe(Kind kind, const std::string& title, const Panel& panel,
                     const Subjects& subjects, const std::vector<simulation::Port>& ports);

}  // namespace hookpoint::view
