#include "studies/calibrate/calibrate.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <random>
#include <span>
#include <utility>

#include "output/text/hash.h"
#include "output/text/number.h"
#include "studies/calibrate/fit_rows.h"
#include "studies/calibrate/model.h"
#include "studies/calibrate/outputs.h"
#include "studies/calibrate/profile.h"
#include "studies/calibrate/resampling.h"
#include "studies/calibrate/response_surface.h"
#include "studies/measurements/trace_residual.h"
#include "studies/tune/guess.h"
#include "studies/tune/optimiser.h"
#include "studies/tune/step_warnings.h"
#include "studies/workers.h"

namespace hookpoint::studies {
namespace {

/// Of an engine. A run is a smooth function of its constants but for small jumps, where a point
/// touches a step earlier or later: differences are taken wide of those.
constexpr FitOptions fit_of_runs{5e-4, 60, 1e-8}, refit_of_runs{5e-4, 30, 1e-6};
/// Places along each constant's axis at which other valleys are looked for; rounds of that.
constexpr std::size_t axis_places = 12, axis_rounds = 3;
/// Of the interval of a constant: at most so many places each side of the optimum.
constexpr ProfileOptions profile_of_runs{{5e-4, 20, 1e-4}, 16, 0.05};
/// A profile that finds a better optimum begins again there, at most so often in all.
constexpr std::size_t profile_rounds = 3;
/// Root mean squares that differ by less than this part of the weight's error are equal: how the
/// numbers of a table are rounded makes more.
constexpr double equal_errors = 1e-6;

/// A constant within this part of its range from an end is at it.
constexpr double end_part = 2e-3;
/// A constant whose interval is a greater part of its range is not identified by the data.
constexpr double widest_interval = 0.5;
/// Places that are farther apart than this part of a range, and than the interval is wide, are two
/// optima.
constexpr double least_gap = 0.01;
/// Of fewer samples 2.5 % are less than one.
constexpr std::size_t least_resamples = 39;
/// Streams of random numbers: those of the bootstrap's samples come before.
constexpr std::size_t streams_of_draws = 1'000'000, streams_of_surfaces = 2'000'000,
                      streams_of_promises = 3'000'000;
/// Rounds of a search after CMA-ES, and looks of each.
constexpr int surface_rounds = 3;
constexpr std::size_t surface_looks = 4;
/// A fold's search that begins where the first one ended is so wide at first [parts of the range],
/// and takes half of the generations.
constexpr double width_of_a_fold = 0.3;
/// Shares of its range at which a constant is tried for whether it changes anything: not
/// symmetrical, since a function of it may be even, and near both ends, since one may be flat
/// between.
constexpr std::array read_at{0.25, 0.75, 0.37, 0.02, 0.98};
/// And the shares of the others, where it changes nothing beside the scene's own: one may decide
/// whether another acts.
constexpr double others_low = 0.02, others_high = 0.98;
/// Of a constant with which every run is the same, bit for bit.
constexpr const char* unread = "no trace changes with it";
/// What became of a profile.
constexpr const char* no_run_beyond = "no run beyond has a value";
constexpr const char* better_optimum = "a better optimum";

using Cases = std::vector<std::size_t>;

Cases all_cases(const CalibrationPlan& plan) {
  Cases cases(plan.cases.size());
  std::iota(cases.begin(), cases.end(), std::size_t{0});
  return cases;
}

FitOutcome look_without_value(const std::string& why) {
  return {why, std::nullopt, std::nullopt, 1, Shares{}, {}};
}

/// One subject's calibration, stage by stage; each needs those before it.
class SubjectFit {
 public:
  SubjectFit(const CalibrationPlan& plan, const CalibrationSubject& subject,
             const EngineTable& engines, FitRows& rows, const std::atomic<bool>& stop)
      : plan_(plan),
        subject_(subject),
        rows_(rows),
        model_(plan, subject_, engines, stop),
        cases_(all_cases(plan)) {
    result_.left_out = subject.left_out;
  }

  /// Rows that it will ask for at most.
  static std::size_t rows_of(const CalibrationPlan& plan, const CalibrationSubject& subject) {
    if (!subject.refusal.empty()) return 0;
    if (plan.method == FitMethod::cmaes)
      return subject.constants.size() + looks_of_a_search(plan, plan.generations) +
             (plan.resamples < least_resamples ? 0 : axis_places * subject.constants.size()) +
             fold_count(plan) * looks_of_a_search(plan, generations_of_folds(plan));
    return subject.constants.size() + 2 + plan.starts + refined_starts +
           axis_rounds * (axis_places * subject.constants.size() + refined_starts) +
           profile_rounds * profiles_of(plan, subject.constants.size()) + refits(plan) +
           fold_count(plan);
  }

  /// False when interrupted; then the result is what was known.
  bool run() {
    const std::size_t first = rows_.count(), total = rows_of(plan_, subject_);
    bool whole = true;
    try {
      fit_all();
    } catch (const CalibrationInterrupted&) {
      whole = false;
      if (result_.status == "ok") result_.status = "interrupted";
    }
    if (whole) rows_.skip(total - (rows_.count() - first));
    return whole;
  }
  SubjectCalibration take() { return std::move(result_); }

 private:
  static std::size_t refits(const CalibrationPlan& plan) {
    return plan.bootstrap == Bootstrap::refits ? plan.resamples : 0;
  }
  /// Ends of intervals that are looked for in a round, and the fit from a better optimum.
  static std::size_t profiles_of(const CalibrationPlan& plan, std::size_t constants) {
    return plan.resamples < least_resamples ? 0 : 2 * constants + 1;
  }
  static std::size_t fold_count(const CalibrationPlan& plan) {
    const std::size_t folds = std::min(plan.folds, plan.cases.size());
    return folds < 2 ? 0 : folds;
  }

