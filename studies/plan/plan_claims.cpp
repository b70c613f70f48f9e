// Claim blocks: a sentence whose braces are numbers of the study.
#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "language/document.h"
#include "language/names.h"
#include "studies/plan/plan_builder.h"
#include "studies/selection.h"

namespace hookpoint::studies {

using language::Object;

namespace {

/// The words between two braces, taken from the front.
class ClaimWords {
 public:
  explicit ClaimWords(const std::string& text) {
    std::istringstream words(text);
    for (std::string word; words >> word;) words_.push_back(std::move(word));
  }
  bool take(std::string_view word) {
    if (at_ == words_.size() || words_[at_] != word) return false;
    ++at_;
    return true;
  }
  /// The next one; "" behind the last.
  std::string next() { return at_ == words_.size() ? "" : words_[at_++]; }
  /// What stands before `end` or the end.
  std::string until(std::string_view end) {
    std::string text;
    while (at_ < words_.size() && words_[at_] != end) text += (text.empty() ? "" : " ") + next();
    return text;
  }
  bool done() const { return at_ == words_.size(); }

 private:
  std::vector<std::string> words_;
  std::size_t at_ = 0;
};

ClaimTake take_of(ClaimWords& words) {
  if (words.take("subject")) {
    if (words.take("of")) {
      if (words.take("least")) return ClaimTake::subject_of_least;
      if (words.take("largest")) return ClaimTake::subject_of_largest;
    }
    return ClaimTake::nothing;
  }
  if (words.take("least")) return ClaimTake::least;
  if (words.take("largest")) return ClaimTake::largest;
  if (words.take("predicted")) return ClaimTake::predicted;
  words.take("mean");
  return ClaimTake::mean;
}

}  // namespace

bool PlanBuilder::is_claim_place(const Object& block, const std::string& name,
                                 const std::string& value, SweepValues& where) {
  const language::Position& place = block.find("text")->position;
  const int index = sweep_index(name);
  if (index < 0) {
    unknown(place, "Sweep", name, sweep_names());
    return false;
  }
  const SweepPlan& sweep = plan_.sweeps[static_cast<std::size_t>(index)];
  const bool words = !sweep.column.words.empty();
  const auto number = words ? std::nullopt : language::number_of(value, sweep.column.unit);
  const bool declared = words ? std::ranges::count(sweep.declared_words, value) > 0
                              : number && std::ranges::any_of(sweep.declared, [&](double v) {
                                  return same_value(*number, v);
                                });
  if (!declared) {
    diagnostics_.error(place, no_such_value(sweep, value, number));
    return false;
  }
  // Empty where --quick leaves it out.
  std::vector<double>& values = where.emplace_back(name, std::vector<double>{}).second;
  for (std::size_t i = 0; i < sweep.si.size(); ++i) {
    const bool same = words ? value == sweep.column.words[i] : same_value(*number, sweep.si[i]);
    if (same) values.push_back(sweep.column.values[i]);
  }
  return true;
}

std::optional<ClaimValue> PlanBuilder::claim_value(const Object& block, const std::string& text) {
  const language::Position& place = block.find("text")->position;
  ClaimWords words(text);
  ClaimValue value;
  value.take = take_of(words);
  const std::string metric = words.next();
  const std::ptrdiff_t index = measured_index(metric);
  if (value.take == ClaimTake::nothing || index < 0) {
    if (value.take == ClaimTake::nothing)
      diagnostics_.error(place, fmt::format("`{{{}}}` is no number of the study: expected `subject "
                                            "of least METRIC` or `subject of largest METRIC`",
                                            text));
    else
      unknown(place, "Measure of this study", metric, measured_names());
    return std::nullopt;
  }
  value.metric = static_cast<std::size_t>(index);
  if (words.take("of")) {
    const std::string name = words.next();
    const auto subject = std::ranges::find_if(
        plan_.subjects, [&](const SubjectPlan& one) { return one.info.name == name; });
    if (subject == plan_.subjects.end()) {
      std::vector<std::string> known;
      for (const SubjectPlan& one : plan_.subjects) known.push_back(one.info.name);
      unknown(place, "Subject", name, known);
      return std::nullopt;
    }
    value.subject = static_cast<int>(subject - plan_.subjects.begin());
  }
  for (bool more = words.take("at"); more;) {
    const std::string name = words.next();
    words.take("=");
    if (!is_claim_place(block, name, words.until("and"), value.where)) return std::nullopt;
    more = words.take("and");
  }
  if (words.done()) return value;
  diagnostics_.error(place,
                     fmt::format("`{}` in `{{{}}}` is not understood: expected [least, largest or "
                                 "predicted] METRIC [of SUBJECT] [at SWEEP = VALUE]",
                                 words.next(), text));
  return std::nullopt;
}

std::optional<ClaimPart> PlanBuilder::claim_number(const Object& block, const std::string& text) {
  constexpr std::string_view over = " / ";
  const std::size_t slash = text.find(over);
  ClaimPart part;
  part.value = claim_value(block, text.substr(0, slash));
  if (!part.value) return std::nullopt;
  if (slash == std::string::npos) return part;
  part.divisor = claim_value(block, text.substr(slash + over.size()));
  if (!part.divisor) return std::nullopt;
  return part;
}

bool PlanBuilder::claim_parts(const Object& block, std::vector<ClaimPart>& parts) {
  const std::string& text = block.word("text");
  std::string plain;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    const bool twice = (c == '{' || c == '}') && at + 1 < text.size() && text[at + 1] == c;
    if (twice) ++at;
    if (twice || (c != '{' && c != '}')) {
      plain += c;
      continue;
    }
    const std::size_t end = c == '{' ? text.find('}', at) : std::string::npos;
    if (end == std::string::npos) {
      diagnostics_.error(block.find("text")->position,
                         "a brace in the text opens or closes no number; two stand for one");
      return false;
    }
    parts.push_back({std::exchange(plain, ""), {}, {}});
    auto number = claim_number(block, text.substr(at + 1, end - at - 1));
    if (!number) return false;
    parts.push_back(std::move(*number));
    at = end;
  }
  parts.push_back({std::move(plain), {}, {}});
  return true;
}

