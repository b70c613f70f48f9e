// A Matrix as a task of tasks: its studies one after the other, each into a folder of its own
// beside matrix.html.
#include <algorithm>
#include <map>
#include <utility>

#include "output/files/file.h"
#include "output/files/hash.h"
#include "studies/blocks/matrix.h"
#include "studies/report/matrix.h"
#include "studies/run/results_csv.h"
#include "studies/task/study_task.h"
#include "studies/task/task_kinds.h"

namespace hookpoint::studies {
namespace {

/// A study that a Matrix brings, with the text of the file that it stands in.
struct MatrixPart {
  std::unique_ptr<StudyTask> study;
  std::string text;
};

class MatrixTask : public Task {
 public:
  /// `parts`: at least one.
  MatrixTask(const TaskSource& source, const language::Object& block, std::vector<MatrixPart> parts)
      : Task(source, block.name, hash_of(parts)),
        parts_(std::move(parts)),
        printed_(language::print(source.root)) {
    const Heading heading = matrix_heading(block);
    result_ = {block.name, heading.title, heading.question, source.file.string(), {}};
  }

  static std::vector<std::string> scenes(const language::Object&) { return {}; }

  static bool plan(const TaskSource& source, const language::Object& block, Tasks& tasks) {
    std::vector<MatrixPart> parts;
    for (const language::Object* part : block.children_of("Part")) {
      if (source.options.quick && !part_block(*part).quick) continue;
      if (!plan_part(source, *part, parts)) return false;
    }
    if (parts.empty())
      return refuse(source, block,
                    "the Matrix has no Part, or --only names no subject of its studies");
    tasks.push_back(std::make_unique<MatrixTask>(source, block, std::move(parts)));
    return true;
  }

  void place(std::filesystem::path folder) override {
    for (const MatrixPart& part : parts_) part.study->place(folder / part.study->name());
    Task::place(std::move(folder));
  }

  TaskStatus run(TaskRunner& runner, const std::shared_ptr<RunStore>& store) override {
    std::vector<std::string> names = output::names_of(files());
    names.emplace_back(store_folder);
    files_ = std::make_unique<output::ResultFolder>(folder(), output::Manifest{hash(), {}, {}, {}},
                                                    std::move(names));
    const auto shared =
        store ? store
              : std::make_shared<RunStore>(folder() / store_folder, runner.options().resume);
    TaskStatus status = TaskStatus::holds;
    for (const MatrixPart& part : parts_) {
      status = std::max(status, part.study->run(runner, shared));
      if (status == TaskStatus::interrupted) return status;
      result_.studies.push_back({part.study->rows(), part.text, part.study->figures()});
    }
    if (runner.wants_reports()) leave();
    files_.reset();
    return status;
  }

  std::vector<std::string> settable() const override {
    std::vector<std::string> all;
    for (const MatrixPart& part : parts_) {
      const std::vector<std::string> own = part.study->settable();
      all.insert(all.end(), own.begin(), own.end());
    }
    return all;
  }

  std::vector<const Task*> parts() const override {
    std::vector<const Task*> studies;
    for (const MatrixPart& part : parts_) studies.push_back(part.study.get());
    return studies;
  }

  const char* page() const override { return "matrix"; }

  std::string terminal_text(const TableStyle& style) const override {
    return has_result() ? matrix_terminal_table(result_, style.color) + "\n" : "";
  }

  ResultValues values() const override {
    ResultValues studies;
    for (const MatrixPart& part : parts_)
      studies.push_back({part.study->name(), {part.study->values()}});
    return {{"table", {matrix_table(result_)}}, {"studies", {std::move(studies)}}};
  }

 protected:
  void execute(RunOptions, TaskRunner&, const std::atomic<bool>&) override {}
  bool has_result() const override { return result_.studies.size() == parts_.size(); }
  bool holds() const override { return true; }