  void fit_all() {
    if (!subject_.refusal.empty()) {
      result_.status = subject_.refusal;
      return;
    }
    look_at_own_constants();
    if (plan_.varied.empty()) {
      result_.error = result_.own_error;
      result_.residuals = result_.own_residuals;
      return;
    }
    leave_out_unread();
    if (subject_.constants.empty()) {
      result_.status = "none of the constants changes a trace";
      result_.error = result_.own_error;
      result_.residuals = result_.own_residuals;
      return;
    }
    if (plan_.method == FitMethod::cmaes) {
      if (search_distances()) predict_folds();
      return;
    }
    if (!search_box()) return;
    find_intervals();
    cross_validate();
  }

  void look_at_own_constants() {
    Residuals residuals = predict({}, cases_);
    result_.own_error = error_over(cases_, residuals);
    if (result_.own_error) result_.own_residuals = std::move(residuals);
  }

  /// Residuals of these cases, case after case; those of a run that breaks off are not numbers.
  Residuals predict(const Shares& place, const Cases& cases) const {
    std::vector<Residuals> each(cases.size());
    work_through(cases.size(), rows_.jobs(), [&](std::size_t i) {
      auto run = model_.residuals(place, std::span(cases).subspan(i, 1));
      each[i] = run ? std::move(*run)
                    : Residuals(plan_.cases[cases[i]].residuals(),
                                std::numeric_limits<double>::quiet_NaN());
      return true;
    });
    Residuals all;
    for (const Residuals& one : each) all.insert(all.end(), one.begin(), one.end());
    return all;
  }

  /// The error of these cases, by the plan's method: of all or nothing by squares, of those that
  /// ran by distances.
  std::optional<double> error_over(const Cases& cases, const Residuals& residuals) const {
    if (plan_.method == FitMethod::least_squares)
      return std::ranges::any_of(residuals, [](double one) { return std::isnan(one); })
                 ? std::nullopt
                 : error_of(residuals);
    const std::vector<double> each = distances(cases, residuals);
    return each.empty() ? std::nullopt : std::optional(mean_of(each));
  }

  /// Mean weighted distance of each of these cases that ran.
  std::vector<double> distances(const Cases& cases, const Residuals& residuals) const {
    std::vector<double> each;
    std::size_t first = 0;
    for (const std::size_t one : cases) {
      const std::size_t size = plan_.cases[one].residuals();
      const double error =
          mean_distance(plan_.cases[one].traces, std::span(residuals).subspan(first, size));
      first += size;
      if (!std::isnan(error)) each.push_back(error);
    }
    return each;
  }

  static double mean_of(const std::vector<double>& values) {
    return std::reduce(values.begin(), values.end()) / static_cast<double>(values.size());
  }

  Shares own_or_middle() const {
    Shares place;
    for (const std::size_t constant : subject_.constants) {
      const auto& own = plan_.own[constant];
      place.push_back(own ? plan_.varied[constant].share_of(*own) : 0.5);
    }
    return place;
  }

  /// Whether the residuals change with a constant, or there are none; `models` counts.
  bool changes_with(std::size_t constant, Shares place, const Cases& cases,
                    std::size_t& models) const {
    std::optional<Residuals> first;
    for (const double share : read_at) {
      place[constant] = share;
      auto found = model_.residuals(place, cases);
      ++models;
      if (!found || (first && *found != *first)) return true;
      first = std::move(found);
    }
    return false;
  }

  void leave_out_unread() {
    const Shares middle = own_or_middle();
    const Cases cases = drawn_cases();
    const auto outcomes =
        rows_.run({middle.size(), [&](std::size_t i) { return identity("reads", i, middle); },
                   [&](std::size_t i) {
                     FitOutcome outcome{unread, std::nullopt, std::nullopt, 0, Shares{}, {}};
                     for (const Shares& others : {middle, Shares(middle.size(), others_low),
                                                  Shares(middle.size(), others_high)}) {
                       if (!changes_with(i, others, cases, outcome.models)) continue;
                       outcome.status = "ok";
                       break;
                     }
                     return outcome;
                   }});
    stop_if_unfinished(outcomes);
    std::vector<std::size_t> read;
    for (std::size_t i = 0; i < middle.size(); ++i) {
      const std::size_t constant = subject_.constants[i];
      if (outcomes[i]->status == unread)
        result_.left_out.push_back({constant, unread});
      else
        read.push_back(constant);
    }
    subject_.constants = std::move(read);
  }

  /// The scene's own constants and the analytic guess.
  std::vector<Shares> first_guesses() const {
    std::vector<Shares> first;
    TunePlan guessed;
    guessed.scene = subject_.scene;
    bool known = true;
    std::vector<std::size_t> of_scene;
    for (std::size_t i = 0; i < subject_.constants.size(); ++i) {
      const std::size_t constant = subject_.constants[i];
      known = known && plan_.own[constant];
      if (plan_.offset_of(constant) != nullptr) continue;
      of_scene.push_back(i);
      guessed.varied.push_back(plan_.varied[constant]);
      guessed.own.push_back(plan_.own[constant]);
    }
    if (known) first.push_back(own_or_middle());
    std::string untold;
    if (const auto guess = analytic_guess(guessed, untold)) {
      Shares& place = first.emplace_back(own_or_middle());
      for (std::size_t i = 0; i < guess->values.size(); ++i)
        place[of_scene[i]] = guessed.varied[i].share_of(guess->values[i]);
    }
    return first;
  }

  /// Those, then points all over the box.
  std::vector<Shares> starts() const {
    return spread_starts(subject_.constants.size(), first_guesses(), plan_.starts, plan_.seed);
  }

  ResidualModel model_of(const Cases& cases) const {
    return [this, &cases](const Shares& place) { return model_.residuals(place, cases); };
  }

