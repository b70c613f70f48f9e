// The command line: it fills plain arguments and hands them to a command. This file and the manual
// that is made from its table see CLI11.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <functional>
#include <iostream>
#include <map>
#include <new>
#include <system_error>

#include "apps/cli/commands.h"
#include "apps/cli/exit_status.h"
#include "apps/cli/manual_page.h"
#include "apps/cli/standard_streams.h"
#include "apps/shared/application.h"
#include "apps/shared/short_forms.h"
#include "language/names.h"
#include "output/files/file.h"
#include "output/files/result_folder.h"
#include "text/formats.h"

namespace hookpoint::cli {
namespace {

std::string about() {
  std::string text =
      "hookpoint: dynamics of legged robots under comparable contact models\n"
      "`hookpoint FILE.hook` runs what the file holds: its studies, or else its world.\n"
      "Exit status:";
  for (const ExitMeaning& exit : exit_meanings)
    text += (exit.status == fine ? " " : ", ") + std::to_string(exit.status) + " " + exit.meaning;
  return text + ".";
}

/// What the command line asks for; `command` runs it.
struct Request {
  RunArguments run;
  application::TaskArguments tasks;
  RunsArguments runs;
  ReplayArguments replay;
  AdviseArguments advise;
  CompareArguments compare;
  TranslateArguments translate;
  ExportArguments export_;
  FixtureArguments fixture;
  std::vector<std::filesystem::path> files;
  std::filesystem::path file;
  application::Settings settings;
  DescribeArguments describe;
  PortsArguments ports;
  EnginesArguments engines;
  NewArguments new_;
  std::optional<std::filesystem::path> folder;
  std::vector<std::string> words;
  bool json = false, check_only = false;
  application::Consent consent;
  std::function<int()> command;
};

CLI::App* add_command(CLI::App& app, Request& request, const char* name, const char* doc,
                      std::function<int()> command) {
  CLI::App* added = app.add_subcommand(name, doc);
  added->callback([&request, command = std::move(command)] { request.command = command; });
  return added;
}

void add_trails(CLI::App* command, application::Settings& settings) {
  command
      ->add_option("--set", settings.trails,
                   "overrides a field or a Param, e.g. SimpleWorld.deltat=\"1 ms\" (may be "
                   "repeated)")
      ->type_name("TRAIL=VALUE")
      ->expected(1)
      ->take_all()
      ->check([](const std::string& text) {
        return text.find('=') == std::string::npos ? "--set takes TRAIL=VALUE, not `" + text + "`"
                                                   : std::string();
      });
}

void add_short_form(CLI::App* command, application::Settings& settings,
                    const application::ShortForm& form) {
  command
      ->add_option_function<std::string>(
          form.option,
          [&settings, field = form.field](const std::string& value) {
            settings.world.emplace_back(field, value);
          },
          form.doc)
      ->type_name(form.type);
}

void add_settings(CLI::App* command, application::Settings& settings) {
  add_trails(command, settings);
  for (const application::ShortForm& form : application::short_forms)
    add_short_form(command, settings, form);
}

void add_consent(CLI::App* command, application::Consent& consent) {
  command->add_flag(application::plugin_trust.option, consent.plugins,
                    "run the code of any plugin that the file names, not only of those in "
                    "HOOKPOINT_TRUSTED_PLUGINS");
  command->add_flag(application::engine_trust.option, consent.engines,
                    "start the program of any engine that the file names, not only of those in "
                    "HOOKPOINT_TRUSTED_ENGINES");
}

/// Checks for one of `words`.
std::function<std::string(const std::string&)> is_one_of(const std::string& what,
                                                         const std::vector<std::string>& words) {
  return [what, words](const std::string& text) {
    return std::ranges::count(words, text) > 0
               ? std::string()
               : fmt::format("{} is one of {}, not `{}`", what, fmt::join(words, ", "), text);
  };
}

void add_movie_option(CLI::App* command, RunArguments& arguments) {
  command
      ->add_option("--movie", arguments.movie,
                   "log the whole state of each step (default: DIR/movie.h5)")
      ->type_name("[FILE.h5]")
      ->expected(0, 1);
}

void add_movies(CLI::App* run_app, RunArguments& arguments) {
  add_movie_option(run_app, arguments);
  run_app
      ->add_option("--resume", arguments.resume,
                   "go on from a moment of this movie, for as long as --for says")
      ->type_name("MOVIE");
  run_app->add_option("--at", arguments.at, "which moment: \"2.5 s\" (default: the movie's last)")
      ->type_name("TIME");
}

void add_serving(CLI::App* command, ViewArguments& arguments) {
  command->add_option("--port", arguments.port, "of the window's address (default: a free one)")
      ->type_name("N")
      ->check([](const std::string& text) {
        int value = -1;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool number = error == std::errc{} && end == text.data() + text.size();
        return number && value >= 0 && value <= 65535
                   ? std::string()
                   : "--port takes a whole number from 0 to 65535, not `" + text + "`";
      });
  command
      ->add_option("--bind", arguments.bind,
                   "the address to listen at; 0.0.0.0: whoever has the token may watch from "
                   "anywhere (default: 127.0.0.1)")
      ->type_name("ADDRESS");
  command
      ->add_option("--token", arguments.token,
                   "of the address, so that open pages find a program that was started again "
                   "(default: a fresh one)")
      ->type_name("TEXT")
      ->check([](const std::string& text) {
        const bool plain = text.size() >= 16 && text.size() <= 128 &&
                           text.find_first_not_of(
                               "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUV"
                               "WXYZ0123456789-_") == std::string::npos;
        return plain ? std::string()
                     : "--token takes 16 to 128 letters, digits, - or _: who knows it may do what "
                       "you may";
      });
  command->add_flag("!--no-open", arguments.open, "only print the address; open no browser");
}

void add_film(CLI::App* command, FilmArguments& arguments) {
  CLI::Option* film =
      command
          ->add_option("--film", arguments.file,
                       "draw it as a video, FILE.webm or FILE.mp4, as an animated picture, "
                       "FILE.webp, or as pictures, DIR/%05d.png")
          ->type_name("FILE");
  command
      ->add_option("--camera", arguments.camera, "whose film: a Window.grob (default: the first)")
      ->type_name("TRAIL")
      ->needs(film);
  command->add_option("--size", arguments.size, "of the film's pictures (default: 1280x720)")
      ->type_name("WIDTHxHEIGHT")
      ->needs(film);
  command->add_option("--quality", arguments.quality, "of the film's pictures (default: high)")
      ->check(is_one_of("--quality", {"low", "medium", "high"}))
      ->type_name("low|medium|high")
      ->needs(film);
  command->add_option("--caption", arguments.caption, "what stands before the time in a film")
      ->type_name("TEXT")
      ->needs(film);
  command->add_flag("--bare", arguments.bare, "no caption and no time in a film")->needs(film);
}

void add_part(CLI::App* command, MoviePart& part) {
  command->add_option("--fps", part.rate, "pictures a second of a film or a page (default: 30)")
      ->type_name("N");
  command->add_option("--from", part.from, "where the film or the page begins: \"2.5 s\"")
      ->type_name("TIME");
  command->add_option("--to", part.to, "where it ends")->type_name("TIME");
}

void add_movie_tools(CLI::App& app, Request& request) {
  CLI::App* replay_app = add_command(app, request, "replay",
                                     "a run again as its movie has it: in the window, as a film",
                                     [&] { return replay(request.replay); });
  replay_app->add_option("MOVIE", request.replay.movie, "an .h5 file of run --movie")->required();
  replay_app
      ->add_option("--at", request.replay.at,
                   "only say where everything is at this moment: \"2.5 s\"")
      ->type_name("TIME");
  replay_app
      ->add_option("--record", request.replay.record,
                   "the ports that these trails name, joined by commas; globs as of `run`")
      ->type_name("TRAIL,...")
      ->delimiter(',');
  replay_app->add_flag("--json", request.replay.json, "as JSON, 17 significant digits");
  replay_app->add_flag("--about", request.replay.about, "only say what the movie is");
  add_film(replay_app, request.replay.film);
  replay_app
      ->add_option("--html", request.replay.page,
                   "write it as a page of its own, which a browser opens without the program; "
                   "--record: ports beside those of its windows")
      ->type_name("FILE");
  add_part(replay_app, request.replay.part);
  add_serving(replay_app, request.replay.view);
  add_consent(replay_app, request.replay.consent);
  add_command(app, request, "recover", "the MATLAB record of a run that was killed",
              [&] { return recover(request.file); })
      ->add_option("FILE", request.file, "NAME.mat.spool")
      ->required();
}

void add_subjects(CLI::App* command, ViewArguments& arguments) {
  command
      ->add_option("--with", arguments.with,
                   "beside it the same experiment under another engine, law or integrator, e.g. "
                   "mujoco:recommended (may be repeated)")
      ->type_name("SUBJECT")
      ->expected(1)
      ->take_all();
}

/// Checks for a whole number from 1 on, of so many digits.
std::function<std::string(const std::string&)> is_count(const std::string& option,
                                                        std::size_t digits) {
  return [option, digits](const std::string& text) {
    const bool number = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
    return number && text.size() <= digits && text.find_first_not_of('0') != std::string::npos
               ? std::string()
               : option + " takes a whole number from 1 to " + std::string(digits, '9') +
                     ", not `" + text + "`";
  };
}

/// What makes a command the front end of a cluster.
void add_slurm(CLI::App* command, application::TaskArguments& arguments) {
  CLI::Option* slurm = command->add_flag(
      "--slurm", arguments.slurm, "the runs are made by a job array of Slurm (docs/clusters.md)");
  studies::SlurmSettings& settings = arguments.slurm_settings;
  const auto add = [&](const char* option, auto& value, const char* doc, const char* type) {
    return command->add_option(option, value, doc)->type_name(type)->needs(slurm);
  };
  add("--partition", settings.partition, "of the cluster (default: its own)", "NAME");
  add("--account", settings.account, "that pays for it (default: your own)", "NAME");
  add("--time", settings.time, "most that a task may take, as sbatch takes it", "TIME");
  add("--chunk", settings.chunk, "runs of a task (default: about a hundred)", "N")
      ->check(is_count("--chunk", 6));
  add("--array-limit", settings.array_limit, "tasks at a time (default: as many as there is room)",
      "N")
      ->check(is_count("--array-limit", 6));
  command
      ->add_flag("--dry-run", arguments.dry_run,
                 "print the script that would be submitted, no more")
      ->needs(slurm);
}

void add_jobs(CLI::App* command, int& jobs) {
  command->add_option("--jobs", jobs, "threads (default: one a core)")
      ->type_name("N")
      ->check(is_count("--jobs", 4));
}

/// In what the help of commands that make many runs differs.
struct ManyRunsText {
  std::string block, folder, quick, resume;
};

/// What a paper takes of the results.
void add_publication(CLI::App* command, studies::PublicationForms& forms) {
  command->add_flag("--latex", forms.latex,
                    "tables and figures as LaTeX too, the figures as PDF: tables_and_figures.tex "
                    "compiles as it is");
  command->add_flag("--pdf", forms.pdf, "figures as PDF too");
}

/// What `study` and `tune` have in common.
void add_many_runs(CLI::App* command, application::TaskArguments& arguments,
                   const ManyRunsText& text) {
  command->add_option("FILE", arguments.file, "a .hook file with " + text.block)->required();
  add_trails(command, arguments.settings);
  add_consent(command, arguments.consent);
  command
      ->add_option("--out", arguments.out,
                   "folder of the results (default: runs/" + text.folder + "-HASH)")
      ->type_name("DIR");
  add_jobs(command, arguments.jobs);
  command->add_flag("--quick", arguments.quick, text.quick);
  command->add_flag("--resume", arguments.resume, text.resume);
  add_publication(command, arguments.forms);
  add_slurm(command, arguments);
}

/// What `run` and `view` have in common.
void add_run_options(CLI::App* run_app, RunArguments& arguments) {
  add_settings(run_app, arguments.settings);
  add_consent(run_app, arguments.consent);
  run_app
      ->add_option("--for", arguments.duration,
                   "how long: \"10 s\" (default: the World's duration)")
      ->type_name("TIME");
  run_app
      ->add_option("--out", arguments.out,
                   "folder of what the run leaves (default with --record: runs/WORLD)")
      ->type_name("DIR");
  run_app
      ->add_option("--record", arguments.record,
                   "ports to write to DIR/trace.csv, joined by commas: trails, vectors, globs (* "
                   "within a name, ** across)")
      ->type_name("TRAIL,...")
      ->delimiter(',');
}

void add_view(CLI::App& app, Request& request) {
  CLI::App* view_app =
      add_command(app, request, "view", "run a world in the windows that its file describes",
                  [&] { return view(request.run); });
  view_app->add_option("FILE", request.run.file, "a .hook file with a World, or a robot's file")
      ->required();
  add_run_options(view_app, request.run);
  view_app->get_option("--for")->description(
      "how long: \"10 s\" (default: the World's duration with --record or --movie, else until you "
      "end it)");
  add_movie_option(view_app, request.run);
  add_serving(view_app, request.run.view);
  add_subjects(view_app, request.run.view);
}

void add_run_and_study(CLI::App& app, Request& request) {
  CLI::App* run_app =
      add_command(app, request, "run", "run a world", [&] { return run(request.run); });
  run_app->add_option("FILE", request.run.file,
                      "a .hook file with a World or a robot's file, unless --resume");
  add_run_options(run_app, request.run);
  run_app->add_flag("--view", request.run.viewed, "in the windows that the file describes");
  add_serving(run_app, request.run.view);
  add_subjects(run_app, request.run.view);
  add_movies(run_app, request.run);
  run_app
      ->add_option(
          "--changes", request.run.changes,
          "repeat what a user changed while the run continued: the changes.csv that it left")
      ->type_name("FILE.csv");

  CLI::App* study_app = add_command(app, request, "study", "run the studies of a file", [&] {
    return run_tasks(application::study_command, request.tasks,
                     request.run.viewed ? std::optional(request.run.view) : std::nullopt);
  });
  add_many_runs(study_app, request.tasks,
                {"a Study", "STUDY", "the reduced size that continuous integration runs",
                 "run only the rows that an interrupted study lacks"});
  for (const application::ShortForm& form : application::short_forms)
    if (form.in_studies) add_short_form(study_app, request.tasks.settings, form);
  study_app->add_option("--only", request.tasks.only, "run only this subject (may be repeated)")
      ->type_name("SUBJECT")
      ->expected(1)
      ->take_all();
  study_app->add_flag("--view", request.run.viewed,
                      "in a browser, where table and figures fill meanwhile");
  add_serving(study_app, request.run.view);
  CLI::App* runs_app = add_command(app, request, "runs", "what a task of --slurm does",
                                   [&] { return runs(request.runs); });
  runs_app->add_option("LIST", request.runs.list, "the task's list of runs")->required();
  runs_app->add_option("--journal", request.runs.journal, "where the runs go")
      ->type_name("FILE")
      ->required();
  runs_app->add_option("--jobs", request.runs.jobs, "threads (default: 1)")
      ->type_name("N")
      ->check(is_count("--jobs", 4));
}

void add_tune(CLI::App& app, Request& request) {
  CLI::App* tune_app = add_command(
      app, request, "tune",
      "search constants for what a file's Tune blocks ask, or fit them to its Calibrate blocks",
      [&] { return run_tasks(application::tune_command, request.tasks); });
  add_many_runs(tune_app, request.tasks,
                {"a Tune or a Calibrate", "TUNE",
                 "8 candidates a generation, 3 generations, 2 seeds, a fifth of the duration, no "
                 "Sobol indices",
                 "go on with what an interrupted tuning has finished"});
}

/// What the short forms take, as the language has it.
std::map<std::string, std::vector<std::string>> words_after_options() {
  const application::Application application;
  const language::ClassSchema& world = *application.schema().find("World");
  std::map<std::string, std::vector<std::string>> words;
  for (const application::ShortForm& form : application::short_forms) {
    const std::vector<std::string>& choices = world.find(form.field)->choices;
    if (!choices.empty()) words[form.option] = choices;
  }
  return words;
}

int describe_with(const CLI::App& app, const DescribeArguments& arguments) {
  if (arguments.man) {
    std::cout << manual_page(app, HOOKPOINT_VERSION);
  } else if (arguments.completion) {
    std::cout << bash_completion(app, words_after_options());
  } else {
    return describe(arguments);
  }
  return fine;
}

void add_fixture(CLI::App& app, Request& request) {
  CLI::App* fixture_app = app.add_subcommand("fixture", "scenes with closed forms for any engine");
  fixture_app->require_subcommand(1);
  CLI::App* run_app = add_command(*fixture_app, request, "run",
                                  "run them in engines, and leave a score card in decades of error",
                                  [&] { return run_fixture(request.fixture); });
  application::TaskArguments& arguments = request.fixture.tasks;
  run_app->add_option(
      "SUBJECT", request.fixture.subjects,
      "engines, settings and laws: mujoco:recommended, lugre, bullet (default: all that "
      "are found)");
  run_app
      ->add_option("--engines", request.fixture.engines,
                   "a file of Engine blocks, whose engines may be subjects")
      ->type_name("FILE");
  run_app->add_option("--out", arguments.out, "folder of the results (default: runs/fixture-HASH)")
      ->type_name("DIR");
  add_consent(run_app, arguments.consent);
  add_jobs(run_app, arguments.jobs);
  run_app->add_flag("--resume", arguments.resume, "run only what an interrupted run lacks");
  add_publication(run_app, arguments.forms);
  add_command(*fixture_app, request, "export",
              "write them as files for other programs, with a script that judges",
              [&] { return export_fixture(request.file); })
      ->add_option("DIR", request.file, "folder that they go into")
      ->required();
}

void add_language_tools(CLI::App& app, Request& request) {
  CLI::App* check_app = add_command(app, request, "check", "report what is wrong in files",
                                    [&] { return check(request.files, request.consent); });
  check_app->add_option("FILE", request.files, ".hook files")->required();
  add_consent(check_app, request.consent);
  CLI::App* fmt = add_command(app, request, "fmt", "rewrite files in canonical layout",
                              [&] { return format(request.files, request.check_only); });
  fmt->add_option("FILE", request.files, ".hook files")->required();
  fmt->add_flag("--check", request.check_only, "only say which would change (exit status 1)");
  CLI::App* print_app =
      add_command(app, request, "print", "the experiment after includes, loops and expressions",
                  [&] { return print(request.file, request.settings, request.consent); });
  print_app->add_option("FILE", request.file, "a .hook file")->required();
  add_settings(print_app, request.settings);
  add_consent(print_app, request.consent);
  CLI::App* describe_app = add_command(
      app, request, "describe", "what a class, metric, law, integrator, engine or setting is",
      [&] { return describe_with(app, request.describe); });
  describe_app->add_option("TYPE", request.describe.type,
                           "a class, e.g. Base.mobile, or another name; without it all classes "
                           "are listed");
  describe_app->add_flag("--markdown", request.describe.markdown,
                         "every class as the manual's reference page");
  describe_app->add_flag("--textmate", request.describe.textmate,
                         "the words of the language as a TextMate grammar, for editors");
  describe_app->add_flag("--man", request.describe.man, "the manual page of the command");
  describe_app
      ->add_option("--completion", request.describe.completion,
                   "what completes the command's words in a shell: bash")
      ->type_name("SHELL")
      ->check([](const std::string& text) {
        return text == "bash" ? std::string() : "--completion knows bash, not `" + text + "`";
      });
  describe_app
      ->add_option("--plugin", request.describe.plugins,
                   "with the classes of this plugin (may be "
                   "repeated)")
      ->type_name("LIBRARY")
      ->expected(1)
      ->take_all();
  add_consent(describe_app, request.describe.consent);
}

void add_advise(CLI::App& app, Request& request) {
  CLI::App* advise_app = add_command(app, request, "advise",
                                     "the ground's constants from weight, penetration and rebound",
                                     [&] { return advise(request.advise); });
  advise_app->add_option("FILE", request.advise.file, "a .hook file with a World")->required();
  add_settings(advise_app, request.advise.settings);
  advise_app
      ->add_option("--penetration", request.advise.penetration,
                   "allowed at rest: \"1 mm\" (default: the material's nominal_penetration)")
      ->type_name("DEPTH");
  advise_app
      ->add_option("--rebound", request.advise.rebound,
                   "wanted, of the speed: 0.2 (default: the material's restitution, or 0.1)")
      ->type_name("RATIO");
  advise_app->add_flag("--json", request.advise.json, "as JSON, 17 significant digits");
  add_consent(advise_app, request.advise.consent);
}

void add_translate(CLI::App& app, Request& request) {
  CLI::App* translate_app = add_command(
      app, request, "translate", "contact constants as parameters of other engines, and back",
      [&] { return translate(request.translate); });
  application::TranslateRequest& arguments = request.translate.request;
  translate_app
      ->add_option(
          "WORDS", arguments.given,
          "a .hook file with a World or Materials, or the name of a material; with --from the "
          "engine's parameters, KEY=VALUE,VALUE...")
      ->type_name("FILE|MATERIAL|KEY=VALUE...");
  const auto add = [&](const char* option, auto& value, const char* doc, const char* type) {
    return translate_app->add_option(option, value, doc)->type_name(type);
  };
  add("--from", arguments.from, "read this engine's parameters, those not given at its defaults",
      "ENGINE");
  add("--to", arguments.to,
      "only to these engines, joined by commas (default: all; with --from none)", "ENGINE,...")
      ->delimiter(',');
  add("--material", arguments.material, "of several, this one", "NAME");
  add("--load", arguments.load,
      "on a contact: \"30 N\" (default: the robot's weight over its contacts, or the mass times 9.81)",
      "FORCE");
  add("--mass", arguments.mass,
      "that a contact stops in an impact: \"3 kg\" (default: the load over 9.81)", "MASS");
  add("--contacts", arguments.contacts, "that share the body (default: the robot's, else 1)", "N")
      ->check(is_count("--contacts", 6));
  add("--creep", arguments.creep,
      "that a foot on 10 deg may have at most, in an engine without hook or anchor: \"1 mm/s\" (the "
      "default, for a law that does not creep)",
      "SPEED");
  add("--dt", arguments.step,
      "step of the other engine: \"2 ms\" (default: the World's, else 1 ms)", "TIME");
  add("--radius", arguments.radius, "of the foot, for Simbody: \"20 mm\" (the default)", "LENGTH");
  add("--area", arguments.area,
      "of the foot's face, for Drake's hydroelastic contact: \"10 cm^2\" (the default)", "AREA");
  translate_app
      ->add_option_function<std::string>(
          "--contact",
          [&arguments](const std::string& law) {
            arguments.settings.world.emplace_back("contact", law);
          },
          "the law whose constants are translated (default: the World's, else hookpoint)")
      ->type_name("LAW");
  add_trails(translate_app, arguments.settings);
  translate_app->add_flag("--parameters", request.translate.parameters,
                          "only the manual's page of the engines' parameters");
  translate_app->add_flag("--json", request.translate.json, "as JSON, 17 significant digits");
  add_consent(translate_app, request.translate.consent);
}

void add_export(CLI::App& app, Request& request) {
  CLI::App* export_app = add_command(app, request, "export",
                                     "robots, ground and contact as a model of another program",
                                     [&] { return export_model(request.export_); });
  application::ExportRequest& arguments = request.export_.request;
  export_app->add_option("FILE", arguments.file, "a .hook file with a World, or a robot's file")
      ->required();
  export_app->add_option("--to", arguments.format, "the format: mjcf, urdf or sdf")
      ->type_name("FORMAT")
      ->required();
  export_app->add_option("--out", request.export_.out, "where it goes (default: standard output)")
      ->type_name("FILE");
  export_app->add_option("--robot", arguments.robot, "this robot alone (default: all)")
      ->type_name("NAME");
  export_app
      ->add_option("--creep", arguments.creep,
                   "that a foot on 10 deg may have at most there, as of `translate`")
      ->type_name("SPEED");
  add_settings(export_app, arguments.settings);
  add_consent(export_app, arguments.consent);
}

void add_compare(CLI::App& app, Request& request) {
  CLI::App* compare_app = add_command(
      app, request, "compare", "what differs between two runs: settings, metrics, trajectories",
      [&] { return compare(request.compare); });
  const auto doc = "the folder that `run --out` or `study` left";
  compare_app->add_option("FIRST", request.compare.first, doc)->required();
  compare_app->add_option("SECOND", request.compare.second, doc)->required();
  compare_app
      ->add_option("--tolerance", request.compare.tolerance,
                   "difference that is none, relative to the value or the channel's greatest "
                   "(default: 1e-9)")
      ->type_name("RATIO")
      ->check([](const std::string& text) {
        double value = -1.;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool number = error == std::errc{} && end == text.data() + text.size();
        return number && value >= 0. ? std::string()
                                     : "--tolerance takes a number from 0 on, not `" + text + "`";
      });
  compare_app->add_flag("--json", request.compare.json, "as JSON, every difference");
}

void add_ports(CLI::App& app, Request& request) {
  CLI::App* ports_app =
      add_command(app, request, "ports", "what can be recorded, wired and expected of a world",
                  [&] { return ports(request.ports); });
  ports_app->add_option("FILE", request.ports.file, "a .hook file with a World")->required();
  ports_app->add_option("PATTERN", request.ports.pattern,
                        "a trail, a vector or a glob: * within a name, ** across (default: all but "
                        "the file's constants)");
  ports_app->add_flag("--json", request.ports.json, "as JSON, 17 significant digits");
  add_settings(ports_app, request.ports.settings);
  add_consent(ports_app, request.ports.consent);
}

void add_inspection(CLI::App& app, Request& request) {
  CLI::App* dynamics_app = add_command(
      app, request, "dynamics", "forces and accelerations at the initial state; no time passes",
      [&] { return dynamics(request.file, request.settings, request.json, request.consent); });
  dynamics_app->add_option("FILE", request.file, "a .hook file with a World")->required();
  dynamics_app->add_flag("--json", request.json, "as JSON, 17 significant digits");
  add_settings(dynamics_app, request.settings);
  add_consent(dynamics_app, request.consent);
  CLI::App* engines_app =
      add_command(app, request, "engines", "every engine, contact law and integrator",
                  [&] { return engines(request.engines); });
  engines_app->add_option("FILE", request.engines.file,
                          "a .hook file, whose engines are listed too");
  engines_app->add_flag("--json", request.engines.json, "as JSON");
  add_consent(engines_app, request.engines.consent);
  add_command(app, request, "engine-check",
              "whether a program does as an engine must (docs/engine_protocol.md)",
              [&] { return engine_check(request.words); })
      ->prefix_command()
      ->add_option("COMMAND", request.words, "the program and its arguments")
      ->required();
}

void add_beginnings(CLI::App& app, Request& request) {
  CLI::App* new_app =
      add_command(app, request, "new", "write a commented file to begin with, NAME.hook",
                  [&] { return new_file(request.new_); });
  new_app->add_option("KIND", request.new_.kind, "robot, study or controller")
      ->required()
      ->check(is_one_of("KIND", {"robot", "study", "controller"}));
  new_app->add_option("NAME", request.new_.name, "of what it holds, and of the file")->required();
  add_command(app, request, "cite", "what to cite, as BibTeX", [&] { return cite(request.folder); })
      ->add_option("DIR", request.folder,
                   "a folder of results: with its hash, and the engines and laws that made it");
}

/// What `hookpoint` alone says.
constexpr const char* guide =
    "hookpoint runs legged robots under contact models that can be compared.\n"
    "\n"
    "  hookpoint new robot walker        write walker.hook, a robot to change\n"
    "  hookpoint view walker.hook        watch it in the browser, and move it\n"
    "  hookpoint run walker.hook         run it; --record and --out keep what happens\n"
    "  hookpoint new study who_creeps    write who_creeps.hook, a comparison to change\n"
    "  hookpoint study who_creeps.hook   run it; a report with tables and figures\n"
    "  hookpoint describe Link           what a class, metric, law or engine is\n"
    "  hookpoint engines                 which engines, laws and integrators there are\n"
    "\n"
    "hookpoint --help lists all commands, hookpoint COMMAND --help its options.\n"
    "The manual begins at docs/README.md, its tutorial at docs/tutorial.md.\n";

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

/// The command that FILE.hook, the first of `words`, is for with what the others set in it. What is
/// wrong with them that command tells.
std::optional<std::string> command_for(const std::vector<std::string>& words) {
  CLI::App app;
  app.set_help_flag();
  app.allow_extras();
  std::filesystem::path file;
  application::Settings settings;
  application::Consent allowed;
  app.add_option("FILE", file);
  add_settings(&app, settings);
  add_consent(&app, allowed);
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::ParseError&) {
  }
  return cli::command_for(words[0], settings, allowed);
}

/// The words as a command would have them: `FILE.hook ...` gets `study`, `tune` or `run` in front,
/// by what the file holds. Empty when the first word is neither a command, an option nor a file, or
/// the file has errors; the user has been told.
std::vector<std::string> with_command(const CLI::App& app, std::vector<std::string> words) {
  if (words.empty() || words[0].starts_with("-")) return words;
  const std::vector<std::string> names = command_names(app);
  if (std::find(names.begin(), names.end(), words[0]) != names.end()) return words;
  if (std::filesystem::path(words[0]).extension() == ".hook") {
    const std::optional<std::string> command = command_for(words);
    if (!command) return {};
    words.insert(words.begin(), *command);
    return words;
  }
  std::error_code ignored;
  if (std::filesystem::is_regular_file(words[0], ignored)) {
    const std::string refusal = text::refusal(words[0], text::Use::experiment);
    application::print_error(words[0] + ": " +
                             (refusal.empty() ? "name a command before the file, such as `run` or "
                                                "`check`: only FILE.hook goes without"
                                              : refusal));
    return {};
  }
  const std::string nearest = language::nearest_name(words[0], names);
  application::print_error(
      "there is no command `" + words[0] + "`" +
      (nearest.empty() ? "; `hookpoint --help` lists them" : "; did you mean `" + nearest + "`?"));
  return {};
}

/// What is wrong with an argument that is empty, which names no file, number or port: a variable of
/// a script that was not set. "" where none is.
std::string problem_of_empty(const std::vector<std::string>& words) {
  const auto is_option = [](const std::string& word) { return word.starts_with("--"); };
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const bool joined = is_option(word) && word.find('=') == word.size() - 1;
    if (!word.empty() && !joined) continue;
    const std::string name = joined                             ? word.substr(0, word.size() - 1)
                             : i > 0 && is_option(words[i - 1]) ? words[i - 1]
                                                                : "";
    return (name.empty() ? "argument " + std::to_string(i + 1) + " is empty"
                         : "the value of " + name + " is empty") +
           ": give it one, or leave it out";
  }
  return "";
}

