// What a page is told of a run once: its windows, its scene, its subjects.
#pragma once

#include <string>

#include "view/panel.h"
#include "view/subjects.h"

namespace hookpoint::view {

enum class Kind { run, movie, film };

/// The "description" of docs/view_protocol.md. `title`: of the window.
std::string describe(Kind kind, const std::string& title, const Panel& panel,
                     const Subjects& subjects);

}  // namespace hookpoint::view