  /// False when no start has a value.
  bool search_box() {
    const std::vector<Shares> all = starts();
    const auto looked = look_at_all("start", all);
    record(FitStage::start, looked, all);
    stop_if_unfinished(looked);
    const std::vector<Shares> best = best_of(looked);
    if (best.empty()) {
      result_.status = "no run has a value: " + looked.front()->status;
      return false;
    }
    const auto refined = refine_all(best);
    record(FitStage::refined, refined, best);
    stop_if_unfinished(refined);
    for (std::size_t round = 0; round < axis_rounds && search_axes(round); ++round) continue;
    linearise_at_optimum();
    return true;
  }

  /// Places all over the range of each constant, the others as they are.
  static std::vector<Shares> places_on_axes(const Shares& optimum) {
    std::vector<Shares> places;
    for (std::size_t i = 0; i < optimum.size(); ++i) {
      for (std::size_t part = 0; part < axis_places; ++part) {
        places.push_back(optimum);
        places.back()[i] = (static_cast<double>(part) + 0.5) / axis_places;
      }
    }
    return places;
  }

  /// Looks for other valleys along each constant's axis through the optimum, over its whole range,
  /// and refines from the best of them: they may be better, or explain the data as well. Whether
  /// that found a better optimum by more than equal_errors.
  bool search_axes(std::size_t round) {
    const Shares optimum = place_of_answer();
    const double error = *result_.error;
    const std::vector<Shares> places = places_on_axes(optimum);
    const auto looked = look_at_all("axis", places);
    record(FitStage::axis, looked, places, round * places.size());
    stop_if_unfinished(looked);
    std::vector<Shares> best = best_of(axis_valleys(looked, optimum, error));
    const auto refined = refine_all(best);
    record(FitStage::refined, refined, best, refined_starts * (round + 1));
    stop_if_unfinished(refined);
    return *result_.error < error - equal_errors * std::max(1., error);
  }

  /// Those that are better than the optimum, or a least one of their axis that is not in the
  /// optimum's own valley.
  std::vector<std::optional<FitOutcome>> axis_valleys(
      const std::vector<std::optional<FitOutcome>>& looked, const Shares& optimum,
      double error) const {
    std::vector<std::optional<FitOutcome>> valleys;
    const auto error_at = [&](std::size_t number) {
      return looked[number]->error.value_or(std::numeric_limits<double>::infinity());
    };
    for (std::size_t number = 0; number < looked.size(); ++number) {
      if (!looked[number]->error) continue;
      const std::size_t constant = number / axis_places, part = number % axis_places;
      const double here = error_at(number);
      const double distance = std::abs(looked[number]->place[constant] - optimum[constant]);
      const bool least = (part == 0 || here <= error_at(number - 1)) &&
                         (part + 1 == axis_places || here <= error_at(number + 1));
      if (here < error || (least && distance * axis_places > 1.)) valleys.push_back(looked[number]);
    }
    return valleys;
  }

  std::vector<std::optional<FitOutcome>> look_at_all(const char* stage,
                                                     const std::vector<Shares>& places) {
    return rows_.run({places.size(), [&](std::size_t i) { return identity(stage, i, places[i]); },
                      [&](std::size_t i) {
                        std::string why;
                        const auto residuals = model_.residuals(places[i], cases_, &why);
                        if (!residuals) return look_without_value(why);
                        return FitOutcome{"ok", error_of(*residuals), std::nullopt, 1, places[i],
                                          {}};
                      }});
  }

  std::vector<std::optional<FitOutcome>> refine_all(const std::vector<Shares>& from) {
    return rows_.run({from.size(), [&](std::size_t i) { return identity("refined", i, from[i]); },
                      [&](std::size_t i) {
                        const auto fit = refine(model_of(cases_), from[i], fit_of_runs);
                        return fit ? outcome_of(*fit, plan_.residuals())
                                   : look_without_value("no run beside it has a value");
                      }});
  }

  static FitOutcome outcome_of(const LeastSquaresFit& fit, std::size_t samples) {
    return {"ok",         std::sqrt(fit.sum / static_cast<double>(samples)),
            std::nullopt, fit.models,
            fit.place,    {}};
  }

  /// The places with the least errors.
  static std::vector<Shares> best_of(const std::vector<std::optional<FitOutcome>>& looked) {
    std::vector<const FitOutcome*> valued;
    for (const auto& outcome : looked)
      if (outcome->error) valued.push_back(&*outcome);
    std::ranges::stable_sort(valued, {}, [](const FitOutcome* one) { return *one->error; });
    std::vector<Shares> best;
    for (std::size_t i = 0; i < std::min(refined_starts, valued.size()); ++i)
      best.push_back(valued[i]->place);
    return best;
  }

  /// Keeps what was found, and takes the best for the answer so far.
  void record(FitStage stage, const std::vector<std::optional<FitOutcome>>& outcomes,
              const std::vector<Shares>& asked, std::size_t first = 0) {
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      if (!outcomes[i]) continue;
      const FitOutcome& outcome = *outcomes[i];
      const FitRecord& one = result_.records.emplace_back(
          FitRecord{stage, first + i + 1, outcome.error ? outcome.place : asked[i], outcome.error,
                    outcome.models, outcome.status});
      if (!one.error || (result_.error && !(*one.error < *result_.error))) continue;
      result_.error = one.error;
      adopt(one.place);
    }
  }

  void adopt(const Shares& place) {
    result_.constants.clear();
    for (std::size_t i = 0; i < place.size(); ++i)
      result_.constants.push_back({subject_.constants[i], place[i], std::nullopt, std::nullopt,
                                   false, "its interval is not known"});
  }

  Shares place_of_answer() const {
    Shares place;
    for (const FittedConstant& constant : result_.constants) place.push_back(constant.share);
    return place;
  }

