#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "studies/calibrate/calibration_method.h"
#include "studies/calibrate/intervals.h"
#include "studies/calibrate/profiles.h"
#include "studies/calibrate/resampling.h"

namespace hookpoint::studies {
namespace {

/// A run is a smooth function of its constants but for small jumps, where a point touches a step
/// earlier or later: differences are wider than those.
constexpr FitOptions fit_of_runs{5e-4, 60, 1e-8}, refit_of_runs{5e-4, 30, 1e-6};
/// Rounds of the search along the axes.
constexpr std::size_t axis_rounds = 3;

/// The sum of all squares, by derivatives.
class SquaresMethod final : public CalibrationMethod {
 public:
  explicit SquaresMethod(SubjectFit& fit) : fit_(fit) {}

  static std::size_t rows_of(const CalibrationPlan& plan, std::size_t constants) {
    return constants + 2 + plan.starts + refined_starts +
           axis_rounds * (axis_points * constants + refined_starts) +
           (plan.resamples == 0 ? 0 : rows_of_profiles(constants)) +
           (plan.bootstrap == Bootstrap::refits ? plan.resamples : 0) + fold_count(plan);
  }

  std::optional<double> error_over(const Cases&, const Residuals& residuals) const override {
    return std::ranges::any_of(residuals, [](double one) { return std::isnan(one); })
               ? std::nullopt
               : error_of(residuals);
  }

  bool search() override {
    const std::vector<UnitPoint> all = starts();
    const auto evaluated = evaluate_all("start", all);
    record(FitStage::start, evaluated, all);
    stop_if_unfinished(evaluated);
    const std::vector<UnitPoint> best = best_of(evaluated);
    if (best.empty()) {
      fit_.result.status = "no run has a value: " + evaluated.front()->status;
      return false;
    }
    const auto refined = refine_all(best);
    record(FitStage::refined, refined, best);
    stop_if_unfinished(refined);
    for (std::size_t round = 0; round < axis_rounds && search_axes(round); ++round) continue;
    linearise_at_optimum();
    return true;
  }

  void intervals() override {
    if (optimum_.residuals.empty() || fit_.plan.resamples == 0) return;
    const Profiles profiles = find_profiles(fit_, measure());
    linearise_at_optimum();
    fit_.result.block =
        fit_.plan.resamples_cases() ? 0 : block_length(optimum_.residuals, trace_sizes());
    const auto fit = [&](std::size_t i) {
      std::mt19937_64 random = fit_.random_of(i);
      const LeastSquaresFit found =
          fit_.plan.resamples_cases() ? fit_drawn_cases(random) : fit_drawn_blocks(random);
      return outcome_of(found, fit_.plan.residuals());
    };
    std::vector<UnitPoint> points;
    if (fit_.plan.bootstrap == Bootstrap::one_step) {
      for (std::size_t i = 0; i < fit_.plan.resamples; ++i) points.push_back(fit(i).point);
    } else {
      const auto outcomes = fit_.run(
          {fit_.plan.resamples,
           [&](std::size_t i) { return fit_.identity("resample", i, optimum_.point); }, fit});
      for (std::size_t i = 0; i < outcomes.size(); ++i) {
        if (!outcomes[i]) continue;
        const FitOutcome& outcome = *outcomes[i];
        points.push_back(outcome.point);
        fit_.result.records.push_back(
            {FitStage::resample, i + 1, outcome.point, outcome.error, outcome.models, "ok"});
      }
      stop_if_unfinished(outcomes);
    }
    set_intervals(fit_, profiles);
    set_correlations(fit_, points);
  }

  void folds() override {
    const std::size_t count = fold_count(fit_.plan);
    if (count == 0 || optimum_.residuals.empty()) return;
    const auto parts = fit_.folds_of_cases({});
    const auto outcomes =
        fit_.run({count, [&](std::size_t i) { return fit_.identity("fold", i, optimum_.point); },
                  [&](std::size_t i) {
                    const Linearisation start = optimum_over(parts.training[i]);
                    const LeastSquaresFit fit =
                        refine(model_of(parts.training[i]), start, refit_of_runs);
                    const auto out = fit_.model.residuals(fit.point, parts.held[i]);
                    FitOutcome outcome = outcome_of(fit, start.residuals.size());
                    if (out) outcome.held_out = error_of(*out);
                    return outcome;
                  }});
    for (std::size_t i = 0; i < count; ++i) {
      if (!outcomes[i]) continue;
      const FitOutcome& outcome = *outcomes[i];
      fit_.result.folds.push_back({parts.held[i], outcome.error, outcome.held_out, outcome.point});
      fit_.result.records.push_back(
          {FitStage::fold, i + 1, outcome.point, outcome.error, outcome.models, "ok"});
    }
    stop_if_unfinished(outcomes);
  }

