// Records: their trails resolved to ports, with what the classes say about them.
#include <fmt/format.h>

#include <algorithm>
#include <exception>

#include "control/core/transmission_line.h"
#include "language/tree/references.h"
#include "output/records/files.h"
#include "simulation/scene/load_parts.h"

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
    for (std::size_t i = 0; i < trails_.words.size(); ++i) add(trails_.words[i], trails_.places[i]);
    loading_.experiment.records.push_back(std::move(spec_));
  }

 private:
  void check_rate() const {
    if (!spec_.rate) return;
    complain("rate", rate_problem(*spec_.rate, loading_.experiment.deltat));
  }
  void check_file() const {
    complain("file",
             file_problem(output::record_files(spec_.format, spec_.file), loading_.experiment));
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

std::optional<NumberPort> find_number(const language::Object& from, const std::string& trail,
                                      const language::Position& place, language::Names& names,
                                      Loading& loading) {
  const auto fail = [&](const std::string& message) {
    loading.error(place, message);
    return std::nullopt;
  };
  language::Unresolved why;
  const auto target = names.resolve(from, trail, true, why);
  if (!target) return fail(fmt::format("`{}`: {}", trail, why.message));
  if (target->field == nullptr || !is_number(*target->field))
    return fail(fmt::format("`{}` is no number that could be recorded", trail));
  const auto object = loading.trails.find(target->object);
  if (object == loading.trails.end()) return fail(fmt::format("`{}` has no value in a run", trail));
  const std::string lacking = missing_port(loading.experiment, *target->object, *target->field);
  if (!lacking.empty()) return fail(lacking);
  return NumberPort{*target, object->second + "." + target->port};
}

void load_records(const language::Object& root, Loading& loading) {
  language::Names names;
  for (const language::Object* record : collect_all(root, "Record"))
    RecordLoader(*record, names, loading).run();
}

}  // namespace hookpoint::simulation
