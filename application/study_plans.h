// What a file asks of `study`, all of it planned before anything runs. Shared by the command and
// by Python.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "application/application.h"
#include "application/study_arguments.h"
#include "studies/compare/wall.h"
#include "studies/plan/plan.h"
#include "studies/run/run.h"

namespace hookpoint::application {

/// A study that a Matrix brings, with the file that it stands in.
struct MatrixPart {
  studies::StudyPlan plan;
  std::string text;  ///< of the file
};

struct MatrixPlan {
  std::string name, title, question;
  std::string hash;  ///< of all studies
  std::vector<MatrixPart> parts;
};

/// The blocks of a file; a file that holds none is all empty.
struct StudyFile {
  std::string text;  ///< the file as printed
  std::vector<studies::StudyPlan> studies;
  std::vector<studies::WallPlan> walls;
  std::vector<MatrixPlan> matrices;

  std::size_t size() const { return studies.size() + walls.size() + matrices.size(); }
  /// Where the results of a block `name` go: into a folder of its name in `out`, or into `out`
  /// itself where it is the only one; without `out` into runs/NAME-HASH.
  std::filesystem::path folder(const std::optional<std::filesystem::path>& out,
                               const std::string& name, const std::string& hash) const {
    if (!out) return studies::folder_of(name, hash);
    return size() > 1 ? *out / name : *out;
  }
};

/// A file with those of the settings that it has a Param or an object for.
struct SetFile {
  std::unique_ptr<language::Object> root;  ///< null after errors, which are told
  std::vector<std::string> settable;       ///< Params and objects at its top
};
SetFile evaluate_file(Application& application, const std::filesystem::path& file,
                      const Settings& settings);

/// Whether a file that was evaluated holds any of these blocks.
bool holds_study(const language::Object& root);

/// Nothing after errors, which are told.
std::optional<StudyFile> plan_study_file(Application& application, const StudyArguments& arguments);
/// The same of `arguments.file`, evaluated as `root`.
std::optional<StudyFile> plan_study_file(Application& application, const language::Object& root,
                                         const StudyArguments& arguments);

/// What is said of a file that holds no block.
std::string nothing_to_study(const std::filesystem::path& file);

/// Of one block that runs into `folder` (empty: runs/NAME-HASH).
studies::RunOptions run_options(const StudyArguments& arguments,
                                const std::filesystem::path& folder);

/// The store that all blocks of the file share, in the folder that the user named for them; null
/// where each has its own. Throws studies::StoreError.
std::shared_ptr<studies::RunStore> shared_store(const StudyArguments& arguments,
                                                const StudyFile& file);

/// `text` as one word of a shell's command.
std::string shell_word(const std::string& text);

/// How Slurm was asked, as options again, after a space; "" where it was not.
std::string slurm_words(const StudyArguments& arguments);

/// "hookpoint study FILE ..." as it was called.
std::string rerun_command(const StudyArguments& arguments);

}  // namespace hookpoint::application