  void linearise_at_optimum() {
    auto found = linearise(model_of(cases_), place_of_answer(), fit_of_runs.difference);
    if (!found) return;
    optimum_ = std::move(*found);
    result_.residuals = optimum_.residuals;
  }

  /// The part of the optimum's residuals and derivatives that is of these cases.
  Linearisation optimum_over(const Cases& cases) const {
    Linearisation part{optimum_.place, {}, std::vector<Residuals>(optimum_.derivative.size())};
    std::vector<std::size_t> first{0};
    for (const CalibrationCase& one : plan_.cases) first.push_back(first.back() + one.residuals());
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
    for (const CalibrationCase& one : plan_.cases)
      for (const TracePlan& trace : one.traces)
        sizes.insert(sizes.end(), trace.residuals_a_sample(), trace.measured.time.size());
    return sizes;
  }

  /// Each draws from a stream of its own: whichever thread comes first.
  std::mt19937_64 random_of(std::size_t number) const {
    std::seed_seq seeds{static_cast<std::uint32_t>(plan_.seed),
                        static_cast<std::uint32_t>(plan_.seed >> 32),
                        static_cast<std::uint32_t>(number)};
    return std::mt19937_64(seeds);
  }

  LeastSquaresFit fit_sample(const ResidualModel& model, const Linearisation& start) const {
    if (plan_.bootstrap == Bootstrap::refits) return refine(model, start, refit_of_runs);
    Shares place = start.place;
    const Shares step = gauss_newton_step(start);
    for (std::size_t i = 0; i < place.size(); ++i)
      place[i] = std::clamp(place[i] + step[i], 0., 1.);
    return {std::move(place), sum_of_squares(start.residuals), 0};
  }

  /// Whole cases drawn anew; one that is drawn m times counts sqrt(m) in each residual.
  LeastSquaresFit fit_drawn_cases(std::mt19937_64& random) const {
    const std::vector<int> times = draw_with_replacement(plan_.cases.size(), random);
    Cases drawn;
    std::vector<double> factor;
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (times[i] == 0) continue;
      drawn.push_back(i);
      factor.insert(factor.end(), plan_.cases[i].residuals(),
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
        [&](const Shares& place) {
          auto residuals = plain(place);
          if (residuals) weigh(*residuals);
          return residuals;
        },
        start);
  }

  /// The same runs with their residuals drawn anew.
  LeastSquaresFit fit_drawn_blocks(std::mt19937_64& random) const {
    const Residuals shift = shift_of_blocks(optimum_.residuals, trace_sizes(), result_.block,
                                            subject_.constants.size(), random);
    const auto move = [&](Residuals& residuals) {
      for (std::size_t i = 0; i < residuals.size(); ++i) residuals[i] += shift[i];
    };
    Linearisation start = optimum_;
    move(start.residuals);
    const ResidualModel plain = model_of(cases_);
    return fit_sample(
        [&](const Shares& place) {
          auto residuals = plain(place);
          if (residuals) move(*residuals);
          return residuals;
        },
        start);
  }

  /// A sum of squares up to which a place explains the data as well as the optimum does: of one
  /// constant that is moved, with 95 % (F(1, n - p) is t^2), where as many independent residuals as
  /// the correlated ones are worth say how large the noise is.
  double bound_of_noise() const {
    const double count = static_cast<double>(plan_.residuals());
    const double constants = static_cast<double>(subject_.constants.size());
    const double worth = statistical_inefficiency(optimum_.residuals, trace_sizes());
    const double things = plan_.resamples_cases() ? static_cast<double>(plan_.cases.size())
                                                  : count / worth - constants + 1.;
    const double t = student_end(things), sum = sum_of_squares(optimum_.residuals);
    const double variance = sum / std::max(1., count - constants);
    return sum + std::max(worth * variance * t * t, count * equal_errors * equal_errors);
  }

  /// Both ends of each constant's interval by its profile, from the lower end of the first on;
  /// empty where a profile leads to ever better optima.
  std::vector<ProfileEnd> find_profiles() {
    for (std::size_t round = 0; round < profile_rounds; ++round) {
      const std::size_t count = 2 * subject_.constants.size();
      const double bound = bound_of_noise();
      const ResidualModel model = model_of(cases_);
      const auto outcomes = rows_.run(
          {count, [&](std::size_t i) { return identity("profile", i, optimum_.place); },
           [&](std::size_t i) {
             const ProfileEnd end =
                 profile_end(model, optimum_, i / 2, i % 2 == 1, bound, profile_of_runs);
             FitOutcome outcome = outcome_of(
                 end.better ? *end.better : LeastSquaresFit{end.place, end.sum, end.models},
                 plan_.residuals());
             outcome.models = end.models;
             outcome.end = end.share;
             if (end.without_runs) outcome.status = no_run_beyond;
             if (end.better) outcome.status = better_optimum;
             return outcome;
           }});
      std::vector<ProfileEnd> ends;
      const FitOutcome* better = nullptr;
      for (std::size_t i = 0; i < outcomes.size(); ++i) {
        if (!outcomes[i]) continue;
        const FitOutcome& one = *outcomes[i];
        result_.records.push_back({FitStage::profile, round * count + i + 1, one.place, one.error,
                                   one.models, one.status});
        if (one.status == better_optimum && (better == nullptr || *one.error < *better->error))
          better = &one;
        ends.push_back({one.end.value_or(0.), one.place, 0., one.status == no_run_beyond});
      }
      stop_if_unfinished(outcomes);
      if (better == nullptr) return ends;
      if (!move_to(better->place)) break;
    }
    return {};
  }

  /// Refines from a place that is better than the optimum. False where there is no run.
  bool move_to(const Shares& from) {
    const auto refined = refine_all({from});
    record(FitStage::refined, refined, {from});
    stop_if_unfinished(refined);
    linearise_at_optimum();
    return !optimum_.residuals.empty();
  }