 private:
  /// Squares of independent residuals; of enough cases their sums, which also say how much cases
  /// differ.
  FitMeasure measure() const {
    FitMeasure squares{fit_.cases};
    squares.error = [](const Residuals& residuals) { return error_of(residuals); };
    squares.to_squares = [](const Residuals& residuals, const Residuals&) { return residuals; };
    squares.excess_over = [this](const Residuals& at_optimum) -> Excess {
      if (!fit_.plan.resamples_cases())
        return excess_of_squares(at_optimum, fit_.subject.constants.size(),
                                 statistical_inefficiency(at_optimum, trace_sizes()));
      PairedThings things{squares_of_cases(at_optimum)};
      things.count = static_cast<double>(fit_.plan.cases.size());
      things.equal =
          static_cast<double>(at_optimum.size()) / things.count * equal_errors * equal_errors;
      things.limits_largest = true;
      return [this, things](const Residuals& residuals) {
        return paired_excess(things, squares_of_cases(residuals));
      };
    };
    return squares;
  }

  std::vector<double> squares_of_cases(const Residuals& residuals) const {
    std::vector<double> sums;
    auto from = residuals.begin();
    for (const CalibrationCase& one : fit_.plan.cases) {
      const auto to = from + static_cast<std::ptrdiff_t>(one.residuals());
      sums.push_back(std::inner_product(from, to, from, 0.));
      from = to;
    }
    return sums;
  }

  ResidualModel model_of(const Cases& cases) const {
    return [this, &cases](const UnitPoint& point) { return fit_.model.residuals(point, cases); };
  }

  /// Those, then points all over the box.
  std::vector<UnitPoint> starts() const {
    return spread_starts(fit_.subject.constants.size(), fit_.first_guesses(), fit_.plan.starts,
                         fit_.plan.seed);
  }

  /// Looks for other valleys along each constant's axis through the optimum, over its whole range,
  /// and refines from the best of them: they may be better, or explain the data as well. Whether
  /// that found a better optimum by more than equal_errors.
  bool search_axes(std::size_t round) {
    const UnitPoint optimum = fit_.best_point();
    const double error = *fit_.result.error;
    const std::vector<UnitPoint> points = points_on_axes(optimum);
    const auto evaluated = evaluate_all("axis", points);
    record(FitStage::axis, evaluated, points, round * points.size());
    stop_if_unfinished(evaluated);
    std::vector<UnitPoint> best = best_of(axis_valleys(evaluated, optimum, error));
    const auto refined = refine_all(best);
    record(FitStage::refined, refined, best, refined_starts * (round + 1));
    stop_if_unfinished(refined);
    return *fit_.result.error < error - equal_errors * std::max(1., error);
  }

  /// Those that are better than the optimum, or a least one of their axis that is not in the
  /// optimum's own valley.
  std::vector<std::optional<FitOutcome>> axis_valleys(
      const std::vector<std::optional<FitOutcome>>& evaluated, const UnitPoint& optimum,
      double error) const {
    std::vector<std::optional<FitOutcome>> valleys;
    const auto error_at = [&](std::size_t number) {
      return evaluated[number]->error.value_or(std::numeric_limits<double>::infinity());
    };
    for (std::size_t number = 0; number < evaluated.size(); ++number) {
      if (!evaluated[number]->error) continue;
      const std::size_t constant = number / axis_points, part = number % axis_points;
      const double here = error_at(number);
      const double distance = std::abs(evaluated[number]->point[constant] - optimum[constant]);
      const bool least = (part == 0 || here <= error_at(number - 1)) &&
                         (part + 1 == axis_points || here <= error_at(number + 1));
      if (here < error || (least && distance * axis_points > 1.))
        valleys.push_back(evaluated[number]);
    }
    return valleys;
  }

  std::vector<std::optional<FitOutcome>> evaluate_all(const char* stage,
                                                      const std::vector<UnitPoint>& points) {
    return fit_.run(
        {points.size(), [&](std::size_t i) { return fit_.identity(stage, i, points[i]); },
         [&](std::size_t i) {
           std::string why;
           const auto residuals = fit_.model.residuals(points[i], fit_.cases, &why);
           if (!residuals) return outcome_without_value(why);
           return FitOutcome{"ok", error_of(*residuals), std::nullopt, 1, points[i], {}};
         }});
  }

  std::vector<std::optional<FitOutcome>> refine_all(const std::vector<UnitPoint>& from) {
    return fit_.run({from.size(),
                     [&](std::size_t i) { return fit_.identity("refined", i, from[i]); },
                     [&](std::size_t i) {
                       const auto fit = refine(model_of(fit_.cases), from[i], fit_of_runs);
                       return fit ? outcome_of(*fit, fit_.plan.residuals())
                                  : outcome_without_value("no run beside it has a value");
                     }});
  }

  static FitOutcome outcome_of(const LeastSquaresFit& fit, std::size_t samples) {
    return {"ok",         std::sqrt(fit.sum / static_cast<double>(samples)),
            std::nullopt, fit.models,
            fit.point,    {}};
  }

  /// The points with the least errors.
  static std::vector<UnitPoint> best_of(const std::vector<std::optional<FitOutcome>>& evaluated) {
    std::vector<const FitOutcome*> valued;
    for (const auto& outcome : evaluated)
      if (outcome->error) valued.push_back(&*outcome);
    std::ranges::stable_sort(valued, {}, [](const FitOutcome* one) { return *one->error; });
    std::vector<UnitPoint> best;
    for (std::size_t i = 0; i < std::min(refined_starts, valued.size()); ++i)
      best.push_back(valued[i]->point);
    return best;
  }

