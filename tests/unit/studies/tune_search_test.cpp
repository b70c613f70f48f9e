// The search and the sensitivities of a tuning on functions whose truth is known: ZDT1's Pareto
// front, a quadric's minimum, Ishigami's indices, Student's t.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "studies/tune/choice.h"
#include "studies/tune/sensitivity.h"

namespace hookpoint::studies {
namespace {

using Point = std::vector<double>;

/// A plan of so many objectives, all to be minimised, each a metric of its own.
TunePlan plan_of(std::size_t objectives) {
  TunePlan plan;
  for (std::size_t i = 0; i < objectives; ++i) {
    plan.runs.metrics.push_back({&metric_table()[i]});
    plan.objectives.push_back({i, false, ObjectivePlan::Take::mean});
  }
  return plan;
}

/// A candidate that was run with one seed.
Candidate candidate_of(const std::vector<double>& metrics) {
  Candidate candidate;
  candidate.statuses = {"ok"};
  candidate.measured = {{metrics.begin(), metrics.end()}};
  return candidate;
}

/// Zitzler, Deb & Thiele 2000: f1 = x1, f2 = g (1 - sqrt(f1/g)), g = 1 + 9/(n - 1) sum of the
/// others. Its Pareto front is g = 1: f2 = 1 - sqrt(f1), 0 <= f1 <= 1.
std::vector<double> zdt1(const Point& x) {
  double sum = 0.;
  for (std::size_t i = 1; i < x.size(); ++i) sum += x[i];
  const double g = 1. + 9. * sum / static_cast<double>(x.size() - 1);
  return {x[0], g * (1. - std::sqrt(x[0] / g))};
}

SearchOptions zdt1_options() { return {SearchMethod::nsga2, 30, 2, 100, 250, 1, {}}; }

/// All candidates of a search of ZDT1 in which f1 must be at least `least`.
std::vector<Candidate> search_zdt1(const SearchOptions& options, double least) {
  std::vector<Candidate> all;
  search(options, [&](std::span<const Point> points, int generation) {
    std::vector<Score> scores;
    for (const Point& x : points) {
      const std::vector<double> f = zdt1(x);
      scores.push_back({f, std::max(0., least - f[0])});
      all.push_back(candidate_of(f));
      all.back().generation = generation + 1;
    }
    return scores;
  });
  return all;
}

TEST(Search, FindsTheParetoFrontOfZdt1) {
  const std::vector<Candidate> all = search_zdt1(zdt1_options(), -1.);
  ASSERT_EQ(all.size(), 100u * 250u);
  const TunePlan plan = plan_of(2);
  const std::vector<std::size_t> front = pareto_set(plan, all);
  ASSERT_GT(front.size(), 100u);
  double distance = 0., widest = 0., before = 0.;
  for (const std::size_t member : front) {
    const double f1 = *all[member].measured[0][0], f2 = *all[member].measured[0][1];
    distance += f2 - (1. - std::sqrt(f1));
    widest = std::max(widest, f1 - before);
    before = f1;
  }
  // Deb et al. 2002, table II: a mean distance of 0.033 for real-coded NSGA-II after as many.
  EXPECT_LT(distance / static_cast<double>(front.size()), 0.033);
  EXPECT_GT(distance, 0.);
  EXPECT_LT(widest, 0.05);
  EXPECT_GT(before, 0.97);
}

TEST(Search, KeepsRequirementsAsDebsRuleHasThem) {
  const std::vector<Candidate> all = search_zdt1(zdt1_options(), 0.4);
  TunePlan plan = plan_of(2);
  RequirementPlan required;
  required.metric = 0;
  required.above = 0.4;
  plan.requirements.push_back(required);
  const std::vector<std::size_t> front = pareto_set(plan, all);
  ASSERT_GT(front.size(), 50u);
  EXPECT_GT(*all[front.front()].measured[0][0], 0.4);
  EXPECT_LT(*all[front.front()].measured[0][0], 0.42);
  const auto late = std::ranges::count_if(all, [&](const Candidate& candidate) {
    return candidate.generation > 240 && is_feasible(plan, candidate);
  });
  EXPECT_GT(late, 900);
}

TEST(Search, HasTheFirstGuessesInItsFirstGenerationAndRepeatsItself) {
  SearchOptions options = zdt1_options();
  options.population = 8;
  options.generations = 5;
  const Point guess(30, 0.25);
  options.first = {guess};
  const auto batches = [&] {
    std::vector<std::vector<Point>> heard;
    search(options, [&](std::span<const Point> points, int generation) {
      EXPECT_EQ(generation, static_cast<int>(heard.size()));
      heard.emplace_back(points.begin(), points.end());
      std::vector<Score> scores;
      for (const Point& x : points) scores.push_back({zdt1(x), 0.});
      return scores;
    });
    return heard;
  };
  const auto once = batches(), twice = batches();
  ASSERT_EQ(once.size(), 5u);
  for (const auto& batch : once) EXPECT_EQ(batch.size(), 8u);
  EXPECT_EQ(once[0][0], guess);
  EXPECT_EQ(once, twice);
  options.seed = 2;
  EXPECT_NE(once, batches());
}

TEST(Search, ByCmaesFindsTheMinimumOfAQuadricInWholeGenerations) {
  // sum of 10^i (x_i - 0.3)^2: the least value is 0.
  const SearchOptions options{SearchMethod::cmaes, 4, 1, 12, 80, 3, {}};
  double best = 1e300;
  std::size_t batches = 0;
  search(options, [&](std::span<const Point> points, int) {
    EXPECT_EQ(points.size(), 12u);
    ++batches;
    std::vector<Score> scores;
    for (const Point& x : points) {
      double f = 0.;
      for (std::size_t i = 0; i < x.size(); ++i)
        f += std::pow(10., static_cast<double>(i)) * (x[i] - 0.3) * (x[i] - 0.3);
      best = std::min(best, f);
      scores.push_back({{f}, 0.});
    }
    return scores;
  });
  EXPECT_EQ(batches, 80u);
  EXPECT_LT(best, 1e-8);
}

TEST(Search, ByNsga2TakesASingleObjectiveToo) {
  const SearchOptions options{SearchMethod::nsga2, 3, 1, 20, 60, 1, {}};
  double best = 1e300;
  search(options, [&](std::span<const Point> points, int) {
    std::vector<Score> scores;
    for (const Point& x : points) {
      double f = 0.;
      for (const double part : x) f += (part - 0.7) * (part - 0.7);
      best = std::min(best, f);
      scores.push_back({{f}, 0.});
    }
    return scores;
  });
  EXPECT_LT(best, 1e-4);
}

TEST(Search, LetsOutWhatTheScoresThrow) {
  SearchOptions options = zdt1_options();
  int generations = 0;
  const auto run = [&] {
    search(options, [&](std::span<const Point> points, int) {
      if (++generations == 3) throw std::runtime_error("enough");
      return std::vector<Score>(points.size(), Score{{1., 2.}, 0.});
    });
  };
  EXPECT_THROW(run(), std::runtime_error);
  EXPECT_EQ(generations, 3);
}

/// Ishigami & Homma 1990: sin x1 + a sin^2 x2 + b x3^4 sin x1, each in [-pi, pi].
constexpr double ishigami_a = 7., ishigami_b = 0.1;

double ishigami(const Point& unit) {
  const auto x = [&](std::size_t i) { return std::numbers::pi * (2. * unit[i] - 1.); };
  const double sine = std::sin(x(1));
  return std::sin(x(0)) + ishigami_a * sine * sine +
         ishigami_b * std::pow(x(2), 4.) * std::sin(x(0));
}

TEST(Sobol, IndicesOfIshigamisFunctionAreItsClosedForms) {
  const double pi4 = std::pow(std::numbers::pi, 4.), pi8 = pi4 * pi4;
  const double v1 = 0.5 * (1. + ishigami_b * pi4 / 5.) * (1. + ishigami_b * pi4 / 5.);
  const double v2 = ishigami_a * ishigami_a / 8.;
  const double v13 = ishigami_b * ishigami_b * pi8 * (1. / 18. - 1. / 50.);
  const double variance = v1 + v2 + v13;
  std::size_t asked = 0;
  const auto all = sobol_indices(3, 2, 4096, 1, [&](std::span<const Point> points) {
    asked += points.size();
    std::vector<std::vector<std::optional<double>>> values;
    for (const Point& point : points) values.push_back({ishigami(point), 1.});
    return values;
  });
  EXPECT_EQ(asked, 4096u * 5u);
  ASSERT_EQ(all.size(), 2u);
  ASSERT_TRUE(all[0]);
  EXPECT_EQ(all[0]->used, 4096u);
  EXPECT_NEAR(all[0]->variance, variance, 0.02 * variance);
  EXPECT_NEAR(all[0]->first[0], v1 / variance, 0.02 * v1 / variance);
  EXPECT_NEAR(all[0]->first[1], v2 / variance, 0.02 * v2 / variance);
  EXPECT_NEAR(all[0]->first[2], 0., 0.005);
  EXPECT_NEAR(all[0]->total[0], (v1 + v13) / variance, 0.02 * (v1 + v13) / variance);
  EXPECT_NEAR(all[0]->total[1], v2 / variance, 0.02 * v2 / variance);
  EXPECT_NEAR(all[0]->total[2], v13 / variance, 0.02 * v13 / variance);
  EXPECT_FALSE(all[1]);  // what never changes has no variance to share out
}

TEST(Sobol, LeavesOutSamplesWithoutAValue) {
  const auto all = sobol_indices(2, 1, 1024, 5, [](std::span<const Point> points) {
    std::vector<std::vector<std::optional<double>>> values;
    for (const Point& x : points)
      values.push_back({x[1] > 0.9 ? std::nullopt : std::optional(3. * x[0])});
    return values;
  });
  ASSERT_TRUE(all[0]);
  // Both parts of a sample must be below 0.9: 81 of 100 are.
  EXPECT_NEAR(static_cast<double>(all[0]->used), 0.81 * 1024., 20.);
  EXPECT_NEAR(all[0]->first[0], 1., 0.02);
  EXPECT_NEAR(all[0]->total[1], 0., 1e-12);
}

/// Ishigami's indices, first order and total, from its closed form.
struct IshigamiTruth {
  double first[3], total[3];
};

IshigamiTruth ishigami_truth() {
  const double pi4 = std::pow(std::numbers::pi, 4.);
  const double v1 = 0.5 * (1. + ishigami_b * pi4 / 5.) * (1. + ishigami_b * pi4 / 5.);
  const double v2 = ishigami_a * ishigami_a / 8.;
  const double v13 = ishigami_b * ishigami_b * pi4 * pi4 * (1. / 18. - 1. / 50.);
  const double variance = v1 + v2 + v13;
  return {{v1 / variance, v2 / variance, 0.},
          {(v1 + v13) / variance, v2 / variance, v13 / variance}};
}

SobolIndices ishigami_indices(std::size_t samples, std::uint64_t seed) {
  const auto all = sobol_indices(3, 1, samples, seed, [](std::span<const Point> points) {
    std::vector<std::vector<std::optional<double>>> values;
    for (const Point& point : points) values.push_back({ishigami(point)});
    return values;
  });
  return *all[0];
}

TEST(Sobol, IntervalsCoverIshigamisIndices) {
  const IshigamiTruth truth = ishigami_truth();
  constexpr int searches = 100;
  int covered = 0, all = 0;
  for (int seed = 1; seed <= searches; ++seed) {
    const SobolIndices found = ishigami_indices(64, static_cast<std::uint64_t>(seed));
    for (std::size_t i = 0; i < 3; ++i) {
      const auto inside = [](const IndexInterval& interval, double value) {
        return interval.low <= value && value <= interval.high;
      };
      covered += inside(found.first_interval[i], truth.first[i]) ? 1 : 0;
      covered += inside(found.total_interval[i], truth.total[i]) ? 1 : 0;
      all += 2;
      EXPECT_LE(found.first_interval[i].low, found.first[i]);
      EXPECT_LE(found.total[i], found.total_interval[i].high);
    }
  }
  // 95 % of 600, less three standard deviations of a binomial count.
  EXPECT_GE(covered, 0.95 * all - 3. * std::sqrt(0.95 * 0.05 * all));
}

TEST(Sobol, IntervalsNarrowAsOneOverTheRootOfTheSamples) {
  const SobolIndices few = ishigami_indices(64, 3), many = ishigami_indices(4096, 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const double ratio = (few.total_interval[i].high - few.total_interval[i].low) /
                         (many.total_interval[i].high - many.total_interval[i].low);
    EXPECT_NEAR(ratio, 8., 3.) << i;
  }
  const SobolIndices again = ishigami_indices(64, 3);
  EXPECT_EQ(again.first_interval[0].low, few.first_interval[0].low);
  EXPECT_EQ(again.total_interval[2].high, few.total_interval[2].high);
}

TEST(Sobol, AFirstOrderIndexAboveTheTotalLiesWithinTheIntervals) {
  // No function has such indices; 16 samples do for the second constant, whose two are equal.
  int above = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const SobolIndices found = ishigami_indices(16, seed);
    if (found.first[1] <= found.total[1] + 0.1) continue;
    ++above;
    EXPECT_LE(found.first_interval[1].low, found.total_interval[1].high) << seed;
  }
  EXPECT_GT(above, 0);
}

TEST(Choice, OfATargetTheDistanceOfEachRunIsMinimised) {
  TunePlan plan = plan_of(1);
  plan.objectives[0].target = 3.;
  Candidate near = candidate_of({0.}), scattered = candidate_of({0.});
  near.measured = {{3.5}, {2.5}};
  scattered.measured = {{1.}, {5.}};  // its mean is the target itself
  EXPECT_DOUBLE_EQ(*value_of(plan.objectives[0], near), 0.5);
  EXPECT_DOUBLE_EQ(*value_of(plan.objectives[0], scattered), 2.);
  EXPECT_EQ(pareto_set(plan, {scattered, near}), (std::vector<std::size_t>{1}));
  plan.objectives[0].take = ObjectivePlan::Take::worst;
  near.measured = {{3.5}, {2.}};
  EXPECT_DOUBLE_EQ(*value_of(plan.objectives[0], near), 1.);
  // Distances, seed by seed: 0.5 less 2, 1 less 2.
  EXPECT_DOUBLE_EQ(compare_candidates(plan, near, scattered)[0].difference, -1.25);
}

TEST(Choice, ParetoSetIsWhatNoOtherDominates) {
  const TunePlan plan = plan_of(2);
  std::vector<Candidate> all;
  for (const auto& [x, y] : {std::pair{3., 1.}, {1., 3.}, {2., 2.}, {2., 2.}, {2.5, 2.5}, {1., 4.}})
    all.push_back(candidate_of({x, y}));
  EXPECT_EQ(pareto_set(plan, all), (std::vector<std::size_t>{1, 2, 0}));
  all[2].stage = CandidateStage::sobol;  // looked at, not sought
  EXPECT_EQ(pareto_set(plan, all), (std::vector<std::size_t>{1, 3, 0}));
}

TEST(Choice, RecommendsTheKneeAmongThoseThatBeatBothReferences) {
  const TunePlan plan = plan_of(2);
  std::vector<Candidate> all;
  for (const auto& [x, y] : {std::pair{0., 10.}, {2., 2.}, {10., 0.}, {7., 1.}, {8., 1.5}})
    all.push_back(candidate_of({x, y}));
  const std::vector<std::size_t> front = pareto_set(plan, all);
  EXPECT_EQ(front, (std::vector<std::size_t>{0, 1, 3, 2}));
  EXPECT_EQ(recommend(plan, all, front, {})->candidate, 1u);
  const std::vector<std::size_t> reference{4};
  const auto beats = recommend(plan, all, front, reference);
  EXPECT_EQ(beats->candidate, 3u);
  EXPECT_NE(beats->reason.find("of the 1 of 4"), std::string::npos) << beats->reason;
}

TEST(Choice, IsNotMeasuredByWhatMissesARequirement) {
  TunePlan plan = plan_of(2);
  RequirementPlan required;
  required.below = 5.;
  plan.requirements.push_back(required);
  std::vector<Candidate> all;
  for (const auto& [x, y] : {std::pair{0., 10.}, {2., 2.}, {4., 1.}, {6., 0.5}, {4.5, 1.5}})
    all.push_back(candidate_of({x, y}));
  const std::vector<std::size_t> front = pareto_set(plan, all);
  const auto knee = recommend(plan, all, front, std::vector<std::size_t>{3});
  EXPECT_EQ(knee->candidate, 1u) << "none has the 0.5 of the reference, which may not be";
  EXPECT_NE(knee->reason.find("miss a requirement; of all 3"), std::string::npos) << knee->reason;
  const auto beats = recommend(plan, all, front, std::vector<std::size_t>{3, 4});
  EXPECT_EQ(beats->candidate, 2u);
  EXPECT_NE(beats->reason.find("what of the file's own"), std::string::npos) << beats->reason;
}

TEST(Choice, WhereNothingIsFeasibleWhatMissesLeastIsNamedSo) {
  TunePlan plan = plan_of(1);
  RequirementPlan required;
  required.below = 1.;
  plan.requirements.push_back(required);
  const std::vector<Candidate> all{candidate_of({5.}), candidate_of({2.}), candidate_of({3.})};
  EXPECT_TRUE(pareto_set(plan, all).empty());
  const auto found = recommend(plan, all, {}, {});
  EXPECT_EQ(found->candidate, 1u);
  EXPECT_FALSE(found->feasible);
  EXPECT_EQ(violation_of(plan, all[1]), 1.);
}

TEST(Choice, ARequirementHoldsBeyondItsBoundAlone) {
  RequirementPlan required;
  required.above = 2.;
  EXPECT_GT(required.missed_by(2.), 0.);
  EXPECT_EQ(required.missed_by(2.1), 0.);
  EXPECT_EQ(required.missed_by(1.), 0.5);
  RequirementPlan equal;
  equal.equals = 0.;
  EXPECT_EQ(equal.missed_by(0.), 0.);
  EXPECT_EQ(equal.missed_by(0.25), 0.25);
}

/// A candidate whose run came to its end without a value of the second metric, or broke off.
Candidate without_second(double first, const char* status) {
  Candidate candidate = candidate_of({first, 0.});
  candidate.measured[0][1].reset();
  candidate.statuses = {status};
  return candidate;
}

TEST(Choice, ARequirementThatMayBeEmptyIsMetByARunWithoutItsValue) {
  TunePlan plan = plan_of(1);
  RequirementPlan required;
  required.metric = 1;
  required.below = 5.;
  plan.requirements.push_back(required);
  const Candidate ended = without_second(1., "ok"), broken = without_second(1., "not_finite");
  EXPECT_FALSE(is_feasible(plan, ended));
  EXPECT_FALSE(meets(ended, plan.requirements[0]));
  plan.requirements[0].may_be_empty = true;
  EXPECT_TRUE(is_feasible(plan, ended));
  EXPECT_TRUE(meets(ended, plan.requirements[0]));
  EXPECT_FALSE(is_feasible(plan, broken)) << "a run that breaks off has met nothing";
  EXPECT_FALSE(meets(broken, plan.requirements[0]));
  EXPECT_FALSE(is_feasible(plan, candidate_of({1., 6.}))) << "a value is judged as ever";
  // Another block needs the same metric.
  plan.objectives.push_back({1, false, ObjectivePlan::Take::mean});
  EXPECT_FALSE(is_feasible(plan, ended));
}

TEST(Choice, ACandidateWithoutTheValueOfAnObjectiveThatMayBeEmptyIsTheWorstInIt) {
  TunePlan plan = plan_of(2);
  const std::vector<Candidate> all{without_second(3., "ok"), without_second(2., "ok"),
                                   without_second(1., "not_finite")};
  EXPECT_TRUE(pareto_set(plan, all).empty());
  plan.objectives[1].may_be_empty = true;
  EXPECT_EQ(pareto_set(plan, all), std::vector<std::size_t>{1}) << "the first objective decides";
  EXPECT_EQ(recommend(plan, all, {1}, {})->candidate, 1u);
  for (const bool maximise : {false, true}) {
    plan.objectives[1].maximise = maximise;
    const std::vector<Candidate> one_known{without_second(2., "ok"), candidate_of({2., 1e6}),
                                           candidate_of({2., -1e6})};
    EXPECT_EQ(pareto_set(plan, one_known), std::vector<std::size_t>{maximise ? 1u : 2u});
  }
}

TEST(Choice, BetterIsBeyondStudentsMarginOfTheSeeds) {
  const TunePlan plan = plan_of(1);
  Candidate tuned = candidate_of({0.}), other = candidate_of({0.});
  tuned.measured = {{1.}, {1.}, {1.}, {1.}};
  other.measured = {{2.}, {3.}, {4.}, {5.}};
  // Differences -1, -2, -3, -4: mean -2.5, standard error sqrt(5/3)/2, t(3) at 97.5 % is 3.182446.
  const auto found = compare_candidates(plan, tuned, other).front();
  EXPECT_DOUBLE_EQ(found.difference, -2.5);
  EXPECT_NEAR(found.margin, 3.182446 * std::sqrt(5. / 3.) / 2., 1e-5);
  EXPECT_EQ(found.verdict, ObjectiveComparison::Verdict::better);
  other.measured = {{2.}, {0.}, {2.}, {0.5}};
  EXPECT_EQ(compare_candidates(plan, tuned, other).front().verdict,
            ObjectiveComparison::Verdict::within_noise);
  EXPECT_EQ(compare_candidates(plan, candidate_of({1.}), candidate_of({2.})).front().verdict,
            ObjectiveComparison::Verdict::undecided);
}

}  // namespace
}  // namespace hookpoint::studies
