#include "application/study_plans.h"

#include <algorithm>
#include <string_view>
#include <thread>

#include "application/short_forms.h"
#include "language/names.h"
#include "output/file.h"
#include "output/text/hash.h"
#include "studies/plan/scene_settings.h"
#include "studies/run/results_csv.h"

namespace hookpoint::application {
namespace {

/// The plans of all Study blocks of `root`, evaluated from `file`; nothing after errors, which are
/// told.
std::optional<std::vector<studies::StudyPlan>> plan_studies(Application& application,
                                                            const language::Object& root,
                                                            const std::filesystem::path& file,
                                                            const studies::PlanOptions& options) {
  std::vector<studies::StudyPlan> plans;
  for (const language::Object* study : root.children_of("Study")) {
    language::Diagnostics diagnostics;
    auto plan = studies::make_plan(root, *study, file.string(), application.library(),
                                   application.engines(), options, diagnostics);
    application.tell(diagnostics);
    if (!plan) return std::nullopt;
    plans.push_back(std::move(*plan));
  }
  return plans;
}

/// One a core unless it was said.
int threads(const StudyArguments& arguments) {
  return arguments.jobs > 0 ? arguments.jobs
                            : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

studies::PlanOptions plan_options(const StudyArguments& arguments,
                                  const std::vector<std::string>& only) {
  studies::PlanOptions options{arguments.quick, only, {}};
  for (const std::string& setting : arguments.settings.trails)
    options.settings.trails.push_back(override_from(setting));
  options.settings.world = arguments.settings.world;
  options.jobs = threads(arguments);
  return options;
}

/// What is set but stands nowhere; "" when all does.
std::string unknown_setting(const StudyArguments& arguments, const StudyFile& file,
                            std::vector<std::string> settable) {
  const auto add = [&](const studies::StudyPlan& plan) {
    settable.insert(settable.end(), plan.settable.begin(), plan.settable.end());
  };
  for (const studies::StudyPlan& plan : file.studies) add(plan);
  for (const studies::WallPlan& plan : file.walls) add(plan.study);
  for (const MatrixPlan& matrix : file.matrices)
    for (const MatrixPart& part : matrix.parts) add(part.plan);
  for (const std::string& setting : arguments.settings.trails) {
    const std::string first = studies::first_name(override_from(setting).trail);
    if (std::ranges::find(settable, first) == settable.end())
      return "--set " + setting + ": neither " + arguments.file.string() +
             " nor a scene of its studies has a Param or an object `" + first + "`" +
             language::did_you_mean(first, settable);
  }
  return "";
}

std::optional<std::vector<studies::WallPlan>> plan_walls(Application& application,
                                                         const language::Object& root,
                                                         const StudyArguments& arguments) {
  std::vector<studies::WallPlan> plans;
  for (const language::Object* wall : root.children_of("Wall")) {
    language::Diagnostics diagnostics;
    auto plan = studies::make_wall_plan(root, *wall, arguments.file.string(), application.library(),
                                        plan_options(arguments, arguments.only), diagnostics);
    application.tell(diagnostics);
    if (!plan) return std::nullopt;
    plans.push_back(std::move(*plan));
  }
  return plans;
}

void tell_problem(const Application& application, const language::Object& block,
                  const std::string& message) {
  language::Diagnostics diagnostics;
  diagnostics.error(block.position, message);
  application.tell(diagnostics);
}

/// `--only` names subjects of any of the matrix's studies: those that this one has.
std::vector<std::string> subjects_of(const language::Object& root,
                                     const std::vector<std::string>& only) {
  std::vector<std::string> there;
  for (const language::Object* study : root.children_of("Study"))
    for (const language::Object* subject : study->children_of("Subject"))
      if (std::ranges::find(only, subject->name) != only.end() &&
          std::ranges::find(there, subject->name) == there.end())
        there.push_back(subject->name);
  return there;
}

/// The studies of one Part; false after errors, which are told.
bool plan_part(Application& application, const language::Object& part,
               const StudyArguments& arguments, std::vector<MatrixPart>& planned) {
  const std::string name =
      part.given("file") ? part.word("file") : "studies/" + part.name + ".hook";
  const auto refuse = [&](const std::string& message) {
    tell_problem(application, part, message);
    return false;
  };
  const std::filesystem::path file = application.library().find(name, arguments.file);
  if (file.empty()) return refuse("no file \"" + name + "\" beside the Matrix or in configs/");
  const SetFile set = evaluate_file(application, file, arguments.settings);
  const language::Object* root = set.root.get();
  if (root == nullptr || !application.load_scene_plugins(*root, file)) return false;
  if (root->children_of("Study").empty()) return refuse("\"" + name + "\" holds no Study");
  const std::vector<std::string> only = subjects_of(*root, arguments.only);
  if (!arguments.only.empty() && only.empty()) return true;
  auto plans = plan_studies(application, *root, file, plan_options(arguments, only));
  if (!plans) return false;
  for (studies::StudyPlan& plan : *plans) {
    if (std::ranges::any_of(planned,
                            [&](const MatrixPart& other) { return other.plan.name == plan.name; }))
      return refuse("a second study is called `" + plan.name + "`");
    plan.file = name;
    plan.settable.insert(plan.settable.end(), set.settable.begin(), set.settable.end());
    planned.push_back({std::move(plan), output::read_file(file).value_or("")});
  }
  return true;
}

std::optional<MatrixPlan> plan_matrix(Application& application, const language::Object& matrix,
                                      const StudyArguments& arguments) {
  MatrixPlan plan{matrix.name, {}, {}, {}, {}};
  if (matrix.given("title")) plan.title = matrix.word("title");
  if (matrix.given("question")) plan.question = matrix.word("question");
  for (const language::Object* part : matrix.children_of("Part")) {
    if (arguments.quick && !part->boolean("quick")) continue;
    if (!plan_part(application, *part, arguments, plan.parts)) return std::nullopt;
  }
  if (plan.parts.empty()) {
    tell_problem(application, matrix,
                 "the Matrix has no Part, or --only names no subject of its studies");
    return std::nullopt;
  }
  output::Hash hash;
  for (const MatrixPart& part : plan.parts) hash.add(part.plan.hash);
  plan.hash = hash.text();
  return plan;
}

}  // namespace

std::string shell_word(const std::string& text) {
  const bool plain = !text.empty() && std::ranges::all_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./=,:+@%").find(c) != std::string_view::npos;
  });
  if (plain) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

SetFile evaluate_file(Application& application, const std::filesystem::path& file,
                      const Settings& settings) {
  SetFile set;
  if (!application.load_plugins(file)) return set;
  language::Diagnostics untold;
  for (const auto& parameter : application.library().parameters(file, untold))
    set.settable.push_back(parameter.name);
  const auto own = [&] {
    std::vector<std::string> found;
    for (const std::string& setting : settings.trails)
      if (std::ranges::find(set.settable, studies::first_name(override_from(setting).trail)) !=
          set.settable.end())
        found.push_back(setting);
    return found;
  };
  // Of the objects nothing is known before the Params have their values.
  if (!settings.trails.empty()) {
    if (const auto plain = application.library().evaluate(file, options_from(own()), untold))
      for (const auto& child : plain->children) set.settable.push_back(child->name);
  }
  set.root = application.evaluate(file, own());
  return set;
}

bool holds_study(const language::Object& root) {
  return !root.children_of("Study").empty() || !root.children_of("Wall").empty() ||
         !root.children_of("Matrix").empty();
}

std::optional<StudyFile> plan_study_file(Application& application,
                                         const StudyArguments& arguments) {
  const SetFile set = evaluate_file(application, arguments.file, arguments.settings);
  if (!set.root) return std::nullopt;
  auto file = plan_study_file(application, *set.root, arguments);
  if (!file || file->size() == 0) return file;
  const std::string unknown = unknown_setting(arguments, *file, set.settable);
  if (unknown.empty()) return file;
  language::Diagnostics diagnostics;
  diagnostics.error({}, unknown);
  application.tell(diagnostics);
  return std::nullopt;
}

std::optional<StudyFile> plan_study_file(Application& application, const language::Object& root,
                                         const StudyArguments& arguments) {
  if (!application.load_scene_plugins(root, arguments.file)) return std::nullopt;
  StudyFile file;
  file.text = language::print(root);
  auto plans =
      plan_studies(application, root, arguments.file, plan_options(arguments, arguments.only));
  if (!plans) return std::nullopt;
  file.studies = std::move(*plans);
  auto walls = plan_walls(application, root, arguments);
  if (!walls) return std::nullopt;
  file.walls = std::move(*walls);
  for (const language::Object* matrix : root.children_of("Matrix")) {
    auto plan = plan_matrix(application, *matrix, arguments);
    if (!plan) return std::nullopt;
    file.matrices.push_back(std::move(*plan));
  }
  return file;
}

std::string nothing_to_study(const std::filesystem::path& file) {
  return file.string() + " holds no Study, no Wall and no Matrix; `hookpoint run` runs a world";
}

studies::RunOptions run_options(const StudyArguments& arguments,
                                const std::filesystem::path& folder) {
  studies::RunOptions options;
  options.jobs = threads(arguments);
  options.resume = arguments.resume;
  options.folder = folder;
  return options;
}

std::shared_ptr<studies::RunStore> shared_store(const StudyArguments& arguments,
                                                const StudyFile& file) {
  if (file.size() < 2 || !arguments.out) return nullptr;
  return std::make_shared<studies::RunStore>(*arguments.out / studies::store_folder,
                                             arguments.resume);
}

std::string slurm_words(const StudyArguments& arguments) {
  if (!arguments.slurm) return "";
  const studies::SlurmSettings& settings = arguments.slurm_settings;
  std::string words = " --slurm";
  const auto add = [&words](const char* option, const std::string& value) {
    if (!value.empty()) words += std::string(" ") + option + " " + shell_word(value);
  };
  const auto count = [](std::size_t number) {
    return number > 0 ? std::to_string(number) : std::string();
  };
  add("--partition", settings.partition);
  add("--account", settings.account);
  add("--time", settings.time);
  add("--chunk", count(settings.chunk));
  add("--array-limit", count(settings.array_limit));
  return words;
}

std::string rerun_command(const StudyArguments& arguments) {
  std::string command = "hookpoint study " + shell_word(arguments.file.string());
  for (const std::string& setting : arguments.settings.trails)
    command += " --set " + shell_word(setting);
  for (const auto& [field, value] : arguments.settings.world)
    for (const ShortForm& form : short_forms)
      if (field == form.field) command += std::string(" ") + form.option + " " + shell_word(value);
  if (arguments.quick) command += " --quick";
  for (const std::string& subject : arguments.only) command += " --only " + shell_word(subject);
  if (arguments.allow_plugins) command += " --allow-plugins";
  return command + slurm_words(arguments);
}

}  // namespace hookpoint::application
