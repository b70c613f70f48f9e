// The commands, one file each: plain arguments in, exit status out. main.cpp fills the arguments
// from the command line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/shared/consent.h"
#include "apps/shared/exported.h"
#include "apps/shared/settings.h"
#include "apps/shared/task_arguments.h"
#include "apps/shared/task_file.h"
#include "apps/shared/translated.h"

namespace hookpoint::cli {

/// How a window is served (docs/view.md).
struct ViewArguments {
  std::string bind = "127.0.0.1";    ///< address
  std::uint16_t port = 0;            ///< 0: a free one
  std::optional<std::string> token;  ///< of the address; none: a fresh one
  bool open = true;                  ///< in the desktop's browser, where there is one
  std::vector<std::string> with;     ///< subjects beside the run (apps/shared/subject_words.h)
};

struct RunArguments {
  std::filesystem::path file;
  application::Settings settings;
  std::optional<std::string> duration;  ///< "10 s"
  std::optional<std::filesystem::path> out;
  std::vector<std::string> record;               ///< trails, vectors, globs
  std::optional<std::filesystem::path> movie;    ///< --movie; empty: movie.h5 in the run's folder
  std::optional<std::filesystem::path> resume;   ///< a movie to go on from, instead of `file`
  std::optional<std::string> at;                 ///< moment of it; none: its last
  std::optional<std::filesystem::path> changes;  ///< changes.csv of a run that is repeated
  application::Consent consent;                  ///< of any folder; here and below: see Application
  bool viewed = false;                           ///< --view
  ViewArguments view;
};
int run(const RunArguments& arguments);
/// view, and run --view: the windows that the file describes, in a browser.
int view(const RunArguments& arguments);
/// run --resume: continues from a time of a movie.
int resume(const RunArguments& arguments);

/// replay --film.
struct FilmArguments {
  std::filesystem::path file;         ///< empty: no film
  std::optional<std::string> camera;  ///< trail; none: the first
  std::string size = "1280x720";
  std::string quality = "high";
  std::string caption;  ///< before the time
  bool bare = false;    ///< neither caption nor time
};

/// Which moments of a movie a film or a page has.
struct MoviePart {
  std::optional<std::string> rate;      ///< pictures a second; none: 30
  std::optional<std::string> from, to;  ///< "2.5 s"; none: all of the movie
  bool given() const { return rate || from || to; }
};

struct ReplayArguments {
  std::filesystem::path movie;
  std::optional<std::string> at;    ///< "2.5 s"; none: all of it
  std::vector<std::string> record;  ///< trails, vectors, globs; none: a summary, as JSON all
  std::filesystem::path page;       ///< --html; empty: no page
  MoviePart part;                   ///< of --film and --html
  bool json = false;
  bool about = false;
  application::Consent consent;
  ViewArguments view;
  FilmArguments film;
};
/// replay: a movie in the window, what it is, a moment of it, a film of it, or a page with it.
int replay(const ReplayArguments& arguments);
int film(const ReplayArguments& arguments);
/// replay --html.
int write_page(const ReplayArguments& arguments);

/// recover: the record that a killed run left as a spool.
int recover(const std::filesystem::path& spool);

/// study and tune; with `view` the tables of studies fill in a browser meanwhile
/// (apps/cli/study_view.h).
int run_tasks(const application::TaskCommand& command, const application::TaskArguments& arguments,
              const std::optional<ViewArguments>& view = {});

/// The same in an application that knows the file, which `arguments.file` names.
int run_tasks(application::Application& application, const application::TaskCommand& command,
              application::TaskArguments arguments, const std::optional<ViewArguments>& view = {});

struct FixtureArguments {
  std::vector<std::string> subjects;             ///< none: all that are found
  std::optional<std::filesystem::path> engines;  ///< a file of Engine blocks
  application::TaskArguments tasks;
};
/// fixture run: scores of the engines in scenes with closed forms.
int run_fixture(const FixtureArguments& arguments);
/// fixture export: the same scenes for whoever has no hookpoint.
int export_fixture(const std::filesystem::path& folder);

struct RunsArguments {
  std::filesystem::path list, journal;
  int jobs = 1;
};
/// runs: those of a list that --slurm wrote, into a journal.
int runs(const RunsArguments& arguments);

/// check: every file's diagnostics.
int check(const std::vector<std::filesystem::path>& files, application::Consent consent);
/// fmt: rewrites each file in canonical layout; with `check_only` says which would change.
int format(const std::vector<std::filesystem::path>& files, bool check_only);
/// print: the experiment after includes, loops and expressions.
int print(const std::filesystem::path& file, const application::Settings& settings,
          application::Consent consent);
struct DescribeArguments {
  std::optional<std::string> type;             ///< a class; none: the list of all
  bool markdown = false;                       ///< the manual's reference page
  bool textmate = false;                       ///< the grammar for editors
  bool man = false;                            ///< the command's own manual page
  std::optional<std::string> completion;       ///< of its words, in this shell
  std::vector<std::filesystem::path> plugins;  ///< whose classes count too
  application::Consent consent;
};
int describe(const DescribeArguments& arguments);

/// dynamics: what the forces do at the file's initial state.
int dynamics(const std::filesystem::path& file, const application::Settings& settings, bool json,
             application::Consent consent);

struct PortsArguments {
  std::filesystem::path file;
  std::optional<std::string> pattern;  ///< trail, vector or glob; none: all that changes
  application::Settings settings;
  bool json = false;
  application::Consent consent;
};
/// ports: what can be recorded, wired and expected of a world.
int ports(const PortsArguments& arguments);

struct AdviseArguments {
  std::filesystem::path file;
  application::Settings settings;
  std::optional<std::string> penetration;  ///< at rest, "1 mm"
  std::optional<std::string> rebound;      ///< speed after over before, "0.2"
  bool json = false;
  application::Consent consent;
};
/// advise: the ground's constants from what the user wants of it.
int advise(const AdviseArguments& arguments);

struct TranslateArguments {
  application::TranslateRequest request;
  application::Consent consent;
  bool parameters = false;  ///< only the manual's page of parameters
  bool json = false;
};
/// translate: contact constants as parameters of other engines, and back.
int translate(TranslateArguments arguments);

struct ExportArguments {
  application::ExportRequest request;
  std::filesystem::path out;  ///< empty: standard output
};
/// export: robots, ground and contact as a model of another program.
int export_model(const ExportArguments& arguments);

struct CompareArguments {
  std::filesystem::path first, second;  ///< folders that runs or studies left
  double tolerance = 1e-9;              ///< relative (studies/compare/comparison.h)
  bool json = false;
};
/// compare: what differs between two runs.
int compare(const CompareArguments& arguments);

struct NewArguments {
  std::string kind;  ///< robot, study, controller
  std::string name;
};
/// new: a commented file to begin with, NAME.hook.
int new_file(const NewArguments& arguments);

/// cite: BibTeX entries of the program and, with a folder of results, of what these were made with.
int cite(const std::optional<std::filesystem::path>& folder);

struct EnginesArguments {
  std::optional<std::filesystem::path> file;  ///< whose engines are listed too
  bool json = false;
  application::Consent consent;
};
/// engines: every engine, law and integrator.
int engines(const EnginesArguments& arguments);
/// engine-check: whether the program that `command` starts does as an engine must.
int engine_check(const std::vector<std::string>& command);
/// --version: the program's, then a line an engine that was found.
std::string version_text();

/// What FILE.hook without a command means: the command whose tasks it holds, "study" before "tune",
/// or "run" for a world; none when it has errors, which are printed. Anything else is for the command
/// to tell.
std::optional<std::string> command_for(const std::filesystem::path& file,
                                       const application::Settings& settings,
                                       application::Consent consent);

}  // namespace hookpoint::cli
