// What a file says of the data that a run leaves.
#include "output/records/recorder.h"
#include "simulation/scene/schema.h"
#include "simulation/scene/fields.h"

namespace hookpoint::simulation {

namespace {

language::ClassSchema record_class() {
  language::ClassSchema record;
  record.name = "Record";
  record.doc =
      "a data file of the run: a row of chosen ports at time 0 and at every step or sampling "
      "instant";
  record.top_level = true;
  record.naming = language::Naming::required;

  FieldSchema trails =
      make_field(FieldType::words, "trails",
                 "ports to record, a channel each; a vector is a channel a component");
  trails.max_count = 100'000;
  std::vector<std::string> formats;
  for (const output::RecordFormat& format : output::record_formats())
    formats.emplace_back(format.name);
  record.fields = {
      required(std::move(trails)),
      choice_field("format", formats, "csv", "of the file; docs/data.md tells how to read each"),
      positive(number_field("rate", "Hz", "", "rows a second; if not given, one each step")),
      text_field(
          "file",
          "name in the run's folder; if not given, the record's with the format's extension"),
  };
  return record;
}

language::ClassSchema movie_class() {
  language::ClassSchema movie;
  movie.name = "Movie";
  movie.doc =
      "a log of the run's whole state, from which any moment of it is seen again and a run goes on";
  movie.top_level = true;
  movie.naming = language::Naming::required;
  movie.fields = {
      positive(number_field("rate", "Hz", "",
                            "instants a second; if not given, one each step. What lies between "
                            "two is computed again, exactly")),
      text_field("file", "name in the run's folder; if not given, the movie's with .h5"),
  };
  return movie;
}

}  // namespace

void add_record_classes(language::Schema& schema) {
  schema.add(record_class());
  schema.add(movie_class());
}

}  // namespace hookpoint::simulation
