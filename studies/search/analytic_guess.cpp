#include "studies/search/analytic_guess.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/force_law.h"
#include "simulation/analysis/advice.h"

namespace hookpoint::studies {
namespace {

using Advised = std::vector<simulation::ConstantAdvice>;

/// What is advised for the scene's material under the first robot that stands on it.
std::optional<Advised> advised_constants(const VariedScene& scene, std::string& why) {
  language::Diagnostics unreported;
  auto own = scene.load({}, 1, unreported);
  if (!own) return std::nullopt;
  simulation::Experiment& experiment = own->experiment;
  if (experiment.engine != "dts" || !contact::find_force_law(experiment.contact)) {
    experiment.engine = "dts";
    experiment.contact = "hookpoint";
  }
  try {
    for (simulation::GroundAdvice& ground : simulation::advise(experiment, {}).grounds)
      if (ground.material == scene.material()) return std::move(ground.constants);
    why = "no robot stands on " + scene.material();
  } catch (const simulation::ExperimentError& error) {
    why = error.what();
  }
  return std::nullopt;
}

const simulation::ConstantAdvice* advice_on(const Advised& advised, const std::string& name) {
  const auto found = std::ranges::find(advised, name, &simulation::ConstantAdvice::name);
  return found == advised.end() ? nullptr : &*found;
}

/// Looks for the values of Params with which the Material comes nearest to the advice.
class NearestParameters {
 public:
  NearestParameters(const SearchedScene& searched, const Advised& advised,
                    std::vector<double> start)
      : searched_(searched), advised_(advised), values_(std::move(start)) {}

  /// One Param after the other, each on finer and finer grids, and all once more.
  std::vector<double> find(const std::vector<std::size_t>& parameters) {
    for (int round = 0; round < 2; ++round)
      for (const std::size_t parameter : parameters) refine(parameter);
    return values_;
  }

 private:
  void refine(std::size_t parameter) {
    constexpr int cells = 20, zooms = 4;
    const VariedConstant& constant = searched_.varied[parameter];
    double least = 0., greatest = 1., best = constant.share_of(values_[parameter]);
    double nearest = distance_with(parameter, values_[parameter]);
    for (int zoom = 0; zoom < zooms; ++zoom) {
      const double cell = (greatest - least) / cells;
      for (int i = 0; i <= cells; ++i) {
        const double share = least + i * cell;
        const double distance = distance_with(parameter, constant.at(share));
        if (!(distance < nearest)) continue;
        nearest = distance;
        best = share;
        values_[parameter] = constant.at(share);
      }
      least = std::max(0., best - cell);
      greatest = std::min(1., best + cell);
    }
  }

  double distance_with(std::size_t parameter, double value) const {
    std::vector<double> values = values_;
    values[parameter] = value;
    language::Diagnostics unreported;
    const auto tree = searched_.scene.compose(settings_of(searched_.varied, values), 1, unreported);
    if (tree == nullptr) return std::numeric_limits<double>::infinity();
    const language::Object& material = searched_.scene.material_of(*tree);
    double sum = 0.;
    for (const simulation::ConstantAdvice& constant : advised_) {
      const language::Field* field = material.find(constant.name);
      const bool positive = field != nullptr && !field->numbers.empty() &&
                            field->numbers.front() > 0. && constant.advised > 0.;
      if (!positive) continue;
      const double ratio = std::log(field->numbers.front() / constant.advised);
      sum += ratio * ratio;
    }
    return sum;
  }

  const SearchedScene& searched_;
  const Advised& advised_;
  std::vector<double> values_;
};

}  // namespace

std::optional<AnalyticGuess> analytic_guess(const SearchedScene& searched, std::string& why) {
  const auto advised = advised_constants(searched.scene, why);
  if (!advised) return std::nullopt;
  AnalyticGuess guess;
  std::vector<std::size_t> parameters;
  for (std::size_t i = 0; i < searched.varied.size(); ++i) {
    const VariedConstant& constant = searched.varied[i];
    double value = searched.own[i].value_or(constant.at(0.5));
    const simulation::ConstantAdvice* advice = advice_on(*advised, constant.name);
    if (advice != nullptr) value = constant.unit.from_si(advice->advised);
    // Rounded, and no farther than the range goes.
    guess.values.push_back(constant.at(constant.share_of(value)));
    const bool field = constant.place == ConstantPlace::material_field;
    if (!field && constant.place != ConstantPlace::world_field) parameters.push_back(i);
  }
  guess.values = NearestParameters(searched, *advised, std::move(guess.values)).find(parameters);
  std::string names;
  for (const simulation::ConstantAdvice& constant : *advised)
    names += (names.empty() ? "" : ", ") + constant.name;
  guess.words = "advice on " + searched.scene.material() + " (" + names + ")";
  return guess;
}

}  // namespace hookpoint::studies
