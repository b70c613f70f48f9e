// What a page receives of a run once: its windows, its scene, its subjects.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "apps/view/session/film.h"
#include "apps/view/session/subjects.h"
#include "apps/view/widgets/panel.h"

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
  bool holds = true;  ///< playing waits at the duration
};

/// The "description" of docs/view_protocol.md. `title`: of the window.
std::string describe(Kind kind, const std::string& title, const Panel& panel,
                     const Described& described);
/// Of a live run; `ports`: all of it; `holds`: Described::holds.
std::string describe(Kind kind, const std::string& title, const Panel& panel,
                     const Subjects& subjects, const std::vector<simulation::Port>& ports,
                     bool holds);

}  // namespace hookpoint::view
