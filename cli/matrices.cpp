#include "cli/matrices.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <sstream>

#include "cli/exit_status.h"
#include "cli/study_runs.h"
#include "output/file.h"
#include "studies/hash.h"
#include "studies/matrix.h"
#include "studies/provenance.h"

namespace hookpoint::cli {
namespace {

/// A study that the matrix will run, with the file that it stands in.
struct PlannedStudy {
  studies::StudyPlan plan;
  std::string file;  ///< as the matrix names it
  std::string text;
};

std::string content(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

void print_problem(const language::Object& part, const std::string& message) {
  language::Diagnostics diagnostics;
  diagnostics.error(part.position, message);
  print_diagnostics(diagnostics);
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

/// The studies of one Part; false after errors, which are printed.
bool plan_part(Application& application, const language::Object& part,
               const StudyArguments& arguments, std::vector<PlannedStudy>& planned) {
  const std::string name =
      part.given("file") ? part.word("file") : "studies/" + part.name + ".hook";
  const std::filesystem::path file = application.library().find(name, arguments.file);
  if (file.empty()) {
    print_problem(part, "no file \"" + name + "\" beside the Matrix or in configs/");
    return false;
  }
  const auto root = application.evaluate(file, {});
  if (!root || !application.load_scene_plugins(*root, file)) return false;
  if (root->children_of("Study").empty()) {
    print_problem(part, "\"" + name + "\" holds no Study");
    return false;
  }
  const std::vector<std::string> only = subjects_of(*root, arguments.only);
  if (!arguments.only.empty() && only.empty()) return true;
  auto plans = plan_studies(application, *root, file, {arguments.quick, only});
  if (!plans) return false;
  for (studies::StudyPlan& plan : *plans) {
    const bool taken = std::ranges::any_of(
        planned, [&](const PlannedStudy& other) { return other.plan.name == plan.name; });
    if (taken) {
      print_problem(part, "a second study is called `" + plan.name + "`");
      return false;
    }
    plan.file = name;
    planned.push_back({std::move(plan), name, content(file)});
  }
  return true;
}

studies::Provenance provenance_of(const Application& application, const language::Object& matrix,
                                  const StudyArguments& arguments, const std::string& hash,
                                  const studies::StudyPlan& first) {
  studies::Provenance provenance = studies::make_provenance(first, application.engines());
  provenance.study = matrix.name;
  provenance.file = arguments.file.string();
  provenance.hash = hash;
  return provenance;
}

int run_one(Application& application, const language::Object& root, const language::Object& matrix,
            const StudyArguments& arguments, const std::string& command, bool alone) {
  std::vector<PlannedStudy> planned;
  for (const language::Object* part : matrix.children_of("Part")) {
    if (arguments.quick && !part->boolean("quick")) continue;
    if (!plan_part(application, *part, arguments, planned)) return wrong_input;
  }
  if (planned.empty()) {
    print_problem(matrix, "the Matrix has no Part, or --only names no subject of its studies");
    return wrong_input;
  }
  studies::Hash hash;
  for (const PlannedStudy& each : planned) hash.add(each.plan.hash);
  std::filesystem::path folder =
      std::filesystem::path("runs") / fmt::format("{}-{}", matrix.name, hash.text());
  if (arguments.out) folder = alone ? *arguments.out : *arguments.out / matrix.name;

  studies::MatrixResult result{matrix.name, {}, {}, arguments.file.string(), {}};
  if (matrix.given("title")) result.title = matrix.word("title");
  if (matrix.given("question")) result.question = matrix.word("question");
  int status = fine;
  for (const PlannedStudy& each : planned) {
    StudyOutcome outcome =
        run_one_study(application, each.plan, arguments, folder / each.plan.name, command, false);
    status = std::max(status, outcome.status);
    if (!outcome.result) return status;
    result.studies.push_back({std::move(*outcome.result), each.text, std::move(outcome.figures)});
  }
  const auto provenance =
      provenance_of(application, matrix, arguments, hash.text(), planned.front().plan);
  output::write_file(folder / "experiment.hook", language::print(root));
  output::write_file(folder / "provenance.json", studies::provenance_json(provenance));
  output::write_csv(folder / "matrix.csv", studies::matrix_table(result));
  output::write_file(
      folder / "matrix.html",
      studies::matrix_html(result, {command, {}, studies::provenance_lines(provenance), {}}));
  std::cout << studies::matrix_terminal_table(result, isatty(STDOUT_FILENO) != 0);
  std::cout << "\nmatrix: " << (folder / "matrix.html").string() << '\n';
  return status;
}

}  // namespace

int run_matrices(Application& application, const language::Object& root,
                 const StudyArguments& arguments, const std::string& command) {
  const auto matrices = root.children_of("Matrix");
  int status = fine;
  for (const language::Object* matrix : matrices)
    status = std::max(
        status, run_one(application, root, *matrix, arguments, command, matrices.size() == 1));
  return status;
}

}  // namespace hookpoint::cli
