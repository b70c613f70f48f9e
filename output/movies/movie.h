// Movies: everything that evolves in a run, instant by instant and to the last bit, in an HDF5 file
// with the experiment inside. docs/movies.md has the layout.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "output/records/recorder.h"

namespace hookpoint::output {

/// A file that the experiment reads, whole.
struct MovieFile {
  std::string name;  ///< as the experiment writes it
  std::string path;  ///< where it was, absolute
  std::string content;
};

struct MovieHeader {
  std::string name;
  double period = 0.;                                            ///< between instants [s]
  std::string experiment;                                        ///< its text
  std::vector<std::pair<std::string, std::string>> annotations;  ///< versions, engine, seed, ...
  std::vector<MovieFile> files;
  std::size_t size = 0;  ///< numbers of an instant
  std::string layout;    ///< what they are: a line `size<TAB>owner<TAB>contents` a stretch
};

/// The writer of a movie: a row is an instant, its values the state. As the HDF5 record it is named
/// `<path>.partial` until `close`, is written in blocks of 512 instants, and is readable up to the
/// last block however the run ends. Throws FileError.
std::unique_ptr<RecordWriter> make_movie_writer(const std::filesystem::path& path,
                                                const MovieHeader& header);

/// The file is no movie, or none that can be read; the message is a whole sentence for the user.
struct MovieError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class MovieReader {
 public:
  /// Throws MovieError.
  explicit MovieReader(const std::filesystem::path& path);
  ~MovieReader();
  MovieReader(const MovieReader&) = delete;
  MovieReader& operator=(const MovieReader&) = delete;

  const MovieHeader& header() const { return header_; }
  /// Of the instants, increasing [s].
  const std::vector<double>& times() const { return times_; }
  /// Whether the run that wrote it came to an end of its own.
  bool complete() const { return complete_; }
  /// The state at instant `i`; `state`: header().size numbers. Throws MovieError.
  void read(std::size_t i, std::span<double> state) const;

 private:
  struct Handles;
  void read_header();

  std::filesystem::path path_;
  std::unique_ptr<Handles> handles_;
  MovieHeader header_;
  std::vector<double> times_;
  bool complete_ = false;
};

}  // namespace hookpoint::output
