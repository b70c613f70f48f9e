#include "studies/blocks/claim.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "language/document/document.h"
#include "language/names.h"
#include "studies/blocks/block.h"
#include "studies/blocks/study_parts.h"
#include "studies/results/selection.h"

namespace hookpoint::studies {

using language::Diagnostics;
using language::Object;

namespace {

struct ClaimBlock {
  Placed<std::string> text;
  Placed<std::vector<std::string>> truth;
  bool may_be_empty = false;
};

const Fields<ClaimBlock>& claim_fields() {
  static const Fields<ClaimBlock> fields{
      required(
          text_field("text", &ClaimBlock::text,
                     "the sentence; in braces [least, largest or predicted] METRIC [of SUBJECT] "
                     "[at SWEEP = VALUE], two with / between them, or subject of least METRIC")),
      words_field("truth", 100, &ClaimBlock::truth,
                  "Truths that it stands and falls with; default: those of the metrics that it "
                  "names"),
      may_be_empty_field(&ClaimBlock::may_be_empty, "no run has one of its numbers")};
  return fields;
}

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

/// One Claim block.
class ClaimLoader {
 public:
  ClaimLoader(const Object& object, const StudyParts& so_far, Diagnostics& diagnostics)
      : object_(object),
        block_(load_fields(object, claim_fields())),
        so_far_(so_far),
        diagnostics_(diagnostics) {}

  std::optional<ClaimSpec> load() {
    ClaimSpec claim;
    claim.name = object_.name;
    claim.where = so_far_.admitted(load_conditions(object_, so_far_, diagnostics_));
    claim.may_be_empty = block_.may_be_empty;
    if (!load_parts(claim.parts)) return std::nullopt;
    claim.truths = truths_of(claim.parts);
    return claim;
  }

 private:
  /// What stands between two braces of the text; nothing after an error.
  std::optional<ClaimPart> load_number(const std::string& text) {
    constexpr std::string_view over = " / ";
    const std::size_t slash = text.find(over);
    ClaimPart part;
    part.value = load_value(text.substr(0, slash));
    if (!part.value) return std::nullopt;
    if (slash == std::string::npos) return part;
    part.divisor = load_value(text.substr(slash + over.size()));
    if (!part.divisor) return std::nullopt;
    return part;
  }

  /// Adds the value of the sweep `name` that `value` is to `where`; false after an error.
  bool is_place(const std::string& name, const std::string& value, SweepValues& where) {
    const language::Position& place = block_.text.position();
    const int index = so_far_.sweep_index(name);
    if (index < 0) {
      report_unknown(place, "Sweep", name, so_far_.sweep_names(), diagnostics_);
      return false;
    }
    const SweepPlan& sweep = so_far_.sweeps[static_cast<std::size_t>(index)];
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

  std::optional<ClaimValue> load_value(const std::string& text) {
    const language::Position& place = block_.text.position();
    ClaimWords words(text);
    ClaimValue value;
    value.take = take_of(words);
    const std::string metric = words.next();
    const std::ptrdiff_t index = so_far_.metric_index(metric);
    if (value.take == ClaimTake::nothing || index < 0) {
      if (value.take == ClaimTake::nothing)
        diagnostics_.error(place,
                           fmt::format("`{{{}}}` is no number of the study: expected `subject "
                                       "of least METRIC` or `subject of largest METRIC`",
                                       text));
      else
        report_unknown(place, "Measure of this study", metric, so_far_.metric_names(),
                       diagnostics_);
      return std::nullopt;
    }
    value.metric = static_cast<std::size_t>(index);
    if (words.take("of")) {
      const std::string name = words.next();
      const std::vector<std::string> known = so_far_.subject_names();
      const auto subject = std::ranges::find(known, name);
      if (subject == known.end()) {
        report_unknown(place, "Subject", name, known, diagnostics_);
        return std::nullopt;
      }
      value.subject = static_cast<int>(subject - known.begin());
    }
    for (bool more = words.take("at"); more;) {
      const std::string name = words.next();
      words.take("=");
      if (!is_place(name, words.until("and"), value.where)) return std::nullopt;
      more = words.take("and");
    }
    if (words.done()) return value;
    diagnostics_.error(
        place, fmt::format("`{}` in `{{{}}}` is not understood: expected [least, largest or "
                           "predicted] METRIC [of SUBJECT] [at SWEEP = VALUE]",
                           words.next(), text));
    return std::nullopt;
  }

  bool load_parts(std::vector<ClaimPart>& parts) {
    const std::string& text = *block_.text;
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
        diagnostics_.error(block_.text.position(),
                           "a brace in the text opens or closes no number; two stand for one");
        return false;
      }
      parts.push_back({std::exchange(plain, ""), {}, {}});
      auto number = load_number(text.substr(at + 1, end - at - 1));
      if (!number) return false;
      parts.push_back(std::move(*number));
      at = end;
    }
    parts.push_back({std::move(plain), {}, {}});
    return true;
  }

  /// The Truths that the block names, else those of the metrics that the text names; indices.
  std::vector<int> truths_of(const std::vector<ClaimPart>& parts) {
    std::vector<int> truths;
    if (block_.truth) {
      std::vector<std::string> known;
      for (const TruthPlan& truth : so_far_.truths) known.push_back(truth.name);
      const language::Field& named = *block_.truth.field;
      for (std::size_t i = 0; i < named.words.size(); ++i) {
        if (std::ranges::find(known, named.words[i]) == known.end())
          report_unknown(named.places[i], "Truth", named.words[i], known, diagnostics_);
        for (std::size_t truth = 0; truth < known.size(); ++truth)
          if (known[truth] == named.words[i]) truths.push_back(static_cast<int>(truth));
      }
      return truths;
    }
    for (std::size_t truth = 0; truth < so_far_.truths.size(); ++truth) {
      const bool about = std::ranges::any_of(parts, [&](const ClaimPart& part) {
        const std::size_t metric = so_far_.truths[truth].metric;
        return (part.value && part.value->metric == metric) ||
               (part.divisor && part.divisor->metric == metric);
      });
      if (about) truths.push_back(static_cast<int>(truth));
    }
    return truths;
  }

  const Object& object_;
  const ClaimBlock block_;
  const StudyParts& so_far_;
  Diagnostics& diagnostics_;
};

}  // namespace

void add_claim_class(language::Schema& schema) {
  language::ClassSchema claim = block_class(
      "Claim", "The sentence that answers the study's question, with numbers of its runs.",
      schemas(claim_fields()), {"Only"});
  claim.only_in = "Study";
  schema.add(std::move(claim));
}

std::optional<ClaimSpec> load_claim(const Object& block, const StudyParts& so_far,
                                    Diagnostics& diagnostics) {
  return ClaimLoader(block, so_far, diagnostics).load();
}

}  // namespace hookpoint::studies
