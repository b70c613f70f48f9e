#include <algorithm>
#include <cmath>

#include "output/movies/format.h"
#include "output/movies/movie.h"
#include "output/records/hdf5_file.h"
#include "text/number.h"

namespace hookpoint::output {
namespace {

/// What is read as one value must be one: the library would write all of them.
void require_one(const Hdf5Handle& space, const char* name) {
  if (H5Sget_simple_extent_npoints(space) != 1) throw FileError(name);
}

double read_number(hid_t object, const char* name) {
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  require_one({H5Aget_space(attribute), H5Sclose}, name);
  double value = 0.;
  if (H5Aread(attribute, H5T_NATIVE_DOUBLE, &value) < 0) throw FileError(name);
  return value;
}

std::string cut_at_zero(const std::string& text) { return text.substr(0, text.find('\0')); }

/// Texts are written in the file itself, not on its heap: they are no longer than what is `stored`.
std::string room_for(hid_t type, hsize_t stored) {
  const bool text = H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0;
  if (!text || H5Tget_size(type) > stored) throw FileError("text");
  return std::string(H5Tget_size(type), '\0');
}

std::string read_attribute(hid_t object, const char* name) {
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  require_one({H5Aget_space(attribute), H5Sclose}, name);
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose);
  std::string text = room_for(type, H5Aget_storage_size(attribute));
  if (H5Aread(attribute, type, text.data()) < 0) throw FileError(name);
  return cut_at_zero(text);
}

std::string read_text(hid_t group, const char* name) {
  const Hdf5Handle dataset(H5Dopen2(group, name, H5P_DEFAULT), H5Dclose);
  require_one({H5Dget_space(dataset), H5Sclose}, name);
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose);
  std::string text = room_for(type, H5Dget_storage_size(dataset));
  if (H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0) throw FileError(name);
  return cut_at_zero(text);
}

/// The dataset's extent, of `rank` numbers. Throws FileError for another rank, and for more than
/// what is stored could hold: the library would give the rest as zeros, out of memory.
std::vector<hsize_t> extent_of(hid_t dataset, int rank) {
  constexpr double most_compressed = 1032.;  // deflate's limit
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  if (H5Sget_simple_extent_ndims(space) != rank) throw FileError("extent");
  std::vector<hsize_t> extent(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space, extent.data(), nullptr);
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose);
  auto bytes = static_cast<double>(H5Tget_size(type));
  for (const hsize_t side : extent) bytes *= static_cast<double>(side);
  if (bytes > most_compressed * static_cast<double>(H5Dget_storage_size(dataset)))
    throw FileError("extent");
  return extent;
}

/// Whether these can be the times of a run; a comparison with a NaN is false.
bool ascend_from_zero(const std::vector<double>& times) {
  double before = 0.;
  for (const double time : times) {
    if (!(time >= before && std::isfinite(time))) return false;
    before = time;
  }
  return true;
}

std::vector<std::string> names_in(hid_t group) {
  H5G_info_t info{};
  if (H5Gget_info(group, &info) < 0) throw FileError("names");
  std::vector<std::string> names;
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    char name[256] = {};
    if (H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, i, name, sizeof name,
                           H5P_DEFAULT) < 0)
      throw FileError("names");
    names.emplace_back(name);
  }
  return names;
}

MovieFile read_file(hid_t group, const char* name) {
  const Hdf5Handle dataset(H5Dopen2(group, name, H5P_DEFAULT), H5Dclose);
  MovieFile file{read_attribute(dataset, "name"), read_attribute(dataset, "path"), {}};
  file.content.resize(extent_of(dataset, 1)[0]);
  if (!file.content.empty() &&
      H5Dread(dataset, H5T_NATIVE_UCHAR, H5S_ALL, H5S_ALL, H5P_DEFAULT, file.content.data()) < 0)
    throw FileError(name);
  return file;
}

