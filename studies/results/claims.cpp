#include "studies/results/claims.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "studies/results/idleness.h"
#include "studies/results/selection.h"
#include "studies/results/statistics.h"
#include "text/number.h"
#include "text/units.h"

namespace hookpoint::studies {
namespace {

constexpr const char* no_number = "(no value)";

/// Values of a claim's rows, in their order; of all subjects where `subject` is negative.
std::vector<double> values_of_claim(const StudyResult& study, const ClaimSpec& claim,
                                    const ClaimValue& value, int subject) {
  std::vector<double> values;
  for (const RunResult& row : study.rows) {
    const bool meant = (subject < 0 || row.subject == subject) && admits(study, claim.where, row) &&
                       admits(study, value.where, row);
    if (!meant) continue;
    const MetricValue& metric = row.metrics[value.metric];
    const auto& number = value.take == ClaimTake::predicted ? metric.predicted : metric.measured;
    if (number) values.push_back(*number);
  }
  return values;
}

std::optional<double> number_of(const StudyResult& study, const ClaimSpec& claim,
                                const ClaimValue& value) {
  const std::vector<double> values = values_of_claim(study, claim, value, value.subject);
  if (values.empty()) return std::nullopt;
  switch (value.take) {
    case ClaimTake::least:
      return std::ranges::min(values);
    case ClaimTake::largest:
      return std::ranges::max(values);
    default:
      return mean(values);
  }
}

/// The subject whose mean is the least or the largest; "" where none has one.
std::string named_subject_of(const StudyResult& study, const ClaimSpec& claim,
                             const ClaimValue& value) {
  std::string name;
  double best = 0.;
  for (std::size_t i = 0; i < study.subjects.size(); ++i) {
    const auto values = values_of_claim(study, claim, value, static_cast<int>(i));
    if (values.empty()) continue;
    const double middle = mean(values);
    const bool better = value.take == ClaimTake::subject_of_least ? middle < best : middle > best;
    if (!name.empty() && !better) continue;
    name = study.subjects[i].name;
    best = middle;
  }
  return name;
}

bool names_subject(const ClaimValue& value) {
  return value.take == ClaimTake::subject_of_least || value.take == ClaimTake::subject_of_largest;
}

/// "0.167 m/s"
std::string with_unit(double number, const std::string& unit) {
  constexpr int digits = 3;
  return text::rounded(number, digits) + (unit.empty() ? "" : " " + unit);
}

/// The ratio of two numbers; in SI with its unit where they are in different units.
std::string ratio_text(double number, const std::string& unit, double divisor,
                       const std::string& divisor_unit) {
  const auto over = text::parse_unit(unit), under = text::parse_unit(divisor_unit);
  if (unit == divisor_unit || !over || !under) return with_unit(number / divisor, "");
  const auto si = [](double value, const text::Unit& in) {
    return value * in.numerator / in.denominator;
  };
  return with_unit(si(number, *over) / si(divisor, *under),
                   text::unit_text(over->dimension / under->dimension));
}

std::string words_of(const StudyResult& study, const ClaimSpec& claim, const ClaimPart& part) {
  const ClaimValue& value = *part.value;
  if (names_subject(value)) return named_subject_of(study, claim, value);
  const auto number = number_of(study, claim, value);
  if (!number) return "";
  const std::string& unit = study.metrics[value.metric].unit;
  if (!part.divisor) return with_unit(*number, unit);
  const auto divisor = number_of(study, claim, *part.divisor);
  if (!divisor || !std::isfinite(*number / *divisor)) return "";
  return ratio_text(*number, unit, *divisor, study.metrics[part.divisor->metric].unit);
}

std::string runs(int count) { return std::to_string(count) + (count == 1 ? " run" : " runs"); }

void judge_by_truths(const StudyResult& study, const ClaimSpec& claim, SaidClaim& said) {
  std::string failing, holding, idle;
  for (const int index : claim.truths) {
    const TruthResult& truth = study.truths[static_cast<std::size_t>(index)];
    const int all = truth.passed + truth.failed;
    if (truth.failed > 0)
      failing += (failing.empty() ? "" : ", ") + truth.name + " in " +
                 std::to_string(truth.failed) + " of " + runs(all);
    else if (all > 0)
      holding += (holding.empty() ? "" : ", ") + truth.name + " in " + runs(all);
    else
      idle += (idle.empty() ? "" : ", ") + truth.name;
  }
  said.verdict = !failing.empty()   ? ClaimVerdict::fails
                 : !holding.empty() ? ClaimVerdict::holds
                                    : ClaimVerdict::unjudged;
  said.why = !failing.empty()   ? "does not hold: it fails " + failing
             : !holding.empty() ? "holds: " + holding
             : !idle.empty()    ? "not judged: nothing is judged by the Truth " + idle
                                : "no Truth judges it";
}

}  // namespace

Idleness idleness_of(const StudyResult& study, const ClaimSpec& claim) {
  Idleness left_out;
  for (const ClaimPart& part : claim.parts)
    for (const auto& value : {part.value, part.divisor}) {
      if (!value) continue;
      RunSelection selection{{}, {&claim.where, &value->where}};
      if (value->subject >= 0) selection.subjects = {value->subject};
      Idleness found =
          why_no_value(study, selection, {value->metric, value->take == ClaimTake::predicted});
      if (found.idle == Idle::fault) return found;
      if (found.idle != Idle::no) left_out = std::move(found);
    }
  if (left_out.idle != Idle::no) return left_out;
  const bool finite = std::ranges::all_of(claim.parts, [&](const ClaimPart& part) {
    return !part.divisor || std::isfinite(*number_of(study, claim, *part.value) /
                                          *number_of(study, claim, *part.divisor));
  });
  return finite ? Idleness{} : Idleness{Idle::fault, "a ratio of its numbers is not finite"};
}

SaidClaim said_of(const StudyResult& study, const ClaimSpec& claim) {
  SaidClaim said;
  bool whole = true;
  for (const ClaimPart& part : claim.parts) {
    if (!part.value) {
      said.text += part.text;
      continue;
    }
    const std::string words = words_of(study, claim, part);
    whole = whole && !words.empty();
    said.text += words.empty() ? no_number : words;
  }
  judge_by_truths(study, claim, said);
  if (!whole && said.verdict != ClaimVerdict::fails) {
    said.verdict = ClaimVerdict::unsaid;
    const Idleness idleness = idleness_of(study.runs != nullptr ? *study.runs : study, claim);
    said.why = "cannot be said: " + idleness.why;
    said.excused = claim.may_be_empty || idleness.idle == Idle::left_out;
  }
  return said;
}

}  // namespace hookpoint::studies
