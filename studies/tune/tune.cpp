#include "studies/tune/tune.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "studies/search/analytic_guess.h"
#include "studies/search/step_warnings.h"
#include "studies/tune/outputs.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

/// Places in a constant's range that are looked at one at a time.
constexpr int places_one_at_a_time = 9;

/// The work of a tuning, stage by stage; each needs those before it.
class Tuning {
 public:
  Tuning(const TunePlan& plan, const EngineTable& engines, const TuneOptions& options,
         const std::filesystem::path& folder, const std::atomic<bool>& stop)
      : plan_(plan),
        engines_(engines),
        options_(options),
        stop_(stop),
        guess_(analytic_guess({*plan.scene, plan.varied, plan.own}, result_.analytic_words)),
        runs_(plan.runs.name, options.run, folder, total_runs(), stop),
        candidates_(plan, engines, runs_, stop) {
    if (guess_) result_.analytic_words = guess_->words;
  }

  TuneResult run() {
    try {
      evaluate_references();
      search_box();
      choose();
      warn_of_step();
      check_on_fresh_seeds();
      vary_one_at_a_time();
      find_indices();
      record_depths();
    } catch (const TuneInterrupted&) {
      result_.interrupted = true;
      if (!result_.recommended) choose();
    }
    result_.candidates = candidates_.all();
    return std::move(result_);
  }

 private:
  using Wanted = Candidates::Wanted;
  using Values = std::vector<double>;

  std::size_t total_runs() const {
    const auto count = [](int number) { return static_cast<std::size_t>(number); };
    const std::size_t references = guess_ ? 2 : 1;
    const std::size_t constants = plan_.varied.size();
    const std::size_t candidates = references + count(plan_.population) * count(plan_.generations) +
                                   constants * count(places_one_at_a_time) +
                                   count(plan_.samples) * (constants + 2);
    return candidates * count(plan_.seeds) + (references + 1) * count(fresh_seeds(plan_));
  }

  Values values_at(const std::vector<double>& shares) const {
    Values values;
    for (std::size_t i = 0; i < shares.size(); ++i) values.push_back(plan_.varied[i].at(shares[i]));
    return values;
  }

  std::vector<std::size_t> evaluate(CandidateStage stage, int generation,
                                    const std::vector<Values>& all) {
    std::vector<Wanted> wanted;
    for (const Values& values : all) wanted.push_back({stage, generation, values, 1, plan_.seeds});
    return candidates_.evaluate(wanted);
  }

  void evaluate_references() {
    std::vector<Wanted> wanted{{CandidateStage::own, 0, {}, 1, plan_.seeds}};
    if (guess_) wanted.push_back({CandidateStage::analytic, 0, guess_->values, 1, plan_.seeds});
    const auto indices = candidates_.evaluate(wanted);
    result_.references.push_back({"the file's own constants", "own", indices[0], std::nullopt, {}});
    if (guess_)
      result_.references.push_back(
          {"the analytic guess", "analytic", indices[1], std::nullopt, {}});
  }

  /// The first guesses as points of the box.
  std::vector<std::vector<double>> first_points() const {
    std::vector<std::vector<double>> points;
    const bool own_known =
        std::ranges::all_of(plan_.own, [](const auto& value) { return value.has_value(); });
    std::vector<double> own, guess;
    for (std::size_t i = 0; i < plan_.varied.size(); ++i) {
      if (own_known) own.push_back(plan_.varied[i].share_of(*plan_.own[i]));
      if (guess_) guess.push_back(plan_.varied[i].share_of(guess_->values[i]));
    }
    if (own_known) points.push_back(std::move(own));
    if (guess_) points.push_back(std::move(guess));
    return points;
  }

  void search_box() {
    const SearchOptions options{plan_.method,     plan_.varied.size(), plan_.objectives.size(),
                                plan_.population, plan_.generations,   plan_.seed,
                                first_points()};
    start_ = std::chrono::steady_clock::now();
    search(options, [this](std::span<const std::vector<double>> points, int generation) {
      std::vector<Values> values;
      for (const std::vector<double>& shares : points) values.push_back(values_at(shares));
      std::vector<Score> scores;
      for (const std::size_t index : evaluate(CandidateStage::search, generation + 1, values))
        scores.push_back(score_of(plan_, candidates_[index]));
      tell(generation + 1);
      return scores;
    });
  }

  void tell(int generation) const {
    if (!options_.generation) return;
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    GenerationReport report{generation, plan_.generations, 0., 0, {}};
    report.runs_per_second = static_cast<double>(runs_.count()) / elapsed.count();
    const auto pareto = pareto_set(plan_, candidates_.all());
    report.pareto = pareto.size();
    for (const ObjectivePlan& objective : plan_.objectives) {
      std::optional<double> best;
      for (const std::size_t member : pareto) {
        const auto value = value_of(objective, candidates_[member]);
        if (!value) continue;
        if (!best || (objective.maximise ? *value > *best : *value < *best)) best = value;
      }
      const std::string unit = plan_.shown_unit_of(objective);
      if (best)
        report.best.push_back(plan_.label_of(objective) + " " +
                              text::rounded(*best * objective.in_written_unit, 3) +
                              (unit.empty() ? "" : " " + unit));
    }
    options_.generation(report);
  }

  void choose() {
    result_.pareto = pareto_set(plan_, candidates_.all());
    std::vector<std::size_t> references;
    for (const TuneReference& reference : result_.references)
      references.push_back(reference.candidate);
    result_.recommended = recommend(plan_, candidates_.all(), result_.pareto, references);
  }

