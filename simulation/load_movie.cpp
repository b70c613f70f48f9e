// Files that a run leaves: where they go and how often. Movies.
#include <fmt/format.h>

#include <algorithm>
#include <exception>

#include "control/transmission_line.h"
#include "simulation/load_parts.h"

namespace hookpoint::simulation {
namespace {

void load_movie(const language::Object& object, Loading& loading) {
  MovieSpec spec;
  spec.name = object.name;
  spec.file = object.given("file") ? object.word("file") : object.name + ".h5";
  if (object.given("rate")) {
    spec.rate = object.number("rate");
    if (std::string problem = rate_problem(*spec.rate, loading.experiment.deltat); !problem.empty())
      loading.error(place_of(object, "rate"), std::move(problem));
  }
  if (std::string problem = file_problem(spec.file, loading.experiment); !problem.empty())
    loading.error(place_of(object, "file"), std::move(problem));
  loading.experiment.movies.push_back(std::move(spec));
}

}  // namespace

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

std::string file_problem(const std::string& file, const Experiment& experiment) {
  if (file.empty() || file == "." || file == ".." || file.find('/') != std::string::npos)
    return fmt::format(
        "`{}` is no name of a file in the run's folder: leave out what names folders", file);
  const bool of_record =
      std::ranges::find(experiment.records, file, &RecordSpec::file) != experiment.records.end();
  const bool of_movie =
      std::ranges::find(experiment.movies, file, &MovieSpec::file) != experiment.movies.end();
  if (!of_record && !of_movie) return "";
  return fmt::format("another {} writes `{}`; give this one a `file`",
                     of_record ? "Record" : "Movie", file);
}

void load_movies(const language::Object& root, Loading& loading) {
  for (const language::Object* movie : collect_all(root, "Movie")) load_movie(*movie, loading);
}

}  // namespace hookpoint::simulation