  /// Places of the search that explain the data as well as the optimum.
  std::vector<Shares> places_within_noise() const {
    const double greatest = std::sqrt(bound_of_noise() / static_cast<double>(plan_.residuals()));
    std::vector<Shares> places;
    for (const FitRecord& one : result_.records)
      if (one.stage != FitStage::resample && one.error && *one.error <= greatest)
        places.push_back(one.place);
    return places;
  }

  void find_intervals() {
    if (optimum_.residuals.empty()) return;
    std::vector<ProfileEnd> ends;
    if (plan_.resamples >= least_resamples) ends = find_profiles();
    result_.block = plan_.resamples_cases() ? 0 : block_length(optimum_.residuals, trace_sizes());
    const auto fit = [&](std::size_t i) {
      std::mt19937_64 random = random_of(i);
      const LeastSquaresFit found =
          plan_.resamples_cases() ? fit_drawn_cases(random) : fit_drawn_blocks(random);
      return outcome_of(found, plan_.residuals());
    };
    std::vector<Shares> places;
    if (plan_.bootstrap == Bootstrap::one_step) {
      for (std::size_t i = 0; i < plan_.resamples; ++i) places.push_back(fit(i).place);
    } else {
      const auto outcomes =
          rows_.run({plan_.resamples,
                     [&](std::size_t i) { return identity("resample", i, optimum_.place); }, fit});
      for (std::size_t i = 0; i < outcomes.size(); ++i) {
        if (!outcomes[i]) continue;
        const FitOutcome& outcome = *outcomes[i];
        places.push_back(outcome.place);
        result_.records.push_back(
            {FitStage::resample, i + 1, outcome.place, outcome.error, outcome.models, "ok"});
      }
      stop_if_unfinished(outcomes);
    }
    judge(places, ends, places_within_noise());
  }

  /// Intervals from the places of a bootstrap, the ends of the constants' profiles, and places that
  /// explain the data as well.
  void judge(const std::vector<Shares>& places, const std::vector<ProfileEnd>& ends,
             const std::vector<Shares>& as_good) {
    result_.resamples = places.size();
    if (places.size() < least_resamples) {
      for (FittedConstant& constant : result_.constants)
        constant.reason = fmt::format("an interval needs {} samples of the bootstrap, not {}",
                                      least_resamples, places.size());
      return;
    }
    std::vector<std::vector<double>> columns(subject_.constants.size());
    for (const Shares& place : places)
      for (std::size_t i = 0; i < place.size(); ++i) columns[i].push_back(place[i]);
    const double tail = interval_tail();
    for (std::size_t i = 0; i < columns.size(); ++i) {
      FittedConstant& constant = result_.constants[i];
      Interval interval{quantile(columns[i], tail), quantile(columns[i], 1. - tail)};
      interval.include(constant.share);
      std::string beyond;
      for (std::size_t side = 0; side < (ends.empty() ? 0 : 2); ++side) {
        const ProfileEnd& end = ends[2 * i + side];
        interval.include(end.share);
        if (end.without_runs)
          beyond = fmt::format("no run has a value beyond the {} end of its interval",
                               side == 0 ? "lower" : "upper");
      }
      const auto apart = interval.include(as_good, i);
      constant.low = interval.low;
      constant.high = interval.high;
      constant.reason = why_not_identifiable(constant);
      if (constant.reason.empty()) constant.reason = beyond;
      if (apart && range_end(constant.share).empty())
        constant.reason = fmt::format("{} and {}{} explain the data equally well",
                                      value_text(plan_, constant, constant.share),
                                      value_text(plan_, constant, *apart), unit_of(constant));
      constant.told = constant.reason.empty();
      std::vector<double>& row = result_.correlations.emplace_back();
      for (const std::vector<double>& other : columns)
        row.push_back(correlation(columns[i], other));
    }
  }

  /// At most so many of these, in their order; drawn from a stream of its own.
  Cases drawn_from(Cases cases, std::size_t stream, std::size_t most) const {
    if (most >= cases.size()) return cases;
    std::mt19937_64 random = random_of(stream);
    for (std::size_t i = 0; i < most; ++i)
      std::swap(cases[i], cases[i + random() % (cases.size() - i)]);
    cases.resize(most);
    std::ranges::sort(cases);
    return cases;
  }
  /// Those of these that a search looks at: of all cases number 0, or the fold's.
  Cases drawn_cases(const Cases& cases, std::size_t number) const {
    const std::size_t most = plan_.most_cases == 0 ? cases.size() : plan_.most_cases;
    return drawn_from(cases, streams_of_draws + number, most);
  }
  Cases drawn_cases() const { return drawn_cases(cases_, 0); }

  static int generations_of_folds(const CalibrationPlan& plan) {
    return folds_begin_anew(plan) ? plan.generations : (plan.generations + 1) / 2;
  }

  static std::size_t looks_of_a_search(const CalibrationPlan& plan, int generations) {
    return static_cast<std::size_t>(plan.population) * static_cast<std::size_t>(generations) +
           surface_rounds * surface_looks;
  }

  /// What a place leaves of each of these cases.
  FitOutcome look(const Shares& place, const Cases& cases) const {
    FitOutcome outcome{"ok", std::nullopt, std::nullopt, 1, place, {}};
    for (const std::size_t one : cases) {
      std::string why;
      const auto residuals = model_.residuals(place, std::span(&one, 1), &why);
      if (!residuals) return look_without_value(why);
      outcome.cases.push_back(mean_distance(plan_.cases[one].traces, *residuals));
    }
    outcome.error = mean_of(outcome.cases);
    return outcome;
  }

  /// What is found of cases by looking at places.
  struct Search {
    std::size_t cases = 0;
    std::vector<FitOutcome> looked{};  ///< at every place, in order
    std::optional<ResponseSurface> surface{};

