#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "studies/calibrate/calibration_method.h"
#include "studies/calibrate/intervals.h"
#include "studies/calibrate/profiles.h"
#include "studies/calibrate/resampling.h"
#include "studies/calibrate/response_surface.h"
#include "studies/measurements/trace_residual.h"
#include "studies/results/statistics.h"
#include "studies/search/optimiser.h"

namespace hookpoint::studies {
namespace {

/// Rounds of a search after CMA-ES, and evaluations of each.
constexpr int surface_rounds = 3;
constexpr std::size_t surface_evaluations = 4;
/// Distances within this part of their mean count as squares in a refit, which needs derivatives.
constexpr double smoothing = 0.3;
/// A fold's search that begins where the first one ended has this width at first [parts of the
/// range], and takes half of the generations.
constexpr double width_of_a_fold = 0.3;

int generations_of_folds(const CalibrationPlan& plan) {
  return folds_search_whole_box(plan) ? plan.generations : (plan.generations + 1) / 2;
}

std::size_t evaluations_of_a_search(const CalibrationPlan& plan, int generations) {
  return static_cast<std::size_t>(plan.population) * static_cast<std::size_t>(generations) +
         surface_rounds * surface_evaluations;
}

/// The point with the least error over its cases, each counted `times`; null where none ran.
const FitOutcome* best_point_of(const std::vector<FitOutcome>& evaluated,
                                const std::vector<int>& times) {
  const FitOutcome* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const FitOutcome& outcome : evaluated) {
    if (!outcome.error) continue;
    const double sum =
        std::inner_product(outcome.cases.begin(), outcome.cases.end(), times.begin(), 0.);
    if (!(sum < least)) continue;
    least = sum;
    best = &outcome;
  }
  return best;
}

/// What a search of cases found.
struct DistanceSearch {
  std::size_t cases = 0;
  std::vector<FitOutcome> evaluated{};  ///< at every point, in order
  std::optional<ResponseSurface> surface{};

  void fit_surface() {
    std::vector<PlacedErrors> valued;
    for (const FitOutcome& outcome : evaluated)
      if (outcome.error) valued.push_back({outcome.point, outcome.cases});
    surface = ResponseSurface::fit(std::move(valued));
  }
  /// Where the error is least, with each case counted `times`: of the surface, and where that
  /// has no least point the best that was evaluated; nothing where no point has a value.
  std::optional<UnitPoint> least(const std::vector<int>& times) const {
    if (surface)
      if (auto point = surface->least(times)) return point;
    const FitOutcome* best = best_point_of(evaluated, times);
    return best == nullptr ? std::nullopt : std::optional(best->point);
  }
  /// The best that was evaluated; null where none ran.
  const FitOutcome* best() const { return best_point_of(evaluated, std::vector<int>(cases, 1)); }
};

/// The mean distance, without derivatives: CMA-ES and a response surface.
class DistanceMethod final : public CalibrationMethod {
 public:
  explicit DistanceMethod(SubjectFit& fit) : fit_(fit) {}

  static std::size_t rows_of(const CalibrationPlan& plan, std::size_t constants) {
    return constants + evaluations_of_a_search(plan, plan.generations) +
           (plan.resamples == 0 ? 0 : rows_of_profiles(constants)) +
           fold_count(plan) * evaluations_of_a_search(plan, generations_of_folds(plan));
  }

  std::optional<double> error_over(const Cases& cases, const Residuals& residuals) const override {
    const std::vector<double> each = distances(cases, residuals);
    return each.empty() ? std::nullopt : std::optional(mean_by_fours(each));
  }

  bool search() override {
    found_ = search_cases(0, fit_.drawn_cases());
    for (std::size_t i = 0; i < found_.evaluated.size(); ++i)
      fit_.result.records.push_back({FitStage::search, i + 1, found_.evaluated[i].point,
                                     found_.evaluated[i].error, found_.evaluated[i].models,
                                     found_.evaluated[i].status});
    const FitOutcome* best = found_.best();
    if (best == nullptr) {
      fit_.result.status = "no run has a value: " + found_.evaluated.front().status;
      return false;
    }
    fit_.result.error = best->error;
    fit_.adopt(best->point);
    return true;
  }

