// The kinds of tasks: the block of a file that each is, and the command that runs it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "studies/task/task.h"

namespace hookpoint::studies {

TaskKind study_kind();
TaskKind wall_kind();
TaskKind matrix_kind();
TaskKind tune_kind();
TaskKind calibrate_kind();

/// All of them, in the order in which the tasks of a file run.
std::span<const TaskKind> task_kinds();

/// Whether a file that was evaluated holds a block that the command runs.
bool holds_task(const language::Object& root, std::string_view command);

/// The tasks of the command, none of them placed; nothing after errors, which are reported.
std::optional<Tasks> plan_tasks(const TaskSource& source, std::string_view command);

}  // namespace hookpoint::studies
