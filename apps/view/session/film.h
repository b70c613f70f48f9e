// A film: a movie seen by one camera, picture by picture, drawn by a page that nobody looks at.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "text/json.h"

namespace hookpoint::view {

enum class FilmFormat { png, webm, mp4, webp };

struct Film {
  std::string camera;  ///< trail
  int width = 1280, height = 720;
  double rate = 30.;  ///< pictures a second
  FilmFormat format = FilmFormat::png;
  std::string quality = "high";             ///< of the pictures: low, medium, high
  std::optional<std::string> caption = "";  ///< before the time in each of them; none: neither
  std::filesystem::path file;       ///< of pictures: `%05d` in its name stands for their number
  std::vector<std::int64_t> steps;  ///< of the pictures
};

/// Why the requested film cannot be made, or could not be; a whole sentence for the user.
struct FilmError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The browser that was to draw is gone, or cannot; a whole sentence too.
struct DrawingError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// By the file's name. Throws FilmError for one that is neither FILE.webm, FILE.mp4, FILE.webp nor
/// DIR/%05d.png.
FilmFormat film_format(const std::filesystem::path& file);
/// Where picture `index` goes: "%05d" in the name replaced.
std::filesystem::path picture_file(const Film& film, std::size_t index);
/// The step nearest to each of `from` + i / rate [s], up to `to`.
std::vector<std::int64_t> film_steps(double from, double to, double rate, double deltat);

/// The "film" of a description (docs/view_protocol.md).
void write_film(const Film& film, text::JsonWriter& json);

/// A file that comes in pieces, which may also be written over. Until `complete` it stands beside
/// its place, and goes away if it is given up. Throws output::FileError.
class FilmFile {
 public:
  explicit FilmFile(std::filesystem::path path);
  ~FilmFile();
  FilmFile(const FilmFile&) = delete;
  FilmFile& operator=(const FilmFile&) = delete;
  void write_at(std::uint64_t offset, const std::string& bytes);
  void complete();

 private:
  std::filesystem::path path_, partial_;
  int descriptor_ = -1;
};

}  // namespace hookpoint::view
