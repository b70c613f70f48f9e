#include "studies/blocks/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "language/names.h"
#include "language/values/budget.h"
#include "studies/blocks/block.h"
#include "studies/blocks/study_parts.h"
#include "studies/blocks/written_values.h"
#include "studies/results/selection.h"

namespace hookpoint::studies {

using language::Diagnostics;
using language::Field;
using language::Object;

namespace {

enum class Spacing { linear, logarithmic };

struct SweepBlock {
  const Field* values = nullptr;
  Placed<double> from, to, step;
  Placed<double> count;
  Placed<Spacing> scale = Spacing::linear;
  const Field* quick_values = nullptr;
};

const Fields<SweepBlock>& sweep_fields() {
  static const Fields<SweepBlock> fields{
      or_words(values_field("values", &SweepBlock::values,
                            "the values, in order: numbers, or words or strings")),
      number_field("from", "?", &SweepBlock::from, "first value"),
      number_field("to", "?", &SweepBlock::to, "last value"),
      number_field("step", "?", &SweepBlock::step, "distance between values"),
      not_negative(
          integer_field("count", &SweepBlock::count, "how many values from `from` to `to`")),
      choice_field("scale", {"linear", "log"}, &SweepBlock::scale, "how `count` values are spaced"),
      or_words(values_field("quick_values", &SweepBlock::quick_values,
                            "the values under --quick; default: first and last"))};
  return fields;
}

/// The Sweep of the ground, where the scene has no Param of this name.
constexpr const char* ground_sweep = "terrain";

std::vector<double> in_unit(const std::vector<double>& si, const WrittenUnit& unit) {
  std::vector<double> values;
  for (const double value : si) values.push_back(tidy(unit.from_si(value)));
  return values;
}

/// One Sweep block.
class SweepLoader {
 public:
  SweepLoader(const Object& object, const StudyParts& so_far, Diagnostics& diagnostics)
      : object_(object),
        block_(load_fields(object, sweep_fields())),
        so_far_(so_far),
        diagnostics_(diagnostics) {}

  std::optional<SweepPlan> load() {
    const auto role = find_role();
    if (!role) return std::nullopt;
    if (block_.values != nullptr && !block_.values->words.empty()) return load_words(*role);
    if (*role == SweepRole::parameter) return load_numbers();
    diagnostics_.error(object_.position,
                       fmt::format("a Sweep of `{}` needs `values`, words or strings: the "
                                   "scene has no Param of that name",
                                   object_.name));
    return std::nullopt;
  }

 private:
  /// Nothing, after an error, where a Sweep of this name sets nothing.
  std::optional<SweepRole> find_role() {
    std::vector<std::string> known = so_far_.parameters();
    if (std::ranges::find(known, object_.name) != known.end()) return SweepRole::parameter;
    if (object_.name == ground_sweep) return SweepRole::ground;
    for (const CompositionWord& word : composition_words) {
      if (object_.name == word.field) return SweepRole::world_field;
      known.emplace_back(word.field);
    }
    known.emplace_back(ground_sweep);
    report_unknown(object_.position, "Param of the scene", object_.name, known, diagnostics_);
    return std::nullopt;
  }

  /// Whether a Subject may have these words in the field of the World; else errors.
  bool may_say(const Field& words) {
    const auto subjects = object_.parent->children_of("Subject");
    const language::FieldSchema* field =
        subjects.empty() ? nullptr : subjects.front()->schema->find(object_.name);
    if (field == nullptr || field->choices.empty()) return true;
    bool good = true;
    for (std::size_t i = 0; i < words.words.size(); ++i) {
      if (std::ranges::find(field->choices, words.words[i]) != field->choices.end()) continue;
      report_unknown(words.places[i], object_.name, words.words[i], field->choices, diagnostics_);
      good = false;
    }
    return good;
  }