    void fit_surface() {
      std::vector<PlacedErrors> valued;
      for (const FitOutcome& outcome : looked)
        if (outcome.error) valued.push_back({outcome.place, outcome.cases});
      surface = ResponseSurface::fit(std::move(valued));
    }
    /// Where the error is least, with each case counted `times`: of the surface, and where that
    /// has no least place the best that was looked at; nothing where no place has a value.
    std::optional<Shares> least(const std::vector<int>& times) const {
      if (surface)
        if (auto place = surface->least(times)) return place;
      const FitOutcome* best = best_place(looked, times);
      return best == nullptr ? std::nullopt : std::optional(best->place);
    }
    /// The best that was looked at; null where none ran.
    const FitOutcome* best() const { return best_place(looked, std::vector<int>(cases, 1)); }
  };

  /// CMA-ES over these cases, then rounds of looks where the surface over its places is least: for
  /// the cases as they are, and for samples of them, so that places lie as close as the cases tell
  /// them apart. `number`: 0, all over the box; or the fold, `about` a place.
  Search look_around(std::size_t number, const Cases& cases,
                     const std::optional<Shares>& about = std::nullopt) {
    Search found{cases.size()};
    const int generations = number == 0 ? plan_.generations : generations_of_folds(plan_);
    const auto look_at = [&](std::span<const Shares> places, int generation) {
      const auto outcomes = rows_.run(
          {places.size(),
           [&](std::size_t i) {
             return identity(fmt::format("search {} {}", number, generation).c_str(), i, places[i]);
           },
           [&](std::size_t i) { return look(places[i], cases); }});
      stop_if_unfinished(outcomes);
      std::vector<Score> scores;
      for (const auto& outcome : outcomes) {
        scores.push_back(outcome->error ? Score{{*outcome->error}, 0.} : Score{{0.}, 1.});
        found.looked.push_back(*outcome);
      }
      return scores;
    };
    search({SearchMethod::cmaes, subject_.constants.size(), 1, plan_.population, generations,
            plan_.seed + number, about ? std::vector<Shares>{*about} : first_guesses(),
            about ? width_of_a_fold : 1.},
           look_at);
    found.fit_surface();
    if (found.best() == nullptr) return found;
    std::mt19937_64 random = random_of(streams_of_surfaces + number);
    for (int round = 0; round < surface_rounds; ++round, found.fit_surface()) {
      std::vector<Shares> places{*found.least(std::vector<int>(cases.size(), 1))};
      while (places.size() < surface_looks)
        places.push_back(*found.least(draw_with_replacement(cases.size(), random)));
      look_at(places, generations + round);
    }
    return found;
  }

  /// The place with the least error over its cases, each counted `times`; null where none ran.
  static const FitOutcome* best_place(const std::vector<FitOutcome>& looked,
                                      const std::vector<int>& times) {
    const FitOutcome* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const FitOutcome& outcome : looked) {
      if (!outcome.error) continue;
      const double sum =
          std::inner_product(outcome.cases.begin(), outcome.cases.end(), times.begin(), 0.);
      if (!(sum < least)) continue;
      least = sum;
      best = &outcome;
    }
    return best;
  }

  /// The optimum, and its interval: of each sample of the bootstrap where the surface is least,
  /// without a run. False when no place has a value.
  bool search_distances() {
    const Cases cases = drawn_cases();
    const Search found = look_around(0, cases);
    for (std::size_t i = 0; i < found.looked.size(); ++i)
      result_.records.push_back({FitStage::search, i + 1, found.looked[i].place,
                                 found.looked[i].error, found.looked[i].models,
                                 found.looked[i].status});
    const FitOutcome* best = found.best();
    if (best == nullptr) {
      result_.status = "no run has a value: " + found.looked.front().status;
      return false;
    }
    result_.error = best->error;
    adopt(best->place);
    std::vector<Shares> places;
    for (std::size_t i = 0; i < plan_.resamples; ++i) {
      std::mt19937_64 random = random_of(i);
      places.push_back(*found.least(draw_with_replacement(cases.size(), random)));
    }
    std::vector<FitOutcome> looked = found.looked;
    if (plan_.resamples >= least_resamples) look_along_axes(cases, best->place, looked);
    judge(places, ends_of(places_as_near(looked, *best)), {});
    return true;
  }

