#include "apps/cli/movie_windows.h"

#include "apps/shared/subject_words.h"
#include "apps/view/session/description.h"
#include "apps/view/widgets/overview.h"
#include "output/figures/plot.h"

namespace hookpoint::cli {
namespace {

void collect_cameras(const std::vector<view::Widget>& widgets, std::vector<std::string>& trails) {
  for (const view::Widget& widget : widgets) {
    if (std::holds_alternative<view::Camera>(widget.content)) trails.push_back(widget.trail);
    if (const auto* frame = std::get_if<view::Frame>(&widget.content))
      collect_cameras(frame->children, trails);
  }
}

}  // namespace

MovieWindows::MovieWindows(const std::filesystem::path& file, application::Consent consent)
    : opened_(file, consent), experiment_(opened_.load()), title_(file.filename().string()) {}

view::ShownMovie MovieWindows::movie() {
  return {experiment_, opened_.reader(),
          // Made in its place: a world cannot be moved.
          [this] {
            return std::unique_ptr<simulation::World>(
                new simulation::World(opened_.make_world(experiment_)));
          }};
}

view::Shown MovieWindows::show(const std::vector<simulation::Port>& ports, const view::Film* film) {
  language::Diagnostics diagnostics;
  const view::Panel panel = view::make_panel(opened_.root(), experiment_, ports, diagnostics);
  const view::Kind kind = film == nullptr ? view::Kind::movie : view::Kind::film;
  view::Shown shown;
  shown.description =
      view::describe(kind, title_, panel,
                     {experiment_,
                      "",
                      {{application::subject_name(experiment_), output::series_style(0).color}},
                      {},
                      film});
  shown.trails = view::ports_of(panel);
  shown.plotted = panel.windows.empty() ? view::overview_of(experiment_) : view::plotted_of(panel);
  return shown;
}

std::vector<std::string> MovieWindows::cameras() {
  language::Diagnostics diagnostics;
  const view::Panel panel = view::make_panel(opened_.root(), experiment_,
                                             opened_.make_world(experiment_).ports(), diagnostics);
  std::vector<std::string> trails;
  collect_cameras(panel.windows, trails);
  if (trails.empty()) trails.emplace_back("camera");
  return trails;
}

}  // namespace hookpoint::cli