  std::optional<SweepPlan> load_words(SweepRole role) {
    const Field& field = *block_.values;
    if (role == SweepRole::world_field && !may_say(field)) return std::nullopt;
    const std::vector<std::string> texts = word_texts(field);
    SweepPlan all;
    all.column = {object_.name, "", {}, field.words};
    all.declared_words = field.words;
    std::vector<double> taken;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      taken.push_back(static_cast<double>(i));
      if (std::ranges::count(field.words, field.words[i]) > 1) {
        report_twice(field.places[i], field.words[i]);
        return std::nullopt;
      }
    }
    const Field* quick = block_.quick_values;
    if (so_far_.quick && quick != nullptr && quick->words.empty())
      diagnostics_.error(quick->position, "`quick_values` takes some of the words of `values`");
    if (so_far_.quick && quick != nullptr)
      taken = word_values(all, *quick, diagnostics_);
    else if (so_far_.quick && taken.size() > 2)
      taken = {taken.front(), taken.back()};
    SweepPlan sweep;
    sweep.column = {object_.name, "", {}, {}};
    sweep.role = role;
    for (const double value : taken) {
      const auto i = static_cast<std::size_t>(value);
      sweep.si.push_back(static_cast<double>(sweep.si.size()));
      sweep.column.words.push_back(field.words[i]);
      sweep.texts.push_back(texts[i]);
      sweep.places.push_back(field.places[i]);
      if (role == SweepRole::ground) sweep.grounds.push_back(so_far_.grounds[i]);
    }
    sweep.column.values = sweep.si;
    for (std::size_t i = 0; i < texts.size(); ++i) sweep.declared.push_back(static_cast<double>(i));
    sweep.declared_texts = texts;
    sweep.declared_words = field.words;
    return sweep;
  }

  SweepPlan load_numbers() {
    const Field* first = block_.values != nullptr ? block_.values : block_.from.field;
    const WrittenUnit unit = first == nullptr ? WrittenUnit{} : written_unit(*first);
    check_one_form();
    SweepPlan sweep;
    sweep.column = {object_.name, unit.text, values(unit), {}};
    for (const double value : sweep.column.values) {
      sweep.si.push_back(unit.to_si(value));
      sweep.texts.push_back(unit.with_unit(value));
      sweep.places.push_back(first == nullptr ? object_.position : first->position);
    }
    for (const double value : so_far_.quick ? declared_values(unit) : sweep.column.values) {
      sweep.declared.push_back(unit.to_si(value));
      sweep.declared_texts.push_back(unit.with_unit(value));
    }
    return sweep;
  }

  /// Reports a field that another form of the Sweep would leave unread.
  void check_one_form() {
    const auto unread = [&](const Field* field, const char* read) {
      if (field == nullptr) return;
      diagnostics_.error(field->position, fmt::format("the Sweep has {}: leave `{}` out", read,
                                                      field->schema->name));
    };
    if (block_.values != nullptr) {
      for (const Field* field :
           {block_.from.field, block_.to.field, block_.step.field, block_.count.field})
        unread(field, "`values`");
    } else if (block_.step) {
      unread(block_.count.field, "a `step`");
      if (*block_.scale == Spacing::logarithmic) unread(block_.scale.field, "a `step`");
    }
  }

  /// The values that run, in the unit.
  std::vector<double> values(const WrittenUnit& unit) {
    if (so_far_.quick && block_.quick_values != nullptr) {
      std::vector<double> quick = in_unit(block_.quick_values->numbers, unit);
      check_distinct(quick, unit, block_.quick_values->position);
      return quick;
    }
    const std::size_t errors = diagnostics_.error_count();
    std::vector<double> declared = declared_values(unit);
    if (declared.empty() && diagnostics_.error_count() == errors)
      diagnostics_.error(object_.position,
                         "a Sweep needs `values`, or `from`, `to` and a `step` > 0 (or a "
                         "`count`; on a log scale both ends > 0)");
    check_distinct(declared, unit,
                   block_.values != nullptr ? block_.values->position : object_.position);
    if (so_far_.quick && declared.size() > 2) return {declared.front(), declared.back()};
    return declared;
  }

  /// Reports the first value that occurs twice: its runs would count twice.
  void check_distinct(const std::vector<double>& values, const WrittenUnit& unit,
                      const language::Position& place) {
    std::vector<double> sorted(values);
    std::ranges::sort(sorted);
    const auto twice = std::ranges::adjacent_find(sorted, same_value);
    if (twice != sorted.end()) report_twice(place, unit.with_unit(*twice));
  }

  void report_twice(const language::Position& place, const std::string& value) {
    diagnostics_.error(place, fmt::format("`{}` stands there twice", value));
  }

  /// All values that the block gives, in the unit; empty where it lacks some.
  std::vector<double> declared_values(const WrittenUnit& unit) {
    if (block_.values != nullptr) return in_unit(block_.values->numbers, unit);
    if (!block_.from || !block_.to) return {};
    const double from = unit.from_si(*block_.from), to = unit.from_si(*block_.to);
    const bool logarithmic = *block_.scale == Spacing::logarithmic;
    if (block_.step && *block_.step > 0. && to >= from) {
      const double step = unit.from_si(*block_.step);
      if (!may_have_values(block_.step, stepped_count(from, to, step))) return {};
      return stepped(from, to, step);
    }
    if (!block_.count || (logarithmic && !(from > 0. && to > 0.))) return {};
    if (!may_have_values(block_.count, *block_.count)) return {};
    return spaced(from, to, static_cast<int>(*block_.count), logarithmic);
  }