/// Who goes through a movie reads the chunks of a block again and again: those of two blocks stay
/// in memory, one for what is shown and one for what is plotted.
Hdf5Handle open_state(hid_t file) {
  constexpr double most_bytes = 128e6, most_slots = 1e6, first_read_first_dropped = 1.;
  Hdf5Handle state(H5Dopen2(file, "state", H5P_DEFAULT), H5Dclose);
  const auto numbers = static_cast<double>(extent_of(state, 2)[0]);
  hsize_t chunk[2];
  {
    const Hdf5Handle made(H5Dget_create_plist(state), H5Pclose);
    if (H5Pget_layout(made) != H5D_CHUNKED || H5Pget_chunk(made, 2, chunk) != 2) return state;
  }
  const double instants = 2. * static_cast<double>(chunk[1]);
  const double chunks = 2. * (numbers / static_cast<double>(chunk[0]) + 1.);
  const double bytes = (numbers + static_cast<double>(chunk[0])) * instants * sizeof(double);
  const Hdf5Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  H5Pset_chunk_cache(access, static_cast<std::size_t>(std::min(most_slots, 10. * chunks)),
                     static_cast<std::size_t>(std::min(most_bytes, bytes)),
                     first_read_first_dropped);
  state.reset();  // an open dataset keeps the room that it was opened with
  return {H5Dopen2(file, "state", access), H5Dclose};
}

}  // namespace

struct MovieReader::Handles {
  Hdf5Handle file, state;
};

MovieReader::MovieReader(const std::filesystem::path& path)
    : path_(path), handles_(std::make_unique<Handles>()) {
  const std::string name = path.string();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored))
    throw MovieError("there is no file " + name);
  if (H5Fis_hdf5(name.c_str()) <= 0)
    throw MovieError(
        name + " is no movie: a movie is an HDF5 file that `hookpoint run FILE --movie` wrote");
  try {
    handles_->file = {H5Fopen(name.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose};
  } catch (const FileError&) {
    throw MovieError(name + " is cut short or damaged: HDF5 cannot open it");
  }
  const hid_t file = handles_->file;
  if (H5Aexists(file, movie_mark) <= 0)
    throw MovieError(name +
                     " is an HDF5 file, but no movie: `hookpoint run FILE --movie` writes one");
  try {
    if (const double version = read_number(file, movie_mark); version != movie_version)
      throw MovieError(name + " is a movie of layout " + text::rounded(version) +
                       "; this program reads layout " + text::rounded(movie_version) +
                       ": use the hookpoint that wrote it");
    read_header();
  } catch (const FileError&) {
    throw MovieError(name + " is damaged: not all of it can be read");
  }
}

MovieReader::~MovieReader() = default;

void MovieReader::read_header() {
  const hid_t file = handles_->file;
  header_.name = read_attribute(file, "name");
  header_.period = read_number(file, "period");
  complete_ = read_number(file, "complete") != 0.;
  header_.experiment = read_text(file, "experiment");
  header_.layout = read_text(file, "layout");
  const Hdf5Handle notes(H5Gopen2(file, "annotations", H5P_DEFAULT), H5Gclose);
  for (const std::string& key : names_in(notes))
    header_.annotations.emplace_back(key, read_text(notes, key.c_str()));
  const Hdf5Handle files(H5Gopen2(file, "files", H5P_DEFAULT), H5Gclose);
  for (const std::string& key : names_in(files))
    header_.files.push_back(read_file(files, key.c_str()));
  handles_->state = open_state(file);
  const std::vector<hsize_t> extent = extent_of(handles_->state, 2);
  const Hdf5Handle time(H5Dopen2(file, "time", H5P_DEFAULT), H5Dclose);
  times_.resize(extent_of(time, 1)[0]);
  if (extent[1] != times_.size() ||
      (!times_.empty() &&
       H5Dread(time, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, times_.data()) < 0) ||
      !ascend_from_zero(times_) || !(header_.period > 0. && std::isfinite(header_.period)))
    throw FileError("time");
  header_.size = extent[0];
}

void MovieReader::read(std::size_t i, std::span<double> state) const {
  const hsize_t size = state.size(), first[2] = {0, i}, count[2] = {size, 1};
  const Hdf5Handle memory(H5Screate_simple(1, &size, nullptr), H5Sclose);
  const Hdf5Handle source(H5Dget_space(handles_->state), H5Sclose);
  H5Sselect_hyperslab(source, H5S_SELECT_SET, first, nullptr, count, nullptr);
  if (H5Dread(handles_->state, H5T_NATIVE_DOUBLE, memory, source, H5P_DEFAULT, state.data()) < 0)
    throw MovieError(path_.string() + " is damaged: its instant " + std::to_string(i) +
                     " cannot be read");
}

}  // namespace hookpoint::output
