#include "python/loaded_file.h"

#include <fmt/format.h>

#include <utility>

#include "python/errors.h"
#include "simulation/scene/load.h"

namespace hookpoint::python {
namespace {

/// "file.hook:3:5: message".
std::string placed(const language::Diagnostic& diagnostic) {
  if (diagnostic.position.file == nullptr) return diagnostic.message;
  const language::LineColumn place = language::line_and_column(diagnostic.position);
  return fmt::format("{}:{}:{}: {}", diagnostic.position.file->path, place.line, place.column,
                     diagnostic.message);
}

}  // namespace

QuietApplication::QuietApplication(bool allow_plugins)
    : told_(std::make_shared<Told>()),
      application_(std::make_unique<application::Application>(
          allow_plugins, [told = told_](const language::Diagnostics& diagnostics) {
            told->last = diagnostics;
            for (const language::Diagnostic& diagnostic : diagnostics.all()) {
              if (diagnostic.severity == language::Severity::warning)
                told->warnings.push_back(placed(diagnostic));
            }
          })) {}

void QuietApplication::fail() const { throw_diagnostics(told_->last); }

void QuietApplication::pass_on_warnings() {
  for (const std::string& warning : std::exchange(told_->warnings, {})) warn(warning);
}

LoadedFile::LoadedFile(const Source& source) : source_(source), application_(source.allow_plugins) {
  if (source_.text) application_->give(source_.file, *source_.text);
  if (!application_->load_plugins(source_.file)) application_.fail();
  if (source_.engine) source_.settings = settings_with("engine", *source_.engine);
  const auto root = application_->evaluate(source_.file, source_.settings);
  if (!root) application_.fail();
  experiment_ = application_->load(*root);
  if (!experiment_) application_.fail();
  application_.pass_on_warnings();
  simulation::write_chosen_step(*experiment_, *root);
  text_ = language::print(*root);
  sources_ = language::sources_of(*root);
}

std::vector<std::string> LoadedFile::settings_with(const std::string& field,
                                                   const std::string& value) {
  std::vector<std::string> settings = source_.settings;
  for (std::string& setting : application_->world_settings(source_.file, field, value))
    settings.push_back(std::move(setting));
  return settings;
}

std::string LoadedFile::text_with(const std::string& field, const std::string& value) {
  const auto root = application_->evaluate(source_.file, settings_with(field, value));
  if (!root) application_.fail();
  simulation::write_chosen_step(*experiment_, *root);
  return language::print(*root);
}

}  // namespace hookpoint::python
