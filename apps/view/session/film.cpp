#include "apps/view/session/film.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <optional>
#include <utility>

#include "output/files/file.h"
#include "simulation/engine_interface/step_count.h"

namespace hookpoint::view {
namespace {

/// "%d" or "%05d" in a file's name.
struct Place {
  std::size_t begin, length;
  int digits;
};

std::optional<Place> number_in(const std::string& name) {
  const std::size_t begin = name.find('%');
  if (begin == std::string::npos) return std::nullopt;
  std::size_t at = begin + 1;
  int digits = 0;
  if (at < name.size() && name[at] == '0') {
    ++at;
    if (at == name.size() || name[at] < '1' || name[at] > '9') return std::nullopt;
    digits = name[at++] - '0';
  }
  if (at == name.size() || name[at] != 'd' || name.find('%', at) != std::string::npos)
    return std::nullopt;
  return Place{begin, at + 1 - begin, digits};
}

const char* name_of(FilmFormat format) {
  switch (format) {
    case FilmFormat::png:
      return "png";
    case FilmFormat::webm:
      return "webm";
    case FilmFormat::mp4:
      return "mp4";
    case FilmFormat::webp:
      return "webp";
  }
  return "";
}

}  // namespace

FilmFormat film_format(const std::filesystem::path& file) {
  const std::string end = file.extension();
  const bool numbered = number_in(file.filename()).has_value();
  if (end == ".webm") return FilmFormat::webm;
  if (end == ".mp4") return FilmFormat::mp4;
  if (end == ".webp") return FilmFormat::webp;
  if (end == ".png" && numbered) return FilmFormat::png;
  throw FilmError(fmt::format(
      "--film takes FILE.webm, FILE.mp4, FILE.webp, or DIR/%05d.png for pictures with their "
      "number in the name; not `{}`",
      file.string()));
}

std::filesystem::path picture_file(const Film& film, std::size_t index) {
  std::string name = film.file.filename();
  const auto place = number_in(name);
  if (!place) return film.file;
  name.replace(place->begin, place->length, fmt::format("{:0{}}", index, place->digits));
  return film.file.parent_path() / name;
}

std::vector<std::int64_t> film_steps(double from, double to, double rate, double deltat) {
  constexpr double tolerance = 1e-9;  // of a picture: what rounding leaves of a decimal number
  std::vector<std::int64_t> steps;
  const double last = std::floor((to - from) * rate + tolerance);
  for (double i = 0.; i <= last; ++i)
    steps.push_back(simulation::step_count(from + i / rate, deltat));
  return steps;
}

void write_film(const Film& film, text::JsonWriter& json) {
  json.begin_object().member("camera", film.camera).member("width", film.width);
  json.member("height", film.height).member("rate", film.rate);
  json.member("frames", static_cast<std::int64_t>(film.steps.size()));
  json.member("format", name_of(film.format)).member("quality", film.quality);
  json.key("caption");
  if (film.caption)
    json.value(*film.caption);
  else
    json.null();
  json.end_object();
}

FilmFile::FilmFile(std::filesystem::path path)
    : path_(std::move(path)), partial_(output::partial_name(path_)) {
  output::make_folder_of(partial_);
  descriptor_ = ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) output::fail_file("write", partial_);
}

FilmFile::~FilmFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  ::unlink(partial_.c_str());
}

void FilmFile::write_at(std::uint64_t offset, const std::string& bytes) {
  std::size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t count = ::pwrite(descriptor_, bytes.data() + written, bytes.size() - written,
                                   static_cast<off_t>(offset + written));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) output::fail_file("write", partial_);
    written += static_cast<std::size_t>(count);
  }
}

void FilmFile::complete() {
  output::rename_file(partial_, path_);
  ::close(std::exchange(descriptor_, -1));
}

}  // namespace hookpoint::view
