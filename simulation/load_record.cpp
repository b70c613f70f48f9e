// Records: their trails resolved to ports, with what the classes say about them.
#include <fmt/format.h>

#include <algorithm>
#include <exception>

#include "control/transmission_line.h"
#include "language/references.h"
#include "simulation/load_parts.h"

namespace hookpoint::simulation {
namespace {

using language::FieldSchema;
using language::FieldType;

bool is_number(const FieldSchema& field) {
  return field.type != FieldType::text && field.type != FieldType::choice &&
         field.type != FieldType::object && field.type != FieldType::port &&
         field.type != FieldType::words;
}

std::string type_of(const FieldSchema& field) {
  if (field.type == FieldType::boolean) return "bool";
  return field.type == FieldType::integer ? "int" : "double";
}

int components_of(const FieldSchema& field) {
  if (field.type == FieldType::orientation) return 4;
  return field.type == FieldType::numbers ? field.max_count : 1;
}

class RecordLoader {
 public:
  RecordLoader(const language::Object& object, language::Names& names, Loading& loading)
      : object_(object), names_(names), loading_(loading), trails_(*object.find("trails")) {
    spec_.name = object.name;
  }

  void run() {
    spec_.format = object_.word("format");
    const output::RecordFormat* format = output::find_record_format(spec_.format);
    spec_.file = object_.given("file") ? object_.word("file")
                                       : fmt::format("{}.{}", spec_.name, format->extension);
    if (object_.given("rate")) spec_.rate = object_.number("rate");
    check_rate();
    check_file();
    for (const std::string& trail : trails_.words) add(trail);
    loading_.experiment.records.push_back(std::move(spec_));
  }

 private:
  void check_rate() const {
    if (!spec_.rate) return;
    try {
      const control::Schedule schedule(control::Rational::from(*spec_.rate),
                                       control::Rational::from(loading_.experiment.deltat));
    } catch (const std::exception& error) {
      loading_.error(place_of(object_, "rate"), error.what());
    }
  }

  void check_file() const {
    const auto& records = loading_.experiment.records;
    if (std::ranges::find(records, spec_.file, &RecordSpec::file) != records.end())
      loading_.error(place_of(object_, "file"),
                     fmt::format("another Record writes `{}`; give this one a `file`", spec_.file));
  }

  void add(const std::string& trail) {
    language::Unresolved why;
    const auto target = names_.resolve(object_, trail, true, why);
    if (!target) return loading_.error(trails_.position, fmt::format("`{}`: {}", trail, why.message));
    if (target->field == nullptr || !is_number(*target->field))
      return loading_.error(trails_.position,
                            fmt::format("`{}` is no number that could be recorded", trail));
    const auto object = loading_.trails.find(target->object);
    if (object == loading_.trails.end())
      return loading_.error(trails_.position, fmt::format("`{}` has no value in a run", trail));
    const std::string whole = object->second + "." + target->port;
    const int components = target->part < 0 ? components_of(*target->field) : 1;
    for (int i = 0; i < components; ++i)
      add_channel(whole + (components > 1 ? language::part_name(*target->field, i) : ""),
                  *target->field);
  }

  void add_channel(std::string path, const FieldSchema& field) {
    if (std::ranges::find(spec_.channels, path, &output::Channel::path) != spec_.channels.end())
      return loading_.error(trails_.position, fmt::format("`{}` is recorded twice", path));
    // A unit that the class leaves open is the port's in the run.
    spec_.channels.push_back({std::move(path), field.unit == "?" ? "" : field.unit, type_of(field),
                              field.minimum, field.maximum, field.doc});
  }

  const language::Object& object_;
  language::Names& names_;
  Loading& loading_;
  const language::Field& trails_;
  RecordSpec spec_;
};

}  // namespace

void load_records(const language::Object& root, Loading& loading) {
  language::Names names;
  for (const language::Object* record : collect_all(root, "Record"))
    RecordLoader(*record, names, loading).run();
}

}  // namespace hookpoint::simulation
