// Record: a data file of the run. Its trails are resolved to ports, with what the classes say about
// them.
#include <fmt/format.h>

#include <algorithm>

#include "control/core/transmission_line.h"
#include "language/tree/fields.h"
#include "language/tree/references.h"
#include "output/records/files.h"
#include "output/records/recorder.h"
#include "simulation/scene/load_parts.h"
#include "simulation/scene/schema.h"

namespace hookpoint::simulation {

using language::boolean_field;
using language::choice_field;
using language::Fields;
using language::FieldSchema;
using language::FieldType;
using language::number_field;
using language::text_field;
using language::words_field;

namespace {

namespace record_field {
constexpr const char *trails = "trails", *scene = "scene";
}

std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const output::RecordFormat& format : output::record_formats())
    names.emplace_back(format.name);
  return names;
}

const Fields<RecordSpec>& record_fields() {
  static const Fields<RecordSpec> fields{
      required(words_field(record_field::trails, 100'000,
                           "ports to record, a channel each; a vector is a channel a component")),
      choice_field("format", format_names(), &RecordSpec::format,
                   "of the file; docs/data.md tells how to read each"),
      positive(number_field(run_file_field::rate, "Hz", &RecordSpec::rate,
                            "rows a second; if not given, one each step")),
      text_field(
          run_file_field::file, &RecordSpec::file,
          "name in the run's folder; if not given, the record's with the format's extension"),
      boolean_field(record_field::scene, &RecordSpec::scene,
                    "of mcap: every body's pose a row, its shapes and the ground once, as Foxglove "
                    "draws them"),
  };
  return fields;
}

std::string type_of(const FieldSchema& field) {
  if (field.type == FieldType::boolean) return "bool";
  return field.type == FieldType::integer ? "int" : "double";
}

class RecordLoader {
 public:
  RecordLoader(const language::Object& object, language::Names& names, Loading& loading)
      : object_(object),
        names_(names),
        loading_(loading),
        trails_(*object.find(record_field::trails)) {
    store_fields(object, record_fields(), spec_);
    spec_.name = object.name;
  }

  void run() {
    const output::RecordFormat* format = output::find_record_format(spec_.format);
    if (!object_.given(run_file_field::file))
      spec_.file = fmt::format("{}.{}", spec_.name, format->extension);
    check_rate();
    check_file();
    check_scene(*format);
    for (std::size_t i = 0; i < trails_.words.size(); ++i) add(trails_.words[i], trails_.places[i]);
    loading_.experiment.records.push_back(std::move(spec_));
  }

 private:
  void check_rate() const {
    if (!spec_.rate) return;
    complain(run_file_field::rate, rate_problem(*spec_.rate, loading_.experiment.deltat));
  }
  void check_file() const {
    complain(run_file_field::file,
             file_problem(output::record_files(spec_.format, spec_.file), loading_.experiment));
  }
  void check_scene(const output::RecordFormat& format) const {
    if (object_.given(record_field::scene) && spec_.scene && !format.shows_scene)
      complain(record_field::scene,
               fmt::format("format {} has no scene: leave this out, or record with format = mcap",
                           format.name));
  }
  void complain(const char* field, std::string problem) const {
    if (!problem.empty()) loading_.error(place_of(object_, field), std::move(problem));
  }

  void add(const std::string& trail, const language::Position& place) {
    const auto found = find_number(object_, trail, place, names_, loading_);
    if (!found) return;
    const language::Target& target = found->target;
    const int components = target.part < 0 ? components_of(*target.field) : 1;
    for (int i = 0; i < components; ++i)
      add_channel(found->trail + (components > 1 ? language::part_name(*target.field, i) : ""),
                  target, place);
  }

  void add_channel(std::string path, const language::Target& target,
                   const language::Position& place) {
    const FieldSchema& field = *target.field;
    if (std::ranges::find(spec_.channels, path, &output::Channel::path) != spec_.channels.end())
      return loading_.error(place, fmt::format("`{}` is recorded twice", path));
    // A unit that the class leaves open is the port's in the run.
    spec_.channels.push_back({std::move(path),
                              field.unit == "?" ? "" : target.object->unit_of(field),
                              type_of(field), field.minimum, field.maximum, field.doc});
  }

  const language::Object& object_;
  language::Names& names_;
  Loading& loading_;
  const language::Field& trails_;
  RecordSpec spec_;
};

}  // namespace

void add_record_class(language::Schema& schema) {
  language::ClassSchema record;
  record.name = "Record";
  record.doc =
      "a data file of the run: a row of chosen ports at time 0 and at every step or sampling "
      "instant";
  record.top_level = true;
  record.naming = language::Naming::required;
  record.fields = schemas(record_fields());
  schema.add(std::move(record));
}

std::optional<NumberPort> find_number(const language::Object& from, const std::string& trail,
                                      const language::Position& place, language::Names& names,
                                      Loading& loading) {
  return find_number(from, trail, place, names, loading.trails, loading.experiment,
                     loading.diagnostics);
}

void load_records(const language::Object& root, Loading& loading) {
  language::Names names;
  for (const language::Object* record : collect_all(root, "Record"))
    RecordLoader(*record, names, loading).run();
}

}  // namespace hookpoint::simulation
