#include "cli/study_plans.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <thread>

#include "studies/hash.h"

namespace hookpoint::cli {
namespace {

std::string content(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

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

std::optional<std::vector<studies::WallPlan>> plan_walls(Application& application,
                                                         const language::Object& root,
                                                         const StudyArguments& arguments) {
  std::vector<studies::WallPlan> plans;
  for (const language::Object* wall : root.children_of("Wall")) {
    language::Diagnostics diagnostics;
    auto plan = studies::make_wall_plan(root, *wall, arguments.file.string(), application.library(),
                                        {arguments.quick, arguments.only}, diagnostics);
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
  const auto root = application.evaluate(file, {});
  if (!root || !application.load_scene_plugins(*root, file)) return false;
  if (root->children_of("Study").empty()) return refuse("\"" + name + "\" holds no Study");
  const std::vector<std::string> only = subjects_of(*root, arguments.only);
  if (!arguments.only.empty() && only.empty()) return true;
  auto plans = plan_studies(application, *root, file, {arguments.quick, only});
  if (!plans) return false;
  for (studies::StudyPlan& plan : *plans) {
    if (std::ranges::any_of(planned,
                            [&](const MatrixPart& other) { return other.plan.name == plan.name; }))
      return refuse("a second study is called `" + plan.name + "`");
    plan.file = name;
    planned.push_back({std::move(plan), content(file)});
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
  studies::Hash hash;
  for (const MatrixPart& part : plan.parts) hash.add(part.plan.hash);
  plan.hash = hash.text();
  return plan;
}

}  // namespace

std::optional<StudyFile> plan_study_file(Application& application,
                                         const StudyArguments& arguments) {
  const auto root = application.evaluate(arguments.file, {});
  if (!root || !application.load_scene_plugins(*root, arguments.file)) return std::nullopt;
  StudyFile file;
  file.text = language::print(*root);
  auto plans = plan_studies(application, *root, arguments.file, {arguments.quick, arguments.only});
  if (!plans) return std::nullopt;
  file.studies = std::move(*plans);
  auto walls = plan_walls(application, *root, arguments);
  if (!walls) return std::nullopt;
  file.walls = std::move(*walls);
  for (const language::Object* matrix : root->children_of("Matrix")) {
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
  options.jobs = arguments.jobs > 0
                     ? arguments.jobs
                     : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  options.resume = arguments.resume;
  options.folder = folder;
  return options;
}

std::string rerun_command(const StudyArguments& arguments) {
  std::string command = "hookpoint study " + arguments.file.string();
  if (arguments.quick) command += " --quick";
  for (const std::string& subject : arguments.only) command += " --only " + subject;
  if (arguments.allow_plugins) command += " --allow-plugins";
  return command;
}

}  // namespace hookpoint::cli
