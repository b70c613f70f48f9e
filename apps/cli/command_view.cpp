// view, and run --view: the windows that a file describes, in a browser.
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include <utility>

#include "apps/cli/commands.h"
#include "apps/cli/exit_status.h"
#include "apps/cli/interrupt.h"
#include "apps/cli/open_browser.h"
#include "apps/cli/run_loop.h"
#include "apps/shared/live_loader.h"
#include "apps/shared/subject_meter.h"
#include "apps/shared/subject_words.h"
#include "apps/view/page_bundle.h"
#include "apps/view/session/description.h"
#include "apps/view/session/live_session.h"
#include "apps/view/widgets/ghosts.h"
#include "apps/view/widgets/overview.h"
#include "output/figures/plot.h"
#include "simulation/engine_interface/step_count.h"
#include "text/display.h"

namespace hookpoint::cli {
namespace {

using application::LiveLoader;
using simulation::LiveRun;

/// Moments are kept 50 times a simulated second, and not more often than every tenth step, of the
/// last five minutes.
view::History history_of(const simulation::Experiment& experiment) {
  constexpr double between = 0.02;
  return view::History(std::max<std::int64_t>(
      10, simulation::step_count(std::min(between, experiment.duration), experiment.deltat)));
}

/// What is wrong with the file, as the loader tells it.
struct WrongFile {
  std::string problem;
};

/// What is watched, and what it is made from, which must live as long.
class Watched {
 public:
  explicit Watched(const RunArguments& arguments)
      : arguments_(arguments), settings_(arguments.settings), application_(arguments.consent) {
    if (arguments.duration) settings_.world.emplace_back("duration", *arguments.duration);
    simulation::LiveRunRequest request;
    request.folder = arguments.out.value_or(std::filesystem::path());
    request.trails = arguments.record;
    request.leaves_files = arguments.out.has_value();
    add("", "", settings_, request, arguments.movie);
    for (const view::GhostSpec& ghost : view::load_ghosts(loaders_.front()->root())) {
      if (ghost.settings.empty()) {
        subjects_.front().name = ghost.label;
        if (!ghost.colour.empty()) subjects_.front().colour = ghost.colour;
        continue;
      }
      application::Settings own = settings_;
      own.trails.insert(own.trails.end(), ghost.settings.begin(), ghost.settings.end());
      add(ghost.label, ghost.colour, own, {}, std::nullopt);
    }
    for (const std::string& words : arguments.view.with) {
      application::Settings own = settings_;
      for (auto& field : application::subject_fields(application_.schema(), words))
        own.world.push_back(std::move(field));
      add(words, "", own, {}, std::nullopt);
    }
    view::MakeMeter meters;
    if (subjects_.size() > 1)
      meters = [this](const simulation::Experiment& experiment, const view::Tally& behind) {
        return application::make_meter(experiment, application_.engines(), behind);
      };
    all_ = std::make_unique<view::Subjects>(std::move(subjects_), std::move(meters));
  }

  view::Subjects& subjects() { return *all_; }

  const language::Object& root() const { return loaders_.front()->root(); }
  std::vector<view::FileField> fields() const { return view::file_fields(root()); }

  /// The experiment with what was changed, as a file of its own, its name and its text.
  std::optional<std::pair<std::string, std::string>> patch(const LiveRun& run,
                                                           std::string& problem) const {
    std::map<std::string, std::string> latest;
    for (const simulation::Change& change : run.changes()) latest[change.trail] = change.value;
    // A pull and the like are of the window, not of the file.
    std::erase_if(latest,
                  [](const auto& change) { return change.first.starts_with("Simulator."); });
    std::vector<std::string> settings;
    // What the run started from by hand is a field too, where the file states the pose by fields.
    constexpr std::string_view start = "start:";
    for (const auto& [trail, value] : latest)
      settings.push_back(trail.substr(trail.starts_with(start) ? start.size() : 0) + "=" + value);
    std::string left_out;
    // With the step of the run, not one for what was changed.
    LiveLoader loader(arguments_.file, settings_, arguments_.consent, std::nullopt,
                      loaders_.front().get());
    auto changed = loader.load(settings, problem);
    if (!changed) {
      // Not every port is a field: those that are none are left out.
      std::erase_if(settings, [&](const std::string& setting) {
        if (loader.load({setting}, problem)) return false;
        if (latest.contains(std::string(start) + setting.substr(0, setting.find('='))))
          left_out += "//   " + setting + "\n";
        return true;
      });
      changed = loader.load(settings, problem);
    }
    if (!changed) return std::nullopt;
    std::string text =
        "// " + text::printable(arguments_.file.filename().string()) + " with what was changed:\n";
    for (const std::string& setting : settings) text += "//   " + setting + "\n";
    if (!left_out.empty())
      text += "// without the pose that it was started from, which the file states otherwise:\n" +
              left_out;
    text += changed->text;
    return std::pair(arguments_.file.stem().string() + "-changed.hook", std::move(text));
  }

