#include "apps/shared/translated.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "apps/shared/robot_file.h"
#include "simulation/analysis/carried_load.h"
#include "simulation/analysis/inverse_weight.h"
#include "simulation/experiment/contact_materials.h"
#include "simulation/experiment/ground.h"
#include "text/display.h"

namespace hookpoint::application {
namespace {

using translation::Answer;
using translation::ParameterError;
using translation::Situation;
using translation::Target;

constexpr double weight_of_kilogram = 9.81;  // [N], at the default gravity of a World

constexpr double usual_creep = 1e-3;  // [m/s], on 10 deg, for a law that does not creep

/// A number above 0 with its unit; empty where `text` is. Throws ParameterError.
std::optional<double> number_of(const std::optional<std::string>& text, const char* option,
                                const char* unit, const char* example) {
  if (!text) return std::nullopt;
  const auto value = language::number_of(*text, unit);
  if (value && *value > 0. && std::isfinite(*value)) return value;
  throw ParameterError(fmt::format("{} takes a value above 0 such as \"{}\", not `{}`", option,
                                   example, text::printable(*text)));
}

/// The numbers of the command line; load and mass stay 0 where neither is given.
Situation situation_of(const TranslateRequest& request) {
  Situation at;
  const auto load = number_of(request.load, "--load", "N", "30 N");
  const auto mass = number_of(request.mass, "--mass", "kg", "3 kg");
  at.load = load.value_or(mass.value_or(0.) * weight_of_kilogram);
  at.mass = mass.value_or(load.value_or(0.) / weight_of_kilogram);
  at.contacts = request.contacts.value_or(1);
  at.deltat = number_of(request.step, "--dt", "s", "1 ms").value_or(at.deltat);
  at.radius = number_of(request.radius, "--radius", "m", "20 mm").value_or(at.radius);
  at.area = number_of(request.area, "--area", "m^2", "10 cm^2").value_or(at.area);
  return at;
}

std::vector<const Target*> targets_of(const std::vector<std::string>& names) {
  std::vector<const Target*> found;
  std::vector<std::string_view> known;
  for (const Target* target : translation::targets()) known.push_back(target->name);
  for (const std::string& name : names) {
    const Target* target = translation::find_target(name);
    if (!target)
      throw ParameterError(fmt::format("there is no engine `{}` to translate: give {}",
                                       text::printable(name), fmt::join(known, ", ")));
    found.push_back(target);
  }
  if (names.empty()) found.assign(translation::targets().begin(), translation::targets().end());
  return found;
}

void add_targets(Answer& answer, const TranslateRequest& request) {
  answer.desired.most_creep = number_of(request.creep, "--creep", "m/s", "1 mm/s");
  // The other engine is to hold a foot as the law does, as nearly as it can.
  const bool law_holds = answer.own && answer.own->creep == 0.;
  if (!answer.desired.most_creep && law_holds) answer.desired.most_creep = usual_creep;
  for (const Target* target : targets_of(request.to))
    answer.targets.push_back(translation::translate_to(*target, answer.desired, answer.at));
}

Answer answer_of(const contact::LawDescription& law, const simulation::MaterialSpec& material,
                 const Situation& at, const TranslateRequest& request) {
  Answer answer;
  answer.material = material.name;
  answer.law = std::string(law.name);
  answer.at = at;
  answer.desired = translation::desired_of(law, material.constants, answer.at);
  answer.own = translation::behaviour_of(law, material.constants, answer.at);
  add_targets(answer, request);
  return answer;
}

/// Of an engine's own parameters.
Answer answer_from(const TranslateRequest& request) {
  const Target& source = *targets_of({request.from}).front();
  Answer answer;
  answer.at = situation_of(request);
  if (answer.at.load == 0.)
    throw ParameterError("--from needs --load, what the contact carries, such as --load \"30 N\"");
  translation::Reading reading = translation::read_from(source, request.given, answer.at);
  answer.material = "from_" + request.from;
  answer.desired = reading.desired;
  answer.from = std::move(reading.from);
  if (!request.to.empty()) add_targets(answer, request);
  return answer;
}

/// A World around the materials of a file without one: its name, and the file in text.
std::string world_with(const std::filesystem::path& file, const std::string& material) {
  return fmt::format(
      "World world {{\n  Include {};\n  Terrain.Flat ground {{ material = {}; }}\n}}\n",
      language::quote(file.filename().string()), material);
}

const contact::LawDescription& law_of(const simulation::Experiment& experiment) {
  const contact::LawDescription* law = contact::find_force_law(experiment.contact);
  if (!law)
    throw translation::NothingToTranslate(fmt::format(
        "the law `{}` has no stiffness and no damping to translate: give --contact with a force law",
        experiment.contact));
  return *law;
}

}  // namespace

std::vector<Answer> contacts_of(simulation::Experiment experiment,
                                const TranslateRequest& request) {
  const contact::LawDescription& law = law_of(experiment);
  const Situation given = situation_of(request);
  std::vector<Answer> answers;
  const auto terrain = simulation::make_ground(experiment);
  if (!terrain)
    throw translation::NothingToTranslate(
        "the World has no terrain: there is no contact to translate");
  experiment.engine = "dts";
  const simulation::WorldInputs inputs = simulation::initial_inputs(experiment);
  for (std::size_t robot = 0; robot < experiment.robots.size(); ++robot) {
    for (const simulation::CarriedLoad& carried :
         simulation::carried_loads(experiment, robot, *terrain, inputs)) {
      simulation::MaterialSpec material =
          experiment.materials[static_cast<std::size_t>(carried.material)];
      material.constants =
          simulation::contact_constants(experiment, carried.foot, carried.material);
      if (request.material && material.name != *request.material) continue;
      Situation at = given;
      if (given.load == 0.) {
        at.load = carried.load;
        at.mass = carried.mass;
      }
      if (!request.step) at.deltat = experiment.deltat;
      if (!request.contacts) at.contacts = static_cast<double>(carried.points);
      at.effective_mass = carried.least_mass;
      at.inverse_weight = simulation::inverse_weight(experiment, robot, carried.body);
      if (!(at.load > 0.))
        throw translation::NothingToTranslate(
            "nothing presses on the ground (gravity?): give --load");
      answers.push_back(answer_of(law, material, at, request));
      answers.back().robot = experiment.robots[robot].name;
    }
  }
  return answers;
}

std::optional<std::vector<Answer>> translated(Application& application,
                                              const TranslateRequest& request) {
  if (!request.from.empty()) return std::vector<Answer>{answer_from(request)};
  const Situation given = situation_of(request);
  targets_of(request.to);
  std::filesystem::path file = application.find(request.file);
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    file = application.find("materials/" + request.file + ".hook");
  if (!std::filesystem::exists(file, ignored))
    throw ParameterError(fmt::format("`{}` is neither a file nor a material of configs/materials",
                                     text::printable(request.file)));
  file = file_with_world(application, file, request.consent);
  const auto root = application.evaluate(file, {});
  if (!root) return std::nullopt;
  if (!root->children_of("World").empty()) {
    const auto set = application.evaluate_set(file, request.settings);
    if (!set) return std::nullopt;
    const auto experiment = application.load(*set);
    if (!experiment) return std::nullopt;
    auto answers = contacts_of(*experiment, request);
    if (answers.empty())
      throw ParameterError(
          request.material
              ? fmt::format("no robot rests on a material `{}`", text::printable(*request.material))
              : std::string("no robot rests on the ground of this World"));
    return answers;
  }
  if (given.load == 0.)
    throw ParameterError(
        "a material by itself needs --load, what the contact carries, such as --load \"30 N\"");
  std::vector<Answer> answers;
  for (const language::Object* material : root->children_of("Material")) {
    if (request.material && material->name != *request.material) continue;
    const std::filesystem::path world = file.parent_path() / (file.stem().string() + "_alone.hook");
    application.give(world, world_with(file, material->name));
    const auto around = application.evaluate_set(world, request.settings);
    if (!around) return std::nullopt;
    const auto experiment = application.load(*around);
    if (!experiment) return std::nullopt;
    const auto spec =
        std::ranges::find(experiment->materials, material->name, &simulation::MaterialSpec::name);
    answers.push_back(answer_of(law_of(*experiment), *spec, given, request));
  }
  if (answers.empty())
    throw ParameterError(
        fmt::format("{} holds neither a World nor {}", request.file,
                    request.material ? "a Material `" + *request.material + "`" : "a Material"));
  return answers;
}

}  // namespace hookpoint::application