  std::vector<std::string> leave() override {
    provenance_ = make_provenance(*parts_.front().study->rows_plan(), host_.engines());
    provenance_.study = result_.name;
    provenance_.file = result_.file;
    provenance_.hash = hash();
    provenance_.inputs = inputs();
    files_->write(files());
    files_->finish();
    return {};
  }

 private:
  std::vector<output::ResultFile> files() const {
    return {{"experiment.hook", [this] { return printed_; }},
            {"provenance.json", [this] { return provenance_json(provenance_); }},
            {"matrix.csv", [this] { return matrix_table(result_).text(); }},
            {"matrix.html", [this] {
               return matrix_html(result_, {command_, {}, provenance_lines(provenance_), {}});
             }}};
  }

  static std::string hash_of(const std::vector<MatrixPart>& parts) {
    output::Hash hash;
    for (const MatrixPart& part : parts) hash.add(part.study->hash());
    return hash.text();
  }

  /// Those of all its studies, each once.
  std::vector<output::InputFile> inputs() const {
    std::map<std::string, std::string> hashes;
    for (const MatrixPart& part : parts_)
      for (const output::InputFile& input : part.study->rows_plan()->inputs)
        hashes.emplace(input.path, input.hash);
    std::vector<output::InputFile> list;
    for (const auto& [path, hash] : hashes) list.push_back({path, hash});
    return list;
  }

  static bool refuse(const TaskSource& source, const language::Object& block,
                     const std::string& message) {
    language::Diagnostics diagnostics;
    diagnostics.error(block.position, message);
    source.host.tell(diagnostics);
    return false;
  }

  /// `--only` names subjects of any of the matrix's studies: those that this file has.
  static std::vector<std::string> subjects_in(const language::Object& root,
                                              const std::vector<std::string>& only) {
    std::vector<std::string> there;
    for (const language::Object* study : root.children_of("Study"))
      for (const language::Object* subject : study->children_of("Subject"))
        if (std::ranges::find(only, subject->name) != only.end() &&
            std::ranges::find(there, subject->name) == there.end())
          there.push_back(subject->name);
    return there;
  }

  /// The studies of one Part; false after errors, which are reported.
  static bool plan_part(const TaskSource& matrix, const language::Object& part,
                        std::vector<MatrixPart>& parts) {
    const std::string name = part_file(part);
    const std::filesystem::path file = matrix.host.library().find(name, matrix.file);
    if (file.empty())
      return refuse(matrix, part, "no file \"" + name + "\" beside the Matrix or in configs/");
    const TaskFile evaluated = matrix.host.evaluate(file);
    if (evaluated.root == nullptr) return false;
    TaskSource source{matrix.host,    *evaluated.root, file,
                      matrix.options, matrix.command,  matrix.forms};
    if (source.root.children_of("Study").empty())
      return refuse(matrix, part, "\"" + name + "\" holds no Study");
    source.options.only = subjects_in(source.root, matrix.options.only);
    if (!matrix.options.only.empty() && source.options.only.empty()) return true;
    std::vector<StudyPlan> plans;
    for (const language::Object* study : source.root.children_of("Study")) {
      auto plan = StudyTask::plan_block(source, *study);
      if (!plan) return false;
      plans.push_back(std::move(*plan));
    }
    for (StudyPlan& plan : plans) {
      const auto is_called_so = [&](const MatrixPart& other) {
        return other.study->name() == plan.name;
      };
      if (std::ranges::any_of(parts, is_called_so))
        return refuse(matrix, part, "a second study is called `" + plan.name + "`");
      plan.file = name;
      parts.push_back({std::make_unique<StudyTask>(source, std::move(plan), evaluated.settable),
                       output::read_file(file).value_or("")});
    }
    return true;
  }

  std::vector<MatrixPart> parts_;
  std::string printed_;  ///< its file
  MatrixResult result_;
  Provenance provenance_;
};

}  // namespace

TaskKind matrix_kind() { return {"Matrix", "study", MatrixTask::scenes, MatrixTask::plan}; }

}  // namespace hookpoint::studies
