#include "simulation/run/movies.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "output/files/file.h"
#include "simulation/engine_interface/identity.h"

namespace hookpoint::simulation {
namespace {

output::MovieFile file_of(const FileSpec& spec) {
  return {spec.name, spec.path, output::read_file(spec.path).value_or("")};
}

}  // namespace

std::string layout_text(const std::vector<StateSection>& sections) {
  std::string text;
  for (const StateSection& section : sections)
    text += fmt::format("{}\t{}\t{}\n", section.size, section.name, section.layout);
  return text;
}

Movies::Movies(const Experiment& experiment, const World& world,
               const std::filesystem::path& folder, const RunText& text, std::int64_t first_step)
    : world_(&world) {
  if (experiment.movies.empty()) return;
  output::MovieHeader header;
  header.experiment = text.text;
  header.annotations = run_annotations(experiment, text.hash);
  if (const auto plugins = plugins_of(experiment); !plugins.empty())
    header.annotations.emplace_back("plugins", fmt::format("{}", fmt::join(plugins, "\n")));
  for (const FileSpec& file : experiment.files) header.files.push_back(file_of(file));
  header.layout = layout_text(world.instant_layout());
  header.size = world.instant_size();
  state_.resize(header.size);
  left_.resize(header.size);
  const std::int64_t passed = std::max(world.state().step + 1, first_step);
  for (const MovieSpec& spec : experiment.movies) {
    Movie movie{row_schedule(spec.rate, experiment.deltat), nullptr};
    for (std::int64_t step = 0; step < passed; ++step) movie.schedule.due(step);
    header.name = spec.name;
    header.period = movie.schedule.period();
    movie.writer = output::make_movie_writer(folder / spec.file, header);
    movies_.push_back(std::move(movie));
  }
  world_->save_instant(state_);
  for (Movie& movie : movies_) write(movie);
}

void Movies::write(Movie& movie) {
  movie.writer->row(world_->state().time, state_);
  movie.last = world_->state().step;
}

void Movies::row(std::int64_t step) {
  if (changed_) write_left();
  bool saved = false;
  std::optional<output::FileError> refused;
  for (Movie& movie : movies_) {
    if (!movie.schedule.due(step)) continue;
    if (!saved) world_->save_instant(state_);
    saved = true;
    try {
      write(movie);
    } catch (const output::FileError& error) {
      if (!refused) refused = error;
    }
  }
  if (refused) throw *refused;
}

/// The present instant; `even_again` where a movie has it already.
void Movies::write_all(bool even_again) {
  if (!movies_.empty()) world_->save_instant(state_);
  for (Movie& movie : movies_) {
    if (even_again || movie.last != world_->state().step) write(movie);
  }
}

void Movies::before_change() {
  if (movies_.empty() || changed_) return;
  write_all(false);
  changed_ = true;
  changed_time_ = world_->state().time;
}

void Movies::write_left() {
  for (Movie& movie : movies_) movie.writer->row(changed_time_, left_);
  changed_ = false;
}

void Movies::close() {
  write_all(changed_);
  for (Movie& movie : movies_) movie.writer->close();
}

void Movies::close_within_step() {
  for (Movie& movie : movies_) movie.writer->close();
}

}  // namespace hookpoint::simulation