std::vector<int> PlanBuilder::claim_truths(const Object& block,
                                           const std::vector<ClaimPart>& parts) {
  std::vector<int> truths;
  if (block.given("truth")) {
    std::vector<std::string> known;
    for (const TruthPlan& truth : plan_.truths) known.push_back(truth.name);
    const language::Field& named = *block.find("truth");
    for (std::size_t i = 0; i < named.words.size(); ++i) {
      if (std::ranges::find(known, named.words[i]) == known.end())
        unknown(named.places[i], "Truth", named.words[i], known);
      for (std::size_t truth = 0; truth < known.size(); ++truth)
        if (known[truth] == named.words[i]) truths.push_back(static_cast<int>(truth));
    }
    return truths;
  }
  for (std::size_t truth = 0; truth < plan_.truths.size(); ++truth) {
    const bool about = std::ranges::any_of(parts, [&](const ClaimPart& part) {
      const std::size_t metric = plan_.truths[truth].metric;
      return (part.value && part.value->metric == metric) ||
             (part.divisor && part.divisor->metric == metric);
    });
    if (about) truths.push_back(static_cast<int>(truth));
  }
  return truths;
}

void PlanBuilder::add_claim(const Object& block) {
  ClaimSpec claim;
  claim.name = block.name;
  claim.where = plan_.admitted(conditions(block));
  claim.may_be_empty = block.boolean("may_be_empty");
  if (!claim_parts(block, claim.parts)) return;
  claim.truths = claim_truths(block, claim.parts);
  plan_.claims.push_back(std::move(claim));
}

}  // namespace hookpoint::studies