  view::Shown show(view::Subjects& subjects) const {
    const language::Object& root = loaders_.front()->root();
    language::Diagnostics diagnostics;
    const std::vector<simulation::Port> ports = subjects.ports();
    const view::Panel panel =
        view::make_panel(root, subjects.run().experiment(), ports, diagnostics);
    application_.tell(diagnostics);
    view::Shown shown;
    shown.holds = root.children_of("World").front()->given("duration") && !arguments_.duration;
    shown.description = view::describe(view::Kind::run, arguments_.file.filename().string(), panel,
                                       subjects, ports, shown.holds);
    shown.trails = view::ports_of(panel);
    shown.plotted = panel.windows.empty() ? view::overview_of(subjects.run().experiment())
                                          : view::plotted_of(panel);
    for (std::string& trail : subjects.displacements()) shown.plotted.push_back(std::move(trail));
    shown.sliders = view::slider_paths(panel, subjects.run().experiment());
    for (const std::string& source : language::sources_of(root)) shown.sources.emplace_back(source);
    return shown;
  }

 private:
  void add(const std::string& label, const std::string& colour, application::Settings settings,
           simulation::LiveRunRequest request, const std::optional<std::filesystem::path>& movie) {
    // All are stepped together: those beside the run take the step that was chosen for it.
    const LiveLoader* leader = loaders_.empty() ? nullptr : loaders_.front().get();
    loaders_.push_back(std::make_unique<LiveLoader>(arguments_.file, std::move(settings),
                                                    arguments_.consent, movie, leader));
    LiveLoader& loader = *loaders_.back();
    std::string problem;
    const simulation::LoadedExperiment* first = loader.load_first(problem);
    if (first == nullptr) throw WrongFile{problem};
    if (subjects_.empty() && request.folder.empty())
      request.folder = std::filesystem::path("runs") / first->experiment.world;
    auto run = std::make_unique<LiveRun>(
        [&loader](const std::vector<std::string>& overrides, std::string& why) {
          return loader.load(overrides, why);
        },
        request);
    const simulation::Experiment& experiment = run->experiment();
    const int index = static_cast<int>(subjects_.size());
    view::Subject subject{label.empty() ? application::subject_name(experiment) : label,
                          colour.empty() ? output::series_style(index).color : colour,
                          std::move(run), history_of(experiment), nullptr};
    subjects_.push_back(std::move(subject));
  }

  const RunArguments& arguments_;
  application::Settings settings_;  ///< of the command line
  application::Application application_;
  std::vector<std::unique_ptr<LiveLoader>> loaders_;
  std::vector<view::Subject> subjects_;
  std::unique_ptr<view::Subjects> all_;
};

/// A file that says how long, or that is to leave files, ends then; any other goes on until
/// somebody has seen enough.
std::optional<std::int64_t> last_step(const RunArguments& arguments, const LiveRun& run) {
  const std::vector<std::string> names = run.names();
  const bool writes = std::ranges::any_of(
      names, [](const std::string& name) { return name != simulation::ChangeLog::file_name; });
  if (!writes && !arguments.duration) return std::nullopt;
  return run.last_step();
}

}  // namespace

int view(const RunArguments& arguments) {
  try {
    const InterruptGuard guard;
    Watched watched(arguments);
    LiveRun& run = watched.subjects().run();
    tell_unread(watched.root(), run.experiment());
    tell_stability(run.experiment());
    view::Server server({arguments.view.bind, arguments.view.port,
                         arguments.view.token.value_or(view::fresh_token())},
                        page_bundle::index_html);
    view::Audience audience(server);
    view::LiveSessionRequest request;
    request.describe = [&](view::Subjects& subjects) { return watched.show(subjects); };
    request.fields = [&] { return watched.fields(); };
    request.patch = [&](const LiveRun& changed, std::string& problem) {
      return watched.patch(changed, problem);
    };
    request.last_step = [&](const LiveRun& now) { return last_step(arguments, now); };
    view::LiveSession session(watched.subjects(), audience, std::move(request));
    std::cout << server.url() << std::endl;
    if (arguments.view.open) open_browser(server.url());
    const bool fine_to_the_end = session.run(guard.stop());
    run.close();
    tell_files(run.folder(), run.names());
    return fine_to_the_end ? fine : truth_failed;
  } catch (const WrongFile& file) {
    std::cerr << file.problem << '\n';
  } catch (const simulation::ExperimentError& error) {
    application::print_error(error.what());
  } catch (const application::SubjectError& error) {
    application::print_error(error.what());
  } catch (const view::ServerError& error) {
    application::print_error(error.what());
  }
  return wrong_input;
}

}  // namespace hookpoint::cli