  /// By profiles; of each sample of the bootstrap the point where the surface is least, without a
  /// run.
  void intervals() override {
    if (fit_.plan.resamples == 0) return;
    const Cases cases = fit_.drawn_cases();
    const FitMeasure distances = measure(cases);
    polish(fit_, distances);
    set_intervals(fit_, find_profiles(fit_, distances));
    std::vector<UnitPoint> points;
    for (std::size_t i = 0; i < fit_.plan.resamples; ++i) {
      std::mt19937_64 random = fit_.random_of(i);
      points.push_back(*found_.least(draw_with_replacement(cases.size(), random)));
    }
    set_correlations(fit_, points);
  }

  /// Each case by constants that were fitted without it; without folds by those of all. A fold's
  /// search begins where the first one ended, and so none holds out what that has evaluated.
  void folds() override {
    if (fold_count(fit_.plan) == 0) {
      fit_.result.residuals = fit_.predict(fit_.best_point(), fit_.cases);
      return;
    }
    const bool whole_box = folds_search_whole_box(fit_.plan);
    const auto [held, training] = fit_.folds_of_cases(whole_box ? Cases() : fit_.drawn_cases());
    const auto about = whole_box ? std::nullopt : std::optional(fit_.best_point());
    std::vector<Residuals> each(fit_.cases.size());
    for (std::size_t i = 0; i < held.size(); ++i) {
      if (held[i].empty()) continue;
      const Cases cases = fit_.drawn_cases(training[i], i + 1);
      const DistanceSearch found = search_cases(i + 1, cases, about);
      const FitOutcome* best = found.best();
      if (best == nullptr) continue;
      const Residuals out = fit_.predict(best->point, held[i]);
      fit_.result.folds.push_back(
          {held[i], best->error, error_over(held[i], out), best->point,
           predict_error(best->point, unseen(training[i], cases, i + 1, held[i].size()),
                         held[i].size())});
      fit_.result.records.push_back(
          {FitStage::fold, i + 1, best->point, best->error, found.evaluated.size(), best->status});
      auto from = out.begin();
      for (const std::size_t one : held[i]) {
        const auto size = static_cast<std::ptrdiff_t>(fit_.plan.cases[one].residuals());
        each[one].assign(from, from + size);
        from += size;
      }
    }
    for (std::size_t i = 0; i < each.size(); ++i) {
      if (each[i].empty())
        each[i].assign(fit_.plan.cases[i].residuals(), std::numeric_limits<double>::quiet_NaN());
      fit_.result.residuals.insert(fit_.result.residuals.end(), each[i].begin(), each[i].end());
    }
  }

 private:
  /// Mean weighted distance of each of these cases that ran.
  std::vector<double> distances(const Cases& cases, const Residuals& residuals) const {
    std::vector<double> each;
    std::size_t first = 0;
    for (const std::size_t one : cases) {
      const std::size_t size = fit_.plan.cases[one].residuals();
      const double error =
          mean_distance(fit_.plan.cases[one].traces, std::span(residuals).subspan(first, size));
      first += size;
      if (!std::isnan(error)) each.push_back(error);
    }
    return each;
  }

  /// Mean distance of each of these cases at a point.
  FitOutcome evaluate(const UnitPoint& point, const Cases& cases) const {
    FitOutcome outcome{"ok", std::nullopt, std::nullopt, 1, point, {}};
    for (const std::size_t one : cases) {
      std::string why;
      const auto residuals = fit_.model.residuals(point, std::span(&one, 1), &why);
      if (!residuals) return outcome_without_value(why);
      outcome.cases.push_back(mean_distance(fit_.plan.cases[one].traces, *residuals));
    }
    outcome.error = mean_by_fours(outcome.cases);
    return outcome;
  }

