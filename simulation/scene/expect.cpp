// Expect: what a scene says that a run of it must show.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "contact/force_law.h"
#include "integrators/stepper.h"
#include "language/names.h"
#include "language/tree/fields.h"
#include "language/tree/references.h"
#include "language/units.h"
#include "simulation/run/expectation.h"
#include "simulation/scene/load.h"
#include "simulation/scene/load_parts.h"
#include "simulation/scene/schema.h"
#include "simulation/scene/unread_constants.h"

namespace hookpoint::simulation {

using language::choice_field;
using language::Fields;
using language::LoadedField;
using language::number_field;
using language::text_field;
using language::words_field;

namespace {

namespace expect_field {
constexpr const char *of = "of", *take = "take", *equals = "equals", *within = "within",
                     *scale = "scale", *level = "level", *band = "band", *to = "to", *laws = "laws",
                     *except_laws = "except_laws", *integrators = "integrators";
}

/// A field of the expectation's reduction.
LoadedField<ExpectationSpec> reduction_field(LoadedField<ReductionSpec> field) {
  LoadedField<ExpectationSpec> of_expectation(static_cast<language::FieldSchema>(field));
  of_expectation.store = [store = std::move(field.store)](const language::Field& given,
                                                          ExpectationSpec& spec) {
    store(given, spec.reduction);
  };
  return of_expectation;
}

const Fields<ExpectationSpec>& expect_fields() {
  using Spec = ExpectationSpec;
  using Take = ReductionSpec;
  static const Fields<Spec> fields{
      required(words_field(expect_field::of, 1, "the port")),
      reduction_field(
          choice_field(expect_field::take, reduction_names(), &Take::take,
                       "what becomes of its values: the last, the largest, ..., `slope` by least "
                       "squares, `time_at` when it first crosses `level`; the manual's page of "
                       "studies defines each")),
      required(number_field(expect_field::equals, "?", &Spec::expected,
                            "the closed form, of the scene's Params")),
      not_negative(number_field("tolerance", "", &Spec::tolerance,
                                "allowed difference relative to `equals`")),
      not_negative(without_default(
          number_field(expect_field::within, "?", &Spec::within, "allowed absolute difference"))),
      positive(number_field(expect_field::scale, "?", &Spec::scale,
                            "what a score card holds the difference against; default: the size "
                            "of `equals`")),
      reduction_field(
          number_field(expect_field::level, "?", &Take::level,
                       "of `time_at`, `count_above`, `time_above`; of `settle_time` what it "
                       "settles about, if not where it ends")),
      reduction_field(
          not_negative(number_field(expect_field::band, "?", &Take::band,
                                    "of `settle_time`: how far off counts as settled"))),
      reduction_field(
          not_negative(number_field("from", "s", &Take::from, "values before do not count"))),
      reduction_field(positive(number_field(expect_field::to, "s", &Take::to,
                                            "values after do not count; default: the run's end"))),
      words_field(expect_field::laws, 20, "contact laws that it holds for; default: all"),
      words_field(expect_field::except_laws, 20, "contact laws that it says nothing of"),
      words_field(expect_field::integrators, 20, "integrators that it holds for; default: all"),
      text_field("source", &Spec::source, "where the closed form comes from"),
  };
  return fields;
}

/// The text of a field's value as the file writes it, blanks joined.
std::string written(const language::Field& field) {
  if (field.position.file == nullptr) return "";
  std::string_view text = field.position.file->text;
  text = text.substr(std::min(field.position.offset, text.size()));
  text = text.substr(0, text.find_first_of(";}\n"));
  return std::string(text.substr(0, text.find_last_not_of(" \t\r") + 1));
}

class ExpectationLoader {
 public:
  ExpectationLoader(const language::Object& object, language::Names& names, Loading& loading)
      : object_(object), names_(names), loading_(loading) {}

  void run() {
    spec_.name = object_.name;
    store_fields(object_, expect_fields(), spec_);
    spec_.formula = written(*object_.find(expect_field::equals));
    check_times();
    spec_.laws = known_words(expect_field::laws, contact::law_names());
    spec_.except_laws = known_words(expect_field::except_laws, contact::law_names());
    spec_.integrators = known_words(expect_field::integrators, integrators::integrator_names());
    // Under another law the port may not exist.
    const Experiment& experiment = loading_.experiment;
    if (spec_.covers(experiment)) find_number_port();
    loading_.experiment.expectations.push_back(std::move(spec_));
  }

