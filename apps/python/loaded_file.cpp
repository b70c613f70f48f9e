#include "apps/python/loaded_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "apps/python/errors.h"
#include "apps/shared/robot_file.h"
#include "simulation/analysis/step_warning.h"
#include "simulation/scene/load.h"

namespace hookpoint::python {
namespace {

/// The Param that worlds of different seeds have different values of, as in studies.
constexpr const char* seed_parameter = "seed";

/// "file.hook:3:5: message".
std::string placed(const language::Diagnostic& diagnostic) {
  if (diagnostic.position.file == nullptr) return diagnostic.message;
  const language::LineColumn place = language::line_and_column(diagnostic.position);
  return fmt::format("{}:{}:{}: {}", diagnostic.position.file->path, place.line, place.column,
                     diagnostic.message);
}

}  // namespace

QuietApplication::QuietApplication(application::Consent consent)
    : received_(std::make_shared<Received>()),
      application_(std::make_unique<application::Application>(
          consent, [told = received_](const language::Diagnostics& diagnostics) {
            told->last = diagnostics;
            for (const language::Diagnostic& diagnostic : diagnostics.all()) {
              if (diagnostic.severity == language::Severity::warning)
                told->warnings.push_back(placed(diagnostic));
            }
          })) {}

void QuietApplication::fail() const { throw_diagnostics(received_->last); }

std::vector<std::string> QuietApplication::take_warnings() {
  return std::exchange(received_->warnings, {});
}

void QuietApplication::pass_on_warnings() {
  for (const std::string& warning : take_warnings()) warn(warning);
}

std::string warning_of_step(const simulation::Experiment& experiment) {
  return simulation::step_warning(experiment).value_or("");
}

LoadedFile::LoadedFile(const Source& source) : source_(source), application_(source.consent) {
  if (source_.text) application_->give(source_.file, *source_.text);
  if (const auto world =
          application::world_of_robot(*application_, source_.file, source_.consent)) {
    source_.file = world->file;
    source_.text = world->text;
    application_->give(source_.file, *source_.text);
  }
  if (!application_->load_plugins(source_.file)) application_.fail();
  if (source_.engine)
    engine_settings_ =
        application_->world_settings(source_.file, "engine", *source_.engine, source_.settings);
  std::vector<std::string> settings = source_.settings;
  settings.insert(settings.end(), engine_settings_.begin(), engine_settings_.end());
  const auto root = application_->evaluate(source_.file, settings);
  if (!root) application_.fail();
  experiment_ = application_->load(*root);
  if (!experiment_) application_.fail();
  simulation::write_chosen_step(*experiment_, *root);
  text_ = language::print(*root);
  sources_ = language::sources_of(*root);
  language::Diagnostics unreported;
  for (const language::ParameterDeclaration& declared :
       application_->library().parameters(source_.file, unreported))
    declares_seed_ = declares_seed_ || declared.name == seed_parameter;
  notices_ = application_.take_warnings();
  if (std::string warning = warning_of_step(*experiment_); !warning.empty())
    notices_.push_back(std::move(warning));
  for (const std::string& notice : notices_) warn(notice);
}

language::EvaluateOptions LoadedFile::options_of(const Variant& variant) const {
  std::vector<std::string> settings = variant.settings;
  settings.insert(settings.end(), engine_settings_.begin(), engine_settings_.end());
  if (variant.seed) {
    const std::string seed = std::to_string(*variant.seed);
    const std::string parameter = std::string(seed_parameter) + "=";
    const bool given = std::ranges::any_of(
        settings, [&](const std::string& setting) { return setting.starts_with(parameter); });
    if (declares_seed_ && !given) settings.push_back(parameter + seed);
    settings.push_back(experiment_->world + ".seed=" + seed);
  }
  return application::options_from(settings);
}

LoadedFile::LoadedVariant LoadedFile::load_variant(const Variant& variant) {
  LoadedVariant loaded;
  if (variant.settings == source_.settings && !(variant.seed && declares_seed_)) {
    loaded.experiment = experiment_;
    if (variant.seed) loaded.experiment->seed = *variant.seed;
    return loaded;
  }
  language::Library& library = application_->library();
  const auto root = library.evaluate(source_.file, options_of(variant), loaded.diagnostics);
  if (root)
    loaded.experiment =
        simulation::load_experiment(*root, loaded.diagnostics, library.search_path());
  return loaded;
}

std::string LoadedFile::text_of(const Variant& variant, const simulation::Experiment& experiment) {
  language::Diagnostics diagnostics;
  language::EvaluateOptions options = options_of(variant);
  if (!variant.seed)
    options.overrides.push_back({experiment_->world + ".seed", std::to_string(experiment.seed)});
  const auto root = application_->library().evaluate(source_.file, options, diagnostics);
  if (!root) throw_diagnostics(diagnostics);
  simulation::write_chosen_step(experiment, *root);
  return language::print(*root);
}

std::vector<std::string> LoadedFile::settings_with(const std::string& field,
                                                   const std::string& value) {
  std::vector<std::string> settings = source_.settings;
  settings.insert(settings.end(), engine_settings_.begin(), engine_settings_.end());
  for (std::string& setting :
       application_->world_settings(source_.file, field, value, source_.settings))
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