  /// CMA-ES over these cases, then rounds of evaluations where the surface over its points is
  /// least: for the cases as they are, and for samples of them, so that points lie as close as the
  /// cases tell them apart. `number`: 0, all over the box; or the fold, `about` a point.
  DistanceSearch search_cases(std::size_t number, const Cases& cases,
                              const std::optional<UnitPoint>& about = std::nullopt) {
    DistanceSearch found{cases.size()};
    const int generations = number == 0 ? fit_.plan.generations : generations_of_folds(fit_.plan);
    const auto evaluate_batch = [&](std::span<const UnitPoint> points, int generation) {
      const auto outcomes =
          fit_.run({points.size(),
                    [&](std::size_t i) {
                      return fit_.identity(fmt::format("search {} {}", number, generation).c_str(),
                                           i, points[i]);
                    },
                    [&](std::size_t i) { return evaluate(points[i], cases); }});
      stop_if_unfinished(outcomes);
      std::vector<Score> scores;
      for (const auto& outcome : outcomes) {
        scores.push_back(outcome->error ? Score{{*outcome->error}, 0.} : Score{{0.}, 1.});
        found.evaluated.push_back(*outcome);
      }
      return scores;
    };
    studies::search(
        {SearchMethod::cmaes, fit_.subject.constants.size(), 1, fit_.plan.population, generations,
         fit_.plan.seed + number, about ? std::vector<UnitPoint>{*about} : fit_.first_guesses(),
         about ? width_of_a_fold : 1.},
        evaluate_batch);
    found.fit_surface();
    if (found.best() == nullptr) return found;
    std::mt19937_64 random = fit_.random_of(streams_of_surfaces + number);
    for (int round = 0; round < surface_rounds; ++round, found.fit_surface()) {
      std::vector<UnitPoint> points{*found.least(std::vector<int>(cases.size(), 1))};
      while (points.size() < surface_evaluations)
        points.push_back(*found.least(draw_with_replacement(cases.size(), random)));
      evaluate_batch(points, generations + round);
    }
    return found;
  }

  /// Mean distances; of enough cases compared case by case, else sample by sample.
  FitMeasure measure(const Cases& cases) const {
    FitMeasure mean{cases};
    mean.error = [this, cases](const Residuals& residuals) {
      return std::optional(mean_by_fours(distances(cases, residuals)));
    };
    mean.to_squares = [this, cases](const Residuals& residuals, const Residuals& from) {
      return roots_of_distances(cases, residuals, smoothing * mean_of(cases, from));
    };
    const bool by_case = cases.size() >= least_cases_to_resample;
    mean.excess_over = [this, cases, by_case](const Residuals& at_optimum) -> Excess {
      PairedThings things{by_case ? distances(cases, at_optimum) : parts(cases, at_optimum)};
      const auto count = static_cast<double>(things.at_optimum.size());
      things.limits_largest = by_case;
      if (!by_case) things.worth = statistical_inefficiency(at_optimum, curve_sizes(cases));
      things.count =
          by_case ? count
                  : count / things.worth - static_cast<double>(fit_.subject.constants.size()) + 1.;
      things.equal = equal_errors * std::max(1., mean_of(cases, at_optimum));
      if (by_case)
        return [this, cases, things](const Residuals& residuals) {
          return paired_excess(things, distances(cases, residuals));
        };
      return [this, cases, things, at_optimum](const Residuals& residuals) {
        return paired_excess(things, parts(cases, residuals), scores(cases, residuals, at_optimum));
      };
    };
    return mean;
  }

  double mean_of(const Cases& cases, const Residuals& residuals) const {
    return mean_by_fours(distances(cases, residuals));
  }

  /// Calls `visit(trace, sample, index of the trace's first residual, its part of the mean)` for
  /// every sample.
  template <class Visit>
  void for_each_sample(const Cases& cases, Visit visit) const {
    std::size_t first = 0;
    for (const std::size_t one : cases) {
      const auto& traces = fit_.plan.cases[one].traces;
      for (const TracePlan& trace : traces) {
        const std::size_t samples = trace.measured.time.size();
        const double part = 1. / static_cast<double>(cases.size() * traces.size() * samples);
        for (std::size_t sample = 0; sample < samples; ++sample) visit(trace, sample, first, part);
        first += trace.residuals();
      }
    }
  }

