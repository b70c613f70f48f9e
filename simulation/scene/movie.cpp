// Movie: a log of the run's whole state. What all files that a run leaves have: a place and a rate.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <set>

#include "control/core/transmission_line.h"
#include "language/tree/fields.h"
#include "output/files/result_folder.h"
#include "output/records/files.h"
#include "simulation/run/run_files.h"
#include "simulation/scene/load_parts.h"
#include "simulation/scene/schema.h"

namespace hookpoint::simulation {

using language::Fields;
using language::number_field;
using language::text_field;

namespace {

const Fields<MovieSpec>& movie_fields() {
  static const Fields<MovieSpec> fields{
      positive(number_field(run_file_field::rate, "Hz", &MovieSpec::rate,
                            "instants a second; if not given, one each step. What lies between "
                            "two is computed again, exactly")),
      text_field(run_file_field::file, &MovieSpec::file,
                 "name in the run's folder; if not given, the movie's with .h5"),
  };
  return fields;
}

void load_movie(const language::Object& object, Loading& loading) {
  MovieSpec spec = load_fields(object, movie_fields());
  spec.name = object.name;
  if (!object.given(run_file_field::file)) spec.file = object.name + ".h5";
  if (spec.rate) {
    if (std::string problem = rate_problem(*spec.rate, loading.experiment.deltat); !problem.empty())
      loading.error(place_of(object, run_file_field::rate), std::move(problem));
  }
  if (std::string problem = file_problem({spec.file}, loading.experiment); !problem.empty())
    loading.error(place_of(object, run_file_field::file), std::move(problem));
  loading.experiment.movies.push_back(std::move(spec));
}

/// With the names that the files have before they are complete.
std::set<std::string> all_stages(const std::vector<std::string>& files) {
  std::set<std::string> names;
  for (const std::string& file : files)
    for (std::string& stage : output::stages_of(file)) names.insert(std::move(stage));
  return names;
}

}  // namespace

void add_movie_class(language::Schema& schema) {
  language::ClassSchema movie;
  movie.name = "Movie";
  movie.doc =
      "a log of the run's whole state, from which any moment of it is seen again and a run continues";
  movie.top_level = true;
  movie.naming = language::Naming::required;
  movie.fields = schemas(movie_fields());
  schema.add(std::move(movie));
}

std::string rate_problem(double rate, double deltat) {
  try {
    const auto exact_rate = control::Rational::from(rate), step = control::Rational::from(deltat);
    const control::Schedule schedule(exact_rate, step);
    if (exact_rate * step > control::Rational(1))
      return fmt::format(
          "{:g} rows a second are more than one each step of {:g} s: leave `rate` out "
          "for a row each step",
          rate, deltat);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

std::string file_problem(const std::vector<std::string>& files, const Experiment& experiment) {
  const std::string& file = files.front();
  if (file.empty() || file == "." || file == ".." || file.find('/') != std::string::npos ||
      std::ranges::any_of(file, [](unsigned char c) { return c < 32 || c == 127; }))
    return fmt::format(
        "`{}` is no name of a file in the run's folder: leave out what names folders", file);
  const std::set<std::string> wanted = all_stages(files);
  const auto clash = [&wanted](const std::vector<std::string>& others) {
    const std::set<std::string> taken = all_stages(others);
    return std::ranges::any_of(wanted, [&](const auto& name) { return taken.contains(name); });
  };
  if (clash(run_files()))
    return fmt::format("the run itself writes `{}`; give this one another `file`", file);
  for (const RecordSpec& record : experiment.records)
    if (clash(output::record_files(record.format, record.file)))
      return fmt::format("another Record writes `{}`; give this one a `file`", file);
  for (const MovieSpec& movie : experiment.movies)
    if (clash({movie.file}))
      return fmt::format("another Movie writes `{}`; give this one a `file`", file);
  return "";
}

void load_movies(const language::Object& root, Loading& loading) {
  for (const language::Object* movie : collect_all(root, "Movie")) load_movie(*movie, loading);
}

}  // namespace hookpoint::simulation
