#include "studies/calibrate/subject_fit.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "output/files/hash.h"
#include "studies/calibrate/resampling.h"
#include "studies/measure/workers.h"
#include "studies/search/analytic_guess.h"
#include "text/number.h"

namespace hookpoint::studies {

SubjectFit::SubjectFit(const CalibrationPlan& all, const CalibrationSubject& one,
                       const EngineTable& engines, CachedRuns& cached,
                       const std::atomic<bool>& stop)
    : plan(all),
      subject(one),
      runs(cached),
      model(plan, subject, engines, stop),
      cases(all.cases.size()) {
  std::iota(cases.begin(), cases.end(), std::size_t{0});
  result.left_out = subject.left_out;
}

FitOutcome outcome_without_value(const std::string& why) {
  return {why, std::nullopt, std::nullopt, 1, UnitPoint{}, {}};
}

std::size_t fold_count(const CalibrationPlan& plan) {
  const std::size_t folds = std::min(plan.folds, plan.cases.size());
  return folds < 2 ? 0 : folds;
}

std::vector<UnitPoint> points_on_axes(const UnitPoint& optimum) {
  std::vector<UnitPoint> points;
  for (std::size_t i = 0; i < optimum.size(); ++i) {
    for (std::size_t part = 0; part < axis_points; ++part) {
      points.push_back(optimum);
      points.back()[i] = (static_cast<double>(part) + 0.5) / axis_points;
    }
  }
  return points;
}

void stop_if_unfinished(const std::vector<std::optional<FitOutcome>>& outcomes) {
  if (!std::ranges::all_of(outcomes, [](const auto& one) { return one.has_value(); }))
    throw CalibrationInterrupted{};
}

Residuals SubjectFit::predict(const UnitPoint& point, const Cases& some) const {
  std::vector<Residuals> each(some.size());
  work_through(some.size(), runs.jobs(), [&](std::size_t i) {
    auto run = model.residuals(point, std::span(some).subspan(i, 1));
    each[i] =
        run ? std::move(*run)
            : Residuals(plan.cases[some[i]].residuals(), std::numeric_limits<double>::quiet_NaN());
    return true;
  });
  Residuals all;
  for (const Residuals& one : each) all.insert(all.end(), one.begin(), one.end());
  return all;
}

UnitPoint SubjectFit::own_or_middle() const {
  UnitPoint point;
  for (const std::size_t constant : subject.constants) {
    const auto& own = plan.own[constant];
    point.push_back(own ? plan.varied[constant].share_of(*own) : 0.5);
  }
  return point;
}

std::vector<UnitPoint> SubjectFit::first_guesses() const {
  std::vector<UnitPoint> first;
  std::vector<VariedConstant> varied;
  std::vector<std::optional<double>> own;
  bool known = true;
  std::vector<std::size_t> of_scene;
  for (std::size_t i = 0; i < subject.constants.size(); ++i) {
    const std::size_t constant = subject.constants[i];
    known = known && plan.own[constant];
    if (plan.offset_of(constant) != nullptr) continue;
    of_scene.push_back(i);
    varied.push_back(plan.varied[constant]);
    own.push_back(plan.own[constant]);
  }
  if (known) first.push_back(own_or_middle());
  std::string ignored;
  if (const auto guess = analytic_guess({*subject.scene, varied, own}, ignored)) {
    UnitPoint& point = first.emplace_back(own_or_middle());
    for (std::size_t i = 0; i < guess->values.size(); ++i)
      point[of_scene[i]] = varied[i].share_of(guess->values[i]);
  }
  return first;
}

void SubjectFit::adopt(const UnitPoint& point) {
  result.constants.clear();
  for (std::size_t i = 0; i < point.size(); ++i)
    result.constants.push_back({subject.constants[i], point[i], std::nullopt, std::nullopt, false,
                                plan.resamples == 0 ? "`resamples = 0`: no interval is searched for"
                                                    : "its interval is not known"});
}

UnitPoint SubjectFit::best_point() const {
  UnitPoint point;
  for (const FittedConstant& constant : result.constants) point.push_back(constant.share);
  return point;
}

std::mt19937_64 SubjectFit::random_of(std::size_t number) const {
  std::seed_seq seeds{static_cast<std::uint32_t>(plan.seed),
                      static_cast<std::uint32_t>(plan.seed >> 32),
                      static_cast<std::uint32_t>(number)};
  return std::mt19937_64(seeds);
}

Cases SubjectFit::drawn_from(Cases from, std::size_t stream, std::size_t most) const {
  if (most >= from.size()) return from;
  std::mt19937_64 random = random_of(stream);
  for (std::size_t i = 0; i < most; ++i) std::swap(from[i], from[i + random() % (from.size() - i)]);
  from.resize(most);
  std::ranges::sort(from);
  return from;
}

Cases SubjectFit::drawn_cases(const Cases& from, std::size_t number) const {
  const std::size_t most = plan.most_cases == 0 ? from.size() : plan.most_cases;
  return drawn_from(from, streams_of_draws + number, most);
}

Folds SubjectFit::folds_of_cases(const Cases& never_held) const {
  const std::size_t folds = fold_count(plan);
  const auto fold = fold_of_each(plan.cases.size(), folds, plan.seed);
  Folds all{std::vector<Cases>(folds), std::vector<Cases>(folds)};
  for (const std::size_t one : cases) {
    const bool seen = std::ranges::binary_search(never_held, one);
    for (std::size_t part = 0; part < folds; ++part)
      (fold[one] == part && !seen ? all.held : all.training)[part].push_back(one);
  }
  return all;
}

std::string SubjectFit::identity(const char* stage, std::size_t number,
                                 const UnitPoint& from) const {
  output::Hash hash;
  hash.add(plan.runs.hash).add(subject.runs_hash).add(stage).add(std::to_string(number));
  for (const double share : from) hash.add(text::shortest(share));
  return hash.text();
}

}  // namespace hookpoint::studies
