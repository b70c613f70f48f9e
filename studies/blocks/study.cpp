#include "studies/blocks/study.h"

#include <algorithm>
#include <utility>

#include "language/values/formula.h"
#include "studies/blocks/study_parts.h"

namespace hookpoint::studies {

using language::Diagnostics;
using language::Object;

namespace {

Fields<StudyBlock> make_study_fields() {
  Fields<StudyBlock> fields;
  append(fields,
         heading_fields("heading of the report", "what the study asks, first thing in the report"));
  append<language::LoadedField<StudyBlock>>(
      fields,
      {required(text_field("scene", &StudyBlock::scene,
                           "file of the world, whose Params a Sweep may vary")),
       formula_field("body", &StudyBlock::body,
                     "the body that metrics of motion look at: a robot, which stands for its "
                     "base, or a link; default: the base of the first mobile robot, or else the "
                     "end of the first chain")});
  append(fields,
         times_fields("simulated time of every run; default, with Cases that have Traces: each "
                      "up to its last sample",
                      "time from which metrics are measured: the start may ring; the manual says "
                      "which metrics are of the whole run"));
  append<language::LoadedField<StudyBlock>>(
      fields, {between(1, 10000,
                       integer_field("seeds", &StudyBlock::seeds,
                                     "runs of each row, with the seeds 1, 2, 3 ...; default: "
                                     "one, with the scene's own")),
               choice_field("match", {"hookpoint"}, &StudyBlock::match,
                            "choose every law's constants so that the ground is as deep and "
                            "stiff under the scene's load, and rebounds as much, as hookpoint's"),
               boolean_field("expects", &StudyBlock::expects,
                             "whether the Expects of the scene are measured and judged too, where "
                             "the study runs as long as the scene")});
  return fields;
}

const Fields<StudyBlock>& study_fields() {
  static const Fields<StudyBlock> fields = make_study_fields();
  return fields;
}

}  // namespace

void add_study_class(language::Schema& schema) {
  schema.add(top_block_class(
      "Study",
      "One scene under every subject and parameter value, measured and held against closed forms.",
      schemas(study_fields()),
      {"Subject", "Sweep", "Cases", "Measure", "Truth", "Plot", "Table", "Claim", "Fix"}));
}

StudyBlock study_block(const Object& block) { return load_fields(block, study_fields()); }

std::filesystem::path load_study(const Object& study, StudyParts& parts, Diagnostics& diagnostics) {
  const StudyBlock block = study_block(study);
  parts.name = study.name;
  parts.title = block.title;
  parts.question = block.question;
  if (block.body != nullptr) {
    const language::Formula& body = *block.body->formula;
    if (body.names.size() == 1 && body.text == body.names.front())
      parts.body = body.text;
    else
      diagnostics.error(block.body->position,
                        "`body` is the trail of a robot or of a body of one: arm.leg1.link2");
  }
  parts.match = block.match.given();
  const RunTimes times = load_times(block, parts.quick);
  parts.settle = times.settle;
  parts.duration = times.duration.value_or(0.);
  if (times.duration && parts.settle >= parts.duration)
    diagnostics.error((block.duration ? block.duration : block.quick_duration).position(),
                      "duration must be longer than settle: nothing would be measured");
  const std::filesystem::path scene = parts.library->find(*block.scene, parts.file);
  if (scene.empty())
    diagnostics.error(block.scene.position(),
                      "no file \"" + *block.scene + "\" beside the study or in configs/");
  return scene;
}

void load_seeds(const Object& study, StudyParts& so_far, Diagnostics& diagnostics) {
  const Placed<int> seeds = study_block(study).seeds;
  if (!seeds) return;
  constexpr const char* seed = "seed";
  const auto is_seed = [&](const Assignment& fix) { return fix.parameter == seed; };
  bool taken = so_far.sweep_index(seed) >= 0 || std::ranges::any_of(so_far.fixes, is_seed);
  for (const SubjectPlan& subject : so_far.subjects)
    taken = taken || std::ranges::any_of(subject.fixes, is_seed);
  if (taken)
    return diagnostics.error(seeds.position(),
                             "`seeds` varies the Param `seed`: it cannot be swept or fixed");
  if (so_far.is_varied(seed))
    return diagnostics.error(seeds.position(),
                             "`seeds` varies the Param `seed`, which the Cases set");
  SweepPlan sweep;
  sweep.column.name = seed;
  sweep.role = SweepRole::seeds;
  for (int i = 1; i <= *seeds; ++i) {
    sweep.si.push_back(i);
    sweep.texts.push_back(std::to_string(i));
    sweep.places.push_back(seeds.position());
  }
  sweep.column.values = sweep.si;
  so_far.sweeps.push_back(std::move(sweep));
}

}  // namespace hookpoint::studies