  /// Whether a Sweep may have so many; if not, an error at the field that requires them.
  bool may_have_values(const Placed<double>& field, double count) {
    if (count <= static_cast<double>(most_runs)) return true;
    diagnostics_.error(
        field.position(),
        fmt::format("the Sweep requires {}", language::too_many(count, most_runs, "values")));
    return false;
  }

  const Object& object_;
  const SweepBlock block_;
  const StudyParts& so_far_;
  Diagnostics& diagnostics_;
};

}  // namespace

void add_sweep_class(language::Schema& schema) {
  schema.add(block_class("Sweep",
                         "A Param of the scene to vary, or engine, contact, integrator, settings "
                         "or terrain: `values`, or `from`, `to` and `step` (or `count`).",
                         schemas(sweep_fields())));
}

std::vector<SweptGround> load_grounds(const Object& block, const StudyParts& so_far,
                                      Diagnostics& diagnostics) {
  std::vector<SweptGround> grounds;
  const std::vector<std::string> parameters = so_far.parameters();
  const Field* values = load_fields(block, sweep_fields()).values;
  if (block.name != ground_sweep || values == nullptr ||
      std::ranges::find(parameters, block.name) != parameters.end())
    return grounds;
  for (std::size_t i = 0; i < values->words.size(); ++i) {
    SweptGround& ground = grounds.emplace_back();
    ground.file = so_far.library->find(values->words[i], so_far.file);
    if (ground.file.empty()) {
      diagnostics.error(
          values->places[i],
          fmt::format("no file \"{}\" beside the study or in configs/", values->words[i]));
      continue;
    }
    for (const auto& declared : so_far.library->parameters(ground.file, diagnostics))
      ground.parameters.push_back(declared.name);
  }
  return grounds;
}

std::optional<SweepPlan> load_sweep(const Object& block, const StudyParts& so_far,
                                    Diagnostics& diagnostics) {
  return SweepLoader(block, so_far, diagnostics).load();
}

std::vector<std::string> swept_words(const Object& block) {
  const Field* values = load_fields(block, sweep_fields()).values;
  return values == nullptr ? std::vector<std::string>() : values->words;
}

std::string SweepPlan::values_near(std::optional<double> value) const {
  constexpr std::size_t most = 10, nearest = 3;
  if (declared.size() <= most || !value || !declared_words.empty())
    return language::join(declared_texts, ", ");
  std::vector<std::size_t> order(declared.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {},
                           [&](std::size_t i) { return std::abs(declared[i] - *value); });
  order.resize(nearest);
  std::ranges::sort(order);
  std::vector<std::string> near_texts;
  for (const std::size_t i : order) near_texts.push_back(declared_texts[i]);
  return fmt::format("{} values, of which the nearest are {}", declared.size(),
                     language::join(near_texts, ", "));
}

bool SweepPlan::assigns(const std::string& parameter) const {
  return !settings.empty() && std::ranges::find(settings.front(), parameter,
                                                &Assignment::parameter) != settings.front().end();
}

std::vector<double> word_values(const SweepPlan& sweep, const Field& field,
                                Diagnostics& diagnostics) {
  std::vector<double> values;
  for (std::size_t i = 0; i < field.words.size(); ++i) {
    const std::string& word = field.words[i];
    if (std::ranges::find(sweep.declared_words, word) == sweep.declared_words.end())
      report_unknown(field.places[i], "value of the Sweep " + sweep.column.name, word,
                     sweep.declared_words, diagnostics);
    const auto found = std::ranges::find(sweep.column.words, word);
    if (found != sweep.column.words.end())
      values.push_back(static_cast<double>(found - sweep.column.words.begin()));
  }
  return values;
}

std::vector<double> number_values(const SweepPlan& sweep, const Field& field,
                                  Diagnostics& diagnostics) {
  const WrittenUnit unit = written_unit(field);
  for (const double value : field.numbers)
    if (std::ranges::none_of(sweep.declared, [&](double v) { return same_value(v, value); }))
      diagnostics.error(field.position,
                        no_such_value(sweep, unit.with_unit(tidy(unit.from_si(value))), value));
  return field.numbers;
}

std::string no_such_value(const SweepPlan& sweep, const std::string& text,
                          std::optional<double> value) {
  return fmt::format("`{}` is no value of the Sweep `{}`; it has {}", text, sweep.column.name,
                     sweep.values_near(value));
}

}  // namespace hookpoint::studies