  /// Adds places along the axes through the best one: the search itself went where the error falls,
  /// and saw little of a constant that changes nothing.
  void look_along_axes(const Cases& cases, const Shares& best, std::vector<FitOutcome>& looked) {
    const std::vector<Shares> places = places_on_axes(best);
    const auto outcomes =
        rows_.run({places.size(), [&](std::size_t i) { return identity("axis", i, places[i]); },
                   [&](std::size_t i) { return look(places[i], cases); }});
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      if (!outcomes[i]) continue;
      result_.records.push_back({FitStage::axis, i + 1, places[i], outcomes[i]->error,
                                 outcomes[i]->models, outcomes[i]->status});
      looked.push_back(*outcomes[i]);
    }
    stop_if_unfinished(outcomes);
  }

  /// Places whose mean distance is not greater than the best one's by more than chance makes it,
  /// case by case (Student's t, one constant of 95 %).
  static std::vector<Shares> places_as_near(const std::vector<FitOutcome>& looked,
                                            const FitOutcome& best) {
    std::vector<Shares> places;
    for (const FitOutcome& one : looked) {
      if (!one.error) continue;
      const double count = static_cast<double>(one.cases.size());
      double sum = 0., squares = 0.;
      for (std::size_t i = 0; i < one.cases.size(); ++i) {
        const double more = one.cases[i] - best.cases[i];
        sum += more;
        squares += more * more;
      }
      const double variance =
          std::max(0., (squares - sum * sum / count) / std::max(1., count - 1.));
      if (sum / count <= student_end(count) * std::sqrt(variance / count))
        places.push_back(one.place);
    }
    return places;
  }

  /// The ends of the box about these places, of which there is one at least.
  static std::vector<ProfileEnd> ends_of(const std::vector<Shares>& places) {
    std::vector<ProfileEnd> ends;
    for (std::size_t i = 0; i < places.front().size(); ++i) {
      const auto [low, high] =
          std::ranges::minmax(places, {}, [i](const Shares& place) { return place[i]; });
      ends.push_back({low[i], low});
      ends.push_back({high[i], high});
    }
    return ends;
  }

  /// Of the cases that a search may see at most so many that it has not looked at, in their order.
  Cases unseen(const Cases& may_see, const Cases& looked_at, std::size_t number,
               std::size_t most) const {
    Cases others;
    std::ranges::set_difference(may_see, looked_at, std::back_inserter(others));
    return drawn_from(std::move(others), streams_of_promises + number, most);
  }

  /// Where the error of `held` cases will be, by what these constants leave of others. The means of
  /// n and m cases out of many that spread by s differ by t s sqrt(1/n + 1/m) at most, with a
  /// chance of 95 % (Student's t of n - 1 degrees of freedom).
  std::optional<PromisedError> promise(const Shares& place, const Cases& others,
                                       std::size_t held) const {
    const std::vector<double> each = distances(others, predict(place, others));
    if (each.size() < 2) return std::nullopt;
    const double mean = mean_of(each), count = static_cast<double>(each.size());
    double squares = 0.;
    for (const double one : each) squares += (one - mean) * (one - mean);
    const double spread = std::sqrt(squares / (count - 1.));
    const double reach =
        student_end(count) * spread * std::sqrt(1. / count + 1. / static_cast<double>(held));
    return PromisedError{mean, mean - reach, mean + reach};
  }

  /// Each case by constants that were fitted without it; without folds by those of all. A fold's
  /// search begins where the first one ended, and so none holds out what that has looked at.
  void predict_folds() {
    if (fold_count(plan_) == 0) {
      result_.residuals = predict(place_of_answer(), cases_);
      return;
    }
    const bool anew = folds_begin_anew(plan_);
    const auto [held, training] = folds_of_cases(anew ? Cases() : drawn_cases());
    const auto about = anew ? std::nullopt : std::optional(place_of_answer());
    std::vector<Residuals> each(cases_.size());
    for (std::size_t i = 0; i < held.size(); ++i) {
      if (held[i].empty()) continue;
      const Cases cases = drawn_cases(training[i], i + 1);
      const Search found = look_around(i + 1, cases, about);
      const FitOutcome* best = found.best();
      if (best == nullptr) continue;
      const Residuals out = predict(best->place, held[i]);
      result_.folds.push_back(
          {held[i], best->error, error_over(held[i], out), best->place,
           promise(best->place, unseen(training[i], cases, i + 1, held[i].size()),
                   held[i].size())});
      result_.records.push_back(
          {FitStage::fold, i + 1, best->place, best->error, found.looked.size(), best->status});
      auto from = out.begin();
      for (const std::size_t one : held[i]) {
        const auto size = static_cast<std::ptrdiff_t>(plan_.cases[one].residuals());
        each[one].assign(from, from + size);
        from += size;
      }
    }
    for (std::size_t i = 0; i < each.size(); ++i) {
      if (each[i].empty())
        each[i].assign(plan_.cases[i].residuals(), std::numeric_limits<double>::quiet_NaN());
      result_.residuals.insert(result_.residuals.end(), each[i].begin(), each[i].end());
    }
  }

  /// Of the blocks the fit has taken one for each constant.
  double interval_tail() const {
    if (plan_.method == FitMethod::cmaes)
      return tail_of_interval(static_cast<double>(drawn_cases().size()));
    if (plan_.resamples_cases()) return tail_of_interval(static_cast<double>(plan_.cases.size()));
    const double blocks =
        static_cast<double>(plan_.residuals()) / static_cast<double>(result_.block);
    return tail_of_interval(blocks - static_cast<double>(subject_.constants.size()));
  }

  /// The values of a constant that explain the data, in shares.
  struct Interval {
    double low = 0., high = 0.;

    void include(double share) {
      low = std::min(low, share);
      high = std::max(high, share);
    }
    /// Includes those of these places; the one farthest from the interval that is another one, not
    /// its continuation.
    std::optional<double> include(const std::vector<Shares>& places, std::size_t constant) {
      const Interval before = *this;
      const double gap = std::max(least_gap, before.high - before.low);
      double farthest = gap;
      std::optional<double> apart;
      for (const Shares& place : places) {
        const double share = place[constant];
        include(share);
        const double distance = std::max(before.low - share, share - before.high);
        if (!(distance > farthest)) continue;
        farthest = distance;
        apart = share;
      }
      return apart;
    }
  };

  std::string unit_of(const FittedConstant& constant) const {
    const std::string& unit = plan_.varied[constant.constant].unit.text;
    return unit.empty() ? "" : " " + unit;
  }

  static std::string why_not_identifiable(const FittedConstant& constant) {
    if (const std::string_view end = range_end(constant.share); !end.empty())
      return fmt::format("the fit ends at the {} end of its range", end);
    const double width = *constant.high - *constant.low;
    if (width > widest_interval)
      return fmt::format("its interval spans {:.0f} % of its range", 100. * width);
    for (const double reached : {*constant.low, *constant.high})
      if (const std::string_view end = range_end(reached); !end.empty())
        return fmt::format("its interval reaches the {} end of its range", end);
    return "";
  }

  /// Cases that each fold holds out, and those that it is fitted to.
  struct Folds {
    std::vector<Cases> held, training;
  };
  /// `never_held`: cases that all folds may see, in order.
  Folds folds_of_cases(const Cases& never_held) const {
    const std::size_t folds = fold_count(plan_);
    const auto fold = fold_of_each(plan_.cases.size(), folds, plan_.seed);
    Folds all{std::vector<Cases>(folds), std::vector<Cases>(folds)};
    for (const std::size_t one : cases_) {
      const bool seen = std::ranges::binary_search(never_held, one);
      for (std::size_t part = 0; part < folds; ++part)
        (fold[one] == part && !seen ? all.held : all.training)[part].push_back(one);
    }
    return all;
  }

  void cross_validate() {
    const std::size_t folds = fold_count(plan_);
    if (folds == 0 || optimum_.residuals.empty()) return;
    const auto parts = folds_of_cases({});
    const auto outcomes =
        rows_.run({folds, [&](std::size_t i) { return identity("fold", i, optimum_.place); },
                   [&](std::size_t i) {
                     const Linearisation start = optimum_over(parts.training[i]);
                     const LeastSquaresFit fit =
                         refine(model_of(parts.training[i]), start, refit_of_runs);
                     const auto out = model_.residuals(fit.place, parts.held[i]);
                     FitOutcome outcome = outcome_of(fit, start.residuals.size());
                     if (out) outcome.held_out = error_of(*out);
                     return outcome;
                   }});
    for (std::size_t i = 0; i < folds; ++i) {
      if (!outcomes[i]) continue;
      const FitOutcome& outcome = *outcomes[i];
      result_.folds.push_back({parts.held[i], outcome.error, outcome.held_out, outcome.place});
      result_.records.push_back(
          {FitStage::fold, i + 1, outcome.place, outcome.error, outcome.models, "ok"});
    }
    stop_if_unfinished(outcomes);
  }

  static void stop_if_unfinished(const std::vector<std::optional<FitOutcome>>& outcomes) {
    if (!std::ranges::all_of(outcomes, [](const auto& one) { return one.has_value(); }))
      throw CalibrationInterrupted{};
  }

  std::string identity(const char* stage, std::size_t number, const Shares& from) const {
    output::Hash hash;
    hash.add(plan_.runs.hash).add(subject_.runs_hash).add(stage).add(std::to_string(number));
    for (const double share : from) hash.add(output::shortest(share));
    return hash.text();
  }

  const CalibrationPlan& plan_;
  CalibrationSubject subject_;  ///< with the constants that it reads
  FitRows& rows_;
  CalibrationModel model_;
  Cases cases_;
  Linearisation optimum_;
  SubjectCalibration result_;
};

