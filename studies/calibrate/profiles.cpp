#include "studies/calibrate/profiles.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hookpoint::studies {
namespace {

/// A run is a smooth function of its constants but for small jumps, where a point touches a step
/// earlier or later. Refits take differences within these, and where they are held over them.
constexpr ProfileOptions profile_of_runs{{5e-4, 20, 1e-4}, 2e-2, 16, 0.05};
/// A profile that finds a better optimum begins there again, at most so often in all.
constexpr std::size_t profile_rounds = 4;
/// Points of the search in other valleys, from which all constants are refitted; they are apart by
/// this part of a range, from the optimum too.
constexpr std::size_t rivals = 4;
constexpr double rival_distance = 0.1;
/// What became of a profile.
constexpr const char* no_run_beyond = "no run beyond has a value";
constexpr const char* better_optimum = "a better optimum";

double distance_of(const UnitPoint& one, const UnitPoint& other) {
  double largest = 0.;
  for (std::size_t i = 0; i < one.size(); ++i)
    largest = std::max(largest, std::abs(one[i] - other[i]));
  return largest;
}

/// The profiles of one subject.
class Profiler {
 public:
  Profiler(SubjectFit& fit, const FitMeasure& measure) : fit_(fit), measure_(measure) {}

  void polish() { move_to(fit_.best_point(), "polish"); }

  Profiles find() {
    Profiles found;
    for (std::size_t round = 0; round < profile_rounds; ++round) {
      if (!state_at(fit_.best_point())) return {};
      problem_.ends_where_better = round + 1 < profile_rounds;
      const auto better = profile(round, found);
      if (!better) break;
      move_to(*better, "better");
      found = {};
    }
    add_rivals(found);
    return found;
  }

 private:
  /// The problem of profiles about a point; false where there is no run.
  bool state_at(const UnitPoint& point) {
    problem_ = {point, model(), {}, measure_.to_squares, zeros(), true};
    const auto residuals = problem_.model(point);
    if (!residuals) return false;
    problem_.excess = measure_.excess_over(*residuals);
    return true;
  }

  ResidualModel model() const {
    return [this](const UnitPoint& point) { return fit_.model.residuals(point, measure_.cases); };
  }

  std::vector<std::optional<double>> zeros() const {
    std::vector<std::optional<double>> shares;
    for (const std::size_t constant : fit_.subject.constants) {
      const VariedConstant& varied = fit_.plan.varied[constant];
      shares.push_back(varied.logarithmic
                           ? std::nullopt
                           : std::optional(-varied.from / (varied.to - varied.from)));
    }
    return shares;
  }

  FitOutcome outcome_at(const UnitPoint& point, std::size_t models) const {
    const auto residuals = fit_.model.residuals(point, measure_.cases);
    return {"ok",         residuals ? measure_.error(*residuals) : std::nullopt,
            std::nullopt, models + 1,
            point,        {}};
  }

  /// One round of profiles; the best of the better optima that they find.
  std::optional<UnitPoint> profile(std::size_t round, Profiles& found) {
    const std::size_t count = 2 * problem_.optimum.size();
    const auto outcomes = fit_.run(
        {count,
         [&](std::size_t i) {
           return fit_.identity(problem_.ends_where_better ? "profile" : "last profile", i,
                                problem_.optimum);
         },
         [&](std::size_t i) {
           const ProfileEnd end = profile_end(problem_, i / 2, i % 2 == 1, profile_of_runs);
           FitOutcome outcome = outcome_at(end.better ? *end.better : end.point, end.models);
           outcome.end = end.share;
           outcome.wide_end = end.wide_share;
           if (end.apart) outcome.apart = *end.apart;
           if (end.without_runs) outcome.status = no_run_beyond;
           if (end.better) outcome.status = better_optimum;
           return outcome;
         }});
    std::optional<UnitPoint> better;
    double least = 0.;
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      if (!outcomes[i]) continue;
      const FitOutcome& one = *outcomes[i];
      fit_.result.records.push_back(
          {FitStage::profile, round * count + i + 1, one.point, one.error, one.models, one.status});
      if (one.status == better_optimum && one.error && (!better || *one.error < least)) {
        better = one.point;
        least = *one.error;
      }
      const double end = one.end.value_or(0.);
      found.ends.push_back(
          {end, one.wide_end.value_or(end), one.point, one.status == no_run_beyond});
      if (!one.apart.empty()) found.as_good.push_back(one.apart);
    }
    stop_if_unfinished(outcomes);
    return better;
  }

