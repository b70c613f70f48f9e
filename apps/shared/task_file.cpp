#include "apps/shared/task_file.h"

#include <algorithm>
#include <utility>

#include "language/names.h"
#include "reference/engines.h"
#include "studies/plan/scene.h"
#include "studies/run/results_csv.h"

namespace hookpoint::application {

std::string nothing_to_run(const std::filesystem::path& file, const TaskCommand& command,
                           const std::string& instead) {
  std::vector<std::string> blocks;
  for (const studies::TaskKind& kind : studies::task_kinds())
    if (std::string(kind.command) == command.name) blocks.push_back(kind.block);
  std::string words;
  for (std::size_t i = 0; i < blocks.size(); ++i)
    words += (i == 0 ? "" : i + 1 < blocks.size() ? ", " : " and ") + ("no " + blocks[i]);
  return file.string() + " holds " + words + "; " + instead;
}

studies::TaskFile evaluate_file(Application& application, const std::filesystem::path& file,
                                const Settings& settings) {
  studies::TaskFile set;
  if (!application.load_plugins(file)) return set;
  language::Diagnostics unreported;
  for (const auto& parameter : application.library().parameters(file, unreported))
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
    if (const auto plain = application.library().evaluate(file, options_from(own()), unreported))
      for (const auto& child : plain->children) set.settable.push_back(child->name);
  }
  set.root = application.evaluate(file, own());
  return set;
}

std::optional<studies::Tasks> TaskApplication::plan() {
  studies::TaskFile file;
  if (command_.of_scenes)
    file = evaluate_file(application_, arguments_.file, arguments_.settings);
  else
    file.root = application_.evaluate_set(arguments_.file, arguments_.settings);
  if (!file.root) return std::nullopt;
  if (!studies::holds_task(*file.root, command_.name)) return studies::Tasks{};
  auto tasks = plan(*file.root);
  if (!tasks) return std::nullopt;
  const std::string unknown = unknown_setting(*tasks, file.settable);
  if (!unknown.empty()) {
    language::Diagnostics diagnostics;
    diagnostics.error({}, unknown);
    tell(diagnostics);
    return std::nullopt;
  }
  for (const auto& task : *tasks) {
    const auto& out = arguments_.out;
    task->place(!out                ? studies::folder_of(task->name(), task->hash())
                : tasks->size() > 1 ? *out / task->name()
                                    : *out);
  }
  return tasks;
}

std::optional<studies::Tasks> TaskApplication::plan(const language::Object& root) {
  if (!application_.load_scene_plugins(root, arguments_.file)) return std::nullopt;
  studies::PlanOptions options{arguments_.quick, arguments_.only, {}};
  for (const std::string& setting : arguments_.settings.trails)
    options.settings.trails.push_back(override_from(setting));
  options.settings.world = arguments_.settings.world;
  options.jobs = arguments_.threads();
  return studies::plan_tasks({*this, root, arguments_.file, std::move(options),
                              rerun_command(command_.name, arguments_), arguments_.forms},
                             command_.name);
}

/// What is set but stands nowhere; "" when all does.
std::string TaskApplication::unknown_setting(const studies::Tasks& tasks,
                                             std::vector<std::string> settable) const {
  if (!command_.of_scenes) return "";
  for (const auto& task : tasks) {
    const std::vector<std::string> own = task->settable();
    settable.insert(settable.end(), own.begin(), own.end());
  }
  for (const std::string& setting : arguments_.settings.trails) {
    const std::string first = studies::first_name(override_from(setting).trail);
    if (std::ranges::find(settable, first) == settable.end())
      return "--set " + setting + ": neither " + arguments_.file.string() +
             " nor a scene of its studies has a Param or an object `" + first + "`" +
             language::did_you_mean(first, settable);
  }
  return "";
}

std::shared_ptr<studies::RunStore> TaskApplication::shared_store(
    const studies::Tasks& tasks) const {
  if (!command_.of_scenes || tasks.size() < 2 || !arguments_.out) return nullptr;
  return std::make_shared<studies::RunStore>(*arguments_.out / studies::store_folder,
                                             arguments_.resume);
}

studies::TaskFile TaskApplication::evaluate(const std::filesystem::path& file) {
  studies::TaskFile found = evaluate_file(application_, file, arguments_.settings);
  if (found.root && !application_.load_scene_plugins(*found.root, file)) found.root.reset();
  return found;
}

std::vector<studies::PeerSetting> TaskApplication::peer_settings(
    const studies::StudyResult& result) const {
  std::vector<std::pair<std::string, std::string>> used;
  for (const studies::SubjectInfo& subject : result.compositions) {
    const std::pair<std::string, std::string> peer{subject.engine, subject.settings};
    if (subject.available && subject.engine != "dts" && std::ranges::find(used, peer) == used.end())
      used.push_back(peer);
  }
  std::vector<studies::PeerSetting> settings;
  for (const auto& [engine, name] : used) {
    if (application_.engines().at(engine).is_program) {
      for (const auto& [of, quantity, value, source] :
           application_.engines().describe(engine).constants)
        if (of == name) settings.push_back({engine, name, quantity, value, source});
      continue;
    }
    const reference::Peer& peer = reference::peer_named(engine);
    // One that the peer has not is shown as recommended: its rows were refused.
    const auto shown =
        reference::settings_named(name, peer).value_or(reference::Settings::recommended);
    for (const reference::SettingRow& row : peer.settings_table())
      settings.push_back({engine, name, row.quantity, row.at(shown), row.source});
  }
  return settings;
}

}  // namespace hookpoint::application