/// "hunt_crossley: error 1.02": what is told of a subject that is done.
std::string told_of(const CalibrationSubject& subject, const SubjectCalibration& result) {
  if (result.status != "ok") return subject.info.name + ": " + result.status;
  return fmt::format("{}: error {}", subject.info.name,
                     result.error ? output::rounded(*result.error) : "not known");
}

/// Warning of the step with the fitted constants; none where nothing was fitted.
std::optional<std::string> step_warning_of(const CalibrationPlan& plan,
                                           const CalibrationSubject& subject,
                                           const SubjectCalibration& result) {
  if (result.constants.empty()) return std::nullopt;
  std::vector<ConstantSetting> settings;
  for (const FittedConstant& fitted : result.constants) {
    const VariedConstant& constant = plan.varied[fitted.constant];
    settings.push_back(constant.setting(exact_value(constant, fitted.share)));
  }
  auto warning = step_warning(*subject.scene, settings);
  if (warning) warning = subject.info.name + ", fitted constants: " + *warning;
  return warning;
}

}  // namespace

std::string_view name_of(FitStage stage) {
  switch (stage) {
    case FitStage::start:
      return "start";
    case FitStage::refined:
      return "refined";
    case FitStage::search:
      return "search";
    case FitStage::axis:
      return "axis";
    case FitStage::profile:
      return "profile";
    case FitStage::resample:
      return "resample";
    case FitStage::fold:
      return "fold";
  }
  return "";
}

std::string_view range_end(double share) {
  return share < end_part ? "lower" : share > 1. - end_part ? "upper" : "";
}

bool folds_begin_anew(const CalibrationPlan& plan) {
  return plan.most_cases == 0 || 2 * plan.most_cases > plan.cases.size();
}

std::optional<double> error_of(const Residuals& residuals) {
  if (residuals.empty()) return std::nullopt;
  return std::sqrt(sum_of_squares(residuals) / static_cast<double>(residuals.size()));
}

CalibrationRun run_calibration(const CalibrationPlan& plan, const EngineTable& engines,
                               const CalibrationOptions& options, const std::atomic<bool>& stop) {
  CalibrationRun run;
  run.folder = options.run.folder.empty() ? plan.folder() : options.run.folder;
  run.files = std::make_unique<output::ResultFolder>(run.folder, manifest_of(plan.runs),
                                                     calibration_files(plan));
  std::size_t total = 0;
  for (const CalibrationSubject& subject : plan.subjects)
    total += SubjectFit::rows_of(plan, subject);
  FitRows rows(plan.runs.name, options.run, run.folder, total, stop);
  for (const CalibrationSubject& subject : plan.subjects) {
    SubjectFit fit(plan, subject, engines, rows, stop);
    const bool whole = fit.run();
    run.result.subjects.push_back(fit.take());
    if (options.tell) options.tell(told_of(subject, run.result.subjects.back()));
    const auto warning = step_warning_of(plan, subject, run.result.subjects.back());
    if (warning && options.run.tell) options.run.tell(*warning);
    run.result.interrupted = !whole;
    if (!whole) break;
  }
  run.provenance = make_provenance(plan.runs, engines);
  run.provenance.seeds.push_back(plan.seed);
  return run;
}

}  // namespace hookpoint::studies