 private:
  void find_number_port() {
    const language::Field& of = *object_.find(expect_field::of);
    const auto port = find_number(object_, of.words[0], of.position, names_, loading_);
    if (!port) return;
    spec_.trail = port->trail;
    check_unit(port->target);
  }

  std::vector<std::string> known_words(const char* field, const std::vector<std::string>& known) {
    if (!object_.given(field)) return {};
    const language::Field& given = *object_.find(field);
    for (std::size_t i = 0; i < given.words.size(); ++i) {
      if (std::ranges::find(known, given.words[i]) == known.end())
        loading_.error(given.places[i],
                       fmt::format("there is no `{}` among the {}{}", given.words[i],
                                   field == expect_field::integrators ? "integrators" : "laws",
                                   language::did_you_mean(given.words[i], known)));
    }
    return given.words;
  }

  /// Of a scene as it stands; who shortens a run knows what it leaves out.
  void check_duration() {
    const language::Object* root = &object_;
    while (root->parent != nullptr) root = root->parent;
    const auto worlds = root->children_of("World");
    if (worlds.empty() || set_from_outside(*worlds[0], duration_field)) return;
    const double end = loading_.experiment.duration * (1. + 1e-9);
    const char* const late = spec_.reduction.from > end              ? "from"
                             : spec_.reduction.to.value_or(0.) > end ? expect_field::to
                                                                     : nullptr;
    if (late == nullptr) return;
    loading_.error(
        place_of(object_, late),
        fmt::format("`{}` lies beyond the run, which lasts {:g} s: give the World a longer "
                    "duration",
                    late, loading_.experiment.duration));
  }

  void check_times() {
    check_duration();
    if (spec_.reduction.to && *spec_.reduction.to <= spec_.reduction.from)
      loading_.error(place_of(object_, expect_field::to), "`to` must be later than `from`");
    if (const std::string missing = missing_of(spec_.reduction); !missing.empty())
      loading_.error(place_of(object_, expect_field::take), missing);
    if (spec_.tolerance == 0. && spec_.within == 0.)
      loading_.error(object_.position,
                     "no difference is allowed: give a `tolerance` (relative) or `within`");
  }

  /// `equals`, `within` and `scale` are in the unit of the reduction, level and band in the port's own.
  void check_unit(const language::Target& target) {
    const std::string& unit = target.object->unit_of(*target.field);
    const auto parsed = language::parse_unit(unit == "?" ? "" : unit);
    if (!parsed) return;
    const language::Dimension wanted = dimension_of(spec_.reduction.take, parsed->dimension);
    constexpr language::Dimension some{0, 1, 0, 0};
    const bool follows =
        dimension_of(spec_.reduction.take, some) != dimension_of(spec_.reduction.take, {});
    spec_.unit = unit == "?" && follows ? "" : language::unit_text(wanted);
    if (unit == "?") return;
    for (const char* field : {expect_field::equals, expect_field::within, expect_field::scale})
      check_dimension(field, wanted);
    for (const char* field : {expect_field::level, expect_field::band})
      check_dimension(field, parsed->dimension);
  }

  void check_dimension(const char* field, const language::Dimension& wanted) {
    if (!object_.given(field)) return;
    const language::Field& given = *object_.find(field);
    if (!language::fits(given.dimension, wanted))
      loading_.error(given.position, fmt::format("`{}` is to be in {}, not in {}", field,
                                                 language::describe_dimension(wanted),
                                                 language::describe_dimension(given.dimension)));
  }

  const language::Object& object_;
  language::Names& names_;
  Loading& loading_;
  ExpectationSpec spec_;
};

}  // namespace

void add_expect_class(language::Schema& schema) {
  language::ClassSchema expect;
  expect.name = "Expect";
  expect.doc =
      "a truth of the scene: what a port must come to, by a closed form; `run` prints it beside "
      "what came out, a Wall shows it for every law";
  expect.top_level = true;
  expect.naming = language::Naming::required;
  expect.fields = schemas(expect_fields());
  schema.add(std::move(expect));
}

void load_expectations(const language::Object& root, Loading& loading) {
  language::Names names;
  for (const language::Object* expectation : collect_all(root, "Expect"))
    ExpectationLoader(*expectation, names, loading).run();
}

const std::string& port_of_expect(const language::Object& expect) {
  return expect.word(expect_field::of);
}

}  // namespace hookpoint::simulation