  /// What a candidate was evaluated with: the files' own constants are set by nothing.
  Values wanted_values(std::size_t index) const {
    const Candidate& candidate = candidates_[index];
    Values values;
    if (candidate.stage == CandidateStage::own) return values;
    for (const auto& value : candidate.values) values.push_back(*value);
    return values;
  }

  /// The search has seen its own seeds, and chose what they favour.
  void check_on_fresh_seeds() {
    const auto first = static_cast<std::uint64_t>(plan_.seeds) + 1;
    const auto fresh = [&](std::size_t index) {
      return Wanted{CandidateStage::fresh_seeds, 0, wanted_values(index), first,
                    fresh_seeds(plan_)};
    };
    std::vector<Wanted> wanted{fresh(result_.recommended->candidate)};
    for (const TuneReference& reference : result_.references)
      wanted.push_back(fresh(reference.candidate));
    const auto indices = candidates_.evaluate(wanted);
    result_.fresh = indices[0];
    for (std::size_t i = 0; i < result_.references.size(); ++i) {
      TuneReference& reference = result_.references[i];
      reference.fresh = indices[i + 1];
      reference.comparisons =
          compare_candidates(plan_, candidates_[indices[0]], candidates_[indices[i + 1]]);
    }
  }

  void vary_one_at_a_time() {
    const auto& best = candidates_[result_.recommended->candidate].values;
    if (!std::ranges::all_of(best, [](const auto& value) { return value.has_value(); })) return;
    std::vector<Values> all;
    for (std::size_t i = 0; i < plan_.varied.size(); ++i) {
      for (int place = 0; place < places_one_at_a_time; ++place) {
        Values values;
        for (const auto& value : best) values.push_back(*value);
        values[i] = plan_.varied[i].at(static_cast<double>(place) / (places_one_at_a_time - 1));
        all.push_back(std::move(values));
      }
    }
    const auto indices = evaluate(CandidateStage::one_at_a_time, 0, all);
    for (std::size_t i = 0; i < plan_.varied.size(); ++i) {
      OneAtATime& one = result_.one_at_a_time.emplace_back();
      for (int place = 0; place < places_one_at_a_time; ++place) {
        one.shares.push_back(static_cast<double>(place) / (places_one_at_a_time - 1));
        one.candidates.push_back(indices[i * static_cast<std::size_t>(places_one_at_a_time) +
                                         static_cast<std::size_t>(place)]);
      }
    }
  }

  void find_indices() {
    if (plan_.samples == 0) return;
    result_.indices = sobol_indices(
        plan_.varied.size(), plan_.objectives.size(), static_cast<std::size_t>(plan_.samples),
        plan_.seed, [this](std::span<const std::vector<double>> points) {
          std::vector<Values> values;
          for (const std::vector<double>& shares : points) values.push_back(values_at(shares));
          std::vector<std::vector<std::optional<double>>> outputs;
          for (const std::size_t index : evaluate(CandidateStage::sobol, 0, values)) {
            auto& output = outputs.emplace_back();
            for (const ObjectivePlan& objective : plan_.objectives)
              output.push_back(value_of(objective, candidates_[index]));
          }
          return outputs;
        });
  }

  void warn_of_step() const {
    const auto warning =
        step_warning(*plan_.scene, plan_.settings(wanted_values(result_.recommended->candidate)));
    if (warning && options_.run.tell)
      options_.run.tell(plan_.label + ", recommended constants: " + *warning);
  }

  /// One more run of each set, for a picture.
  void record_depths() {
    const Measurement depth{
        plan_.runs.settle, plan_.runs.duration, {}, {{find_signal("penetration"), false}}, false};
    const auto record = [&](const std::string& name, std::size_t candidate) {
      language::Diagnostics unreported;
      auto scene = plan_.scene->load(plan_.settings(wanted_values(candidate)), 1, unreported);
      if (!scene) return;
      scene->experiment.duration = depth.duration;
      const auto run = execute(depth, scene->experiment, engines_, "", stop_);
      if (!run) throw TuneInterrupted{};
      result_.depths.push_back({name, trace_of(run->curves.at(depth.signals.front().name()))});
    };
    record("recommended", result_.recommended->candidate);
    for (const TuneReference& reference : result_.references)
      record(reference.name, reference.candidate);
  }

  const TunePlan& plan_;
  const EngineTable& engines_;
  const TuneOptions& options_;
  const std::atomic<bool>& stop_;
  TuneResult result_;
  std::optional<AnalyticGuess> guess_;
  CachedRuns runs_;
  Candidates candidates_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace

bool TuneResult::holds(const TunePlan& plan) const {
  return recommended && recommended->feasible && (!fresh || is_feasible(plan, candidates[*fresh]));
}

TuneRun run_tuning(const TunePlan& plan, const EngineTable& engines, const TuneOptions& options,
                   const std::atomic<bool>& stop) {
  TuneRun run;
  run.folder = options.run.folder.empty() ? plan.folder() : options.run.folder;
  run.files =
      std::make_unique<output::ResultFolder>(run.folder, manifest_of(plan.runs), tune_files(plan));
  run.result = Tuning(plan, engines, options, run.folder, stop).run();
  run.provenance = make_provenance(plan.runs, engines);
  for (int seed = 1; seed <= plan.seeds + fresh_seeds(plan); ++seed)
    run.provenance.seeds.push_back(static_cast<std::uint64_t>(seed));
  return run;
}

}  // namespace hookpoint::studies