  /// The parts of all samples, whose mean is the mean distance.
  std::vector<double> parts(const Cases& cases, const Residuals& residuals) const {
    std::vector<double> each;
    for_each_sample(
        cases, [&](const TracePlan& trace, std::size_t sample, std::size_t first, double part) {
          each.push_back(part * distance(trace, sample,
                                         std::span(residuals).subspan(first, trace.residuals())));
        });
    for (double& one : each) one *= static_cast<double>(each.size());
    return each;
  }

  /// Of every sample by how much its part may change with a move of its residuals: the part of the
  /// move that is along the residuals, on average over their directions.
  std::vector<double> scores(const Cases& cases, const Residuals& residuals,
                             const Residuals& at_optimum) const {
    Residuals moved = residuals;
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] -= at_optimum[i];
    std::vector<double> each = parts(cases, moved);
    std::size_t at = 0;
    for_each_sample(cases, [&](const TracePlan& trace, std::size_t, std::size_t, double) {
      each[at++] /= std::sqrt(static_cast<double>(trace.residuals_a_sample()));
    });
    return each;
  }

  /// Residuals whose sum of squares is the mean distance, smooth within `width` of 0: a distance d
  /// counts as sqrt(d^2 + width^2) - width.
  Residuals roots_of_distances(const Cases& cases, const Residuals& residuals, double width) const {
    Residuals roots = residuals;
    const double least = std::max(width, 1e-9);
    for_each_sample(
        cases, [&](const TracePlan& trace, std::size_t sample, std::size_t first, double part) {
          const auto of_trace = std::span(residuals).subspan(first, trace.residuals());
          const double far = distance(trace, sample, of_trace);
          // (sqrt(d^2 + w^2) - w)/d^2 = 1/(sqrt(d^2 + w^2) + w).
          const double factor = std::sqrt(part / (std::hypot(far, least) + least));
          for (std::size_t at = sample; at < of_trace.size(); at += trace.measured.time.size())
            roots[first + at] *= factor;
        });
    return roots;
  }

  std::vector<std::size_t> curve_sizes(const Cases& cases) const {
    std::vector<std::size_t> sizes;
    for (const std::size_t one : cases)
      for (const TracePlan& trace : fit_.plan.cases[one].traces)
        sizes.insert(sizes.end(), trace.residuals_a_sample(), trace.measured.time.size());
    return sizes;
  }

  /// Of the cases that a search may see at most so many that it has not evaluated, in their order.
  Cases unseen(const Cases& may_see, const Cases& evaluated, std::size_t number,
               std::size_t most) const {
    Cases others;
    std::ranges::set_difference(may_see, evaluated, std::back_inserter(others));
    return fit_.drawn_from(std::move(others), streams_of_predictions + number, most);
  }

  /// Where the error of `held` cases will be, by what these constants leave of others. The means of
  /// n and m cases out of many that spread by s differ by t s sqrt(1/n + 1/m) at most, with a
  /// chance of 95 % (Student's t of n - 1 degrees of freedom).
  std::optional<PredictionInterval> predict_error(const UnitPoint& point, const Cases& others,
                                                  std::size_t held) const {
    const std::vector<double> each = distances(others, fit_.predict(point, others));
    if (each.size() < 2) return std::nullopt;
    const double middle = mean_by_fours(each), count = static_cast<double>(each.size());
    double squares = 0.;
    for (const double one : each) squares += (one - middle) * (one - middle);
    const double spread = std::sqrt(squares / (count - 1.));
    const double reach =
        student_quantile(count) * spread * std::sqrt(1. / count + 1. / static_cast<double>(held));
    return PredictionInterval{middle, middle - reach, middle + reach};
  }

  SubjectFit& fit_;
  DistanceSearch found_;  ///< of all cases
};

}  // namespace

const MethodDefinition fit_by_distance{&DistanceMethod::rows_of,
                                       [](SubjectFit& fit) -> std::unique_ptr<CalibrationMethod> {
                                         return std::make_unique<DistanceMethod>(fit);
                                       }};

}  // namespace hookpoint::studies