  /// Keeps what was found, and takes the best for the answer so far.
  void record(FitStage stage, const std::vector<std::optional<FitOutcome>>& outcomes,
              const std::vector<UnitPoint>& asked, std::size_t first = 0) {
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      if (!outcomes[i]) continue;
      const FitOutcome& outcome = *outcomes[i];
      const FitRecord& one = fit_.result.records.emplace_back(
          FitRecord{stage, first + i + 1, outcome.error ? outcome.point : asked[i], outcome.error,
                    outcome.models, outcome.status});
      if (!one.error || (fit_.result.error && !(*one.error < *fit_.result.error))) continue;
      fit_.result.error = one.error;
      fit_.adopt(one.point);
    }
  }

  void linearise_at_optimum() {
    auto found = linearise(model_of(fit_.cases), fit_.best_point(), fit_of_runs.difference);
    if (!found) return;
    optimum_ = std::move(*found);
    fit_.result.residuals = optimum_.residuals;
  }

  /// The part of the optimum's residuals and derivatives that is of these cases.
  Linearisation optimum_over(const Cases& cases) const {
    Linearisation part{optimum_.point, {}, std::vector<Residuals>(optimum_.derivative.size())};
    std::vector<std::size_t> first{0};
    for (const CalibrationCase& one : fit_.plan.cases)
      first.push_back(first.back() + one.residuals());
    const auto take = [&](const Residuals& from, Residuals& into) {
      for (const std::size_t one : cases)
        into.insert(into.end(), from.begin() + static_cast<std::ptrdiff_t>(first[one]),
                    from.begin() + static_cast<std::ptrdiff_t>(first[one + 1]));
    };
    take(optimum_.residuals, part.residuals);
    for (std::size_t i = 0; i < part.derivative.size(); ++i)
      take(optimum_.derivative[i], part.derivative[i]);
    return part;
  }

  std::vector<std::size_t> trace_sizes() const {
    std::vector<std::size_t> sizes;
    for (const CalibrationCase& one : fit_.plan.cases)
      for (const TracePlan& trace : one.traces)
        sizes.insert(sizes.end(), trace.residuals_a_sample(), trace.measured.time.size());
    return sizes;
  }

  LeastSquaresFit fit_sample(const ResidualModel& model, const Linearisation& start) const {
    if (fit_.plan.bootstrap == Bootstrap::refits) return refine(model, start, refit_of_runs);
    UnitPoint point = start.point;
    const UnitPoint step = gauss_newton_step(start);
    for (std::size_t i = 0; i < point.size(); ++i)
      point[i] = std::clamp(point[i] + step[i], 0., 1.);
    return {std::move(point), sum_of_squares(start.residuals), 0};
  }

  /// Whole cases drawn again; one that is drawn m times counts sqrt(m) in each residual.
  LeastSquaresFit fit_drawn_cases(std::mt19937_64& random) const {
    const std::vector<int> times = draw_with_replacement(fit_.plan.cases.size(), random);
    Cases drawn;
    std::vector<double> factor;
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (times[i] == 0) continue;
      drawn.push_back(i);
      factor.insert(factor.end(), fit_.plan.cases[i].residuals(),
                    std::sqrt(static_cast<double>(times[i])));
    }
    const auto weigh = [&](Residuals& residuals) {
      for (std::size_t i = 0; i < residuals.size(); ++i) residuals[i] *= factor[i];
    };
    Linearisation start = optimum_over(drawn);
    weigh(start.residuals);
    for (Residuals& column : start.derivative) weigh(column);
    const ResidualModel plain = model_of(drawn);
    return fit_sample(
        [&](const UnitPoint& point) {
          auto residuals = plain(point);
          if (residuals) weigh(*residuals);
          return residuals;
        },
        start);
  }

  /// The same runs with their residuals drawn again.
  LeastSquaresFit fit_drawn_blocks(std::mt19937_64& random) const {
    const Residuals shift = shift_of_blocks(optimum_.residuals, trace_sizes(), fit_.result.block,
                                            fit_.subject.constants.size(), random);
    const auto move = [&](Residuals& residuals) {
      for (std::size_t i = 0; i < residuals.size(); ++i) residuals[i] += shift[i];
    };
    Linearisation start = optimum_;
    move(start.residuals);
    const ResidualModel plain = model_of(fit_.cases);
    return fit_sample(
        [&](const UnitPoint& point) {
          auto residuals = plain(point);
          if (residuals) move(*residuals);
          return residuals;
        },
        start);
  }

  SubjectFit& fit_;
  Linearisation optimum_;
};

}  // namespace

const MethodDefinition fit_by_squares{&SquaresMethod::rows_of,
                                      [](SubjectFit& fit) -> std::unique_ptr<CalibrationMethod> {
                                        return std::make_unique<SquaresMethod>(fit);
                                      }};

}  // namespace hookpoint::studies