  /// Refits all constants from a point, and takes the result where it is the best so far.
  void move_to(const UnitPoint& from, const char* stage) {
    if (!state_at(from)) return;
    const auto outcomes = fit_.run({1, [&](std::size_t) { return fit_.identity(stage, 0, from); },
                                    [&](std::size_t) {
                                      const FreeRefit found = descended(from);
                                      return outcome_at(found.point, found.models);
                                    }});
    stop_if_unfinished(outcomes);
    const FitOutcome& one = *outcomes.front();
    fit_.result.records.push_back(
        {FitStage::refined, ++moves_, one.point, one.error, one.models, one.status});
    if (!one.error || !fit_.result.error || !(*one.error < *fit_.result.error)) return;
    fit_.result.error = one.error;
    fit_.adopt(one.point);
  }

  /// From a point down as far as it goes, whatever the excess.
  FreeRefit descended(const UnitPoint& from) const {
    ProfileProblem whole = problem_;
    // No point is good enough: the excess is measured from one that is far better.
    constexpr double never_enough = 10.;
    whole.excess = [this](const Residuals& residuals) {
      return never_enough + problem_.excess(residuals);
    };
    const auto found = refit_all(whole, from, profile_of_runs);
    return found ? *found : FreeRefit{from, 0., 0};
  }

  /// Points of the search that are in valleys of their own, refitted: those that explain the data.
  void add_rivals(Profiles& found) {
    if (found.ends.empty()) return;
    std::vector<const FitRecord*> valued;
    for (const FitRecord& one : fit_.result.records)
      if (one.error && one.point.size() == problem_.optimum.size()) valued.push_back(&one);
    std::ranges::stable_sort(valued, {}, [](const FitRecord* one) { return *one->error; });
    std::vector<UnitPoint> apart;
    for (const FitRecord* one : valued) {
      if (apart.size() == rivals) break;
      const auto near = [&](const UnitPoint& other) {
        return distance_of(one->point, other) < rival_distance;
      };
      if (!near(problem_.optimum) && std::ranges::none_of(apart, near)) apart.push_back(one->point);
    }
    const auto outcomes =
        fit_.run({apart.size(), [&](std::size_t i) { return fit_.identity("rival", i, apart[i]); },
                  [&](std::size_t i) {
                    const auto refit = refit_all(problem_, apart[i], profile_of_runs);
                    if (!refit) return outcome_without_value("no run beside it has a value");
                    FitOutcome outcome = outcome_at(refit->point, refit->models);
                    outcome.end = refit->excess;
                    return outcome;
                  }});
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      if (!outcomes[i]) continue;
      const FitOutcome& one = *outcomes[i];
      fit_.result.records.push_back(
          {FitStage::refined, ++moves_, one.point, one.error, one.models, one.status});
      if (one.end && *one.end <= surely_outside) found.as_good.push_back(one.point);
    }
    stop_if_unfinished(outcomes);
  }

  SubjectFit& fit_;
  const FitMeasure& measure_;
  ProfileProblem problem_;
  std::size_t moves_ = 0;
};

}  // namespace

std::size_t rows_of_profiles(std::size_t constants) {
  return 1 + profile_rounds * (2 * constants + 1) + rivals;
}

void polish(SubjectFit& fit, const FitMeasure& measure) { Profiler(fit, measure).polish(); }

Profiles find_profiles(SubjectFit& fit, const FitMeasure& measure) {
  return Profiler(fit, measure).find();
}

}  // namespace hookpoint::studies