/// CLI11 puts an option's name before what its check says, which may begin with it: "--port:
/// --port takes ..." names it once.
std::string named_once(const std::string& message) {
  const std::size_t colon = message.find(": ");
  if (colon == std::string::npos) return message;
  const std::string name = message.substr(0, colon), rest = message.substr(colon + 2);
  return rest.starts_with(name + " ") ? rest : message;
}

/// "hookpoint study": the command that was given, with its own commands.
std::string given_command(const CLI::App& app) {
  std::string words = app.get_name();
  const CLI::App* at = &app;
  while (!at->get_subcommands().empty()) {
    at = at->get_subcommands().front();
    words += " " + at->get_name();
  }
  return words;
}

int main_with(int count, char** words) {
  const std::vector<std::string> given(words + 1, words + count);
  if (const std::string problem = problem_of_empty(given); !problem.empty()) {
    application::print_error(problem);
    return wrong_input;
  }
  CLI::App app(about(), "hookpoint");
  app.require_subcommand(1);
  app.set_version_flag("-V,--version", version_text,
                       "the version of the program and of the engines found");
  Request request;
  add_run_and_study(app, request);
  add_tune(app, request);
  add_view(app, request);
  add_movie_tools(app, request);
  add_language_tools(app, request);
  add_ports(app, request);
  add_inspection(app, request);
  add_advise(app, request);
  add_translate(app, request);
  add_export(app, request);
  add_fixture(app, request);
  add_compare(app, request);
  add_beginnings(app, request);
  if (given.empty()) {
    std::cout << guide;
    return fine;
  }
  std::vector<std::string> wanted = with_command(app, given);
  if (wanted.empty()) return wrong_input;
  std::reverse(wanted.begin(), wanted.end());  // CLI11 takes the words last first
  try {
    app.parse(wanted);
  } catch (const CLI::Success& asked) {
    return app.exit(asked);
  } catch (const CLI::ParseError& error) {
    application::print_error(named_once(error.what()) + " (`" + given_command(app) +
                             " --help` says what is possible)");
    return wrong_input;
  }
  try {
    return request.command();
  } catch (const output::PlaceError& error) {
    const bool may_move = app.got_subcommand("run") || app.got_subcommand("study") ||
                          app.got_subcommand("tune") ||
                          app.get_subcommand("fixture")->got_subcommand("run");
    const std::string message = error.what(), advice = "--out names another folder";
    const bool said = message.find(advice) != std::string::npos;
    throw output::FileError(message + (may_move && !said ? "; " + advice : ""));
  }
}

int guarded_main(int count, char** words) {
  try {
    return main_with(count, words);
  } catch (const output::FolderError& error) {
    application::print_error(error.what());
    return wrong_input;
  } catch (const std::bad_alloc&) {
    application::print_error("there is not enough memory for what was requested");
    return missing;
  } catch (const std::system_error& error) {
    const bool no_thread = error.code() == std::errc::resource_unavailable_try_again;
    // Where it is of standard output, that is told once, at the end.
    if (std::ferror(stdout) == 0)
      application::print_error(no_thread ? "no further thread can be started (`ulimit -u`): try "
                                           "fewer with --jobs"
                                         : error.what());
    return missing;
  } catch (const std::exception& error) {
    application::print_error(error.what());
    return missing;
  }
}

}  // namespace
}  // namespace hookpoint::cli

int main(int count, char** words) {
  hookpoint::cli::take_standard_streams();
  return hookpoint::cli::finish_standard_output(hookpoint::cli::guarded_main(count, words));
}
