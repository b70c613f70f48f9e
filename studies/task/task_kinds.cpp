#include "studies/task/task_kinds.h"

#include <algorithm>

namespace hookpoint::studies {

std::span<const TaskKind> task_kinds() {
  static const TaskKind kinds[] = {study_kind(), wall_kind(), matrix_kind(), tune_kind(),
                                   calibrate_kind()};
  return kinds;
}

bool holds_task(const language::Object& root, std::string_view command) {
  return std::ranges::any_of(task_kinds(), [&](const TaskKind& kind) {
    return kind.command == command && !root.children_of(kind.block).empty();
  });
}

std::optional<Tasks> plan_tasks(const TaskSource& source, std::string_view command) {
  Tasks tasks;
  for (const TaskKind& kind : task_kinds()) {
    if (kind.command != command) continue;
    for (const language::Object* block : source.root.children_of(kind.block))
      if (!kind.plan(source, *block, tasks)) return std::nullopt;
  }
  return tasks;
}

}  // namespace hookpoint::studies
