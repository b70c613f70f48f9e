#include "output/records/hdf5_file.h"

namespace hookpoint::output {
namespace {

Hdf5Handle string_type(const std::string& text) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  require_hdf5(H5Tset_size(type, text.size() + 1));
  require_hdf5(H5Tset_cset(type, H5T_CSET_UTF8));
  return type;
}

}  // namespace

void check_hdf5(herr_t result, const std::filesystem::path& file) {
  if (result < 0) throw FileError("cannot write " + file.string());
}

void require_hdf5(herr_t result) {
  if (result < 0) throw FileError(Hdf5Handle::refusal);
}

void hdf5_annotate(hid_t object, const char* name, const std::string& text) {
  const Hdf5Handle type = string_type(text);
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT),
                             H5Aclose);
  require_hdf5(H5Awrite(attribute, type, text.c_str()));
}

void hdf5_annotate(hid_t object, const char* name, double value) {
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle attribute(
      H5Acreate2(object, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  require_hdf5(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value));
}

Hdf5Handle clockless_dataset() {
  Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  require_hdf5(H5Pset_obj_track_times(properties, false));
  return properties;
}

void hdf5_write_text(hid_t group, const char* name, const std::string& text) {
  const Hdf5Handle type = string_type(text);
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle dataset(
      H5Dcreate2(group, name, type, space, H5P_DEFAULT, clockless_dataset(), H5P_DEFAULT),
      H5Dclose);
  require_hdf5(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()));
}

Hdf5Handle create_hdf5(const std::filesystem::path& file) {
  require_hdf5(H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr));
  return {H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose};
}

void flush_hdf5(hid_t file, const std::filesystem::path& path) {
  check_hdf5(H5Fflush(file, H5F_SCOPE_LOCAL), path);
  // The library knows nothing of the room that was taken.
  hsize_t size = 0;
  check_hdf5(H5Fget_filesize(file, &size), path);
  std::filesystem::resize_file(path, size);
}

}  // namespace hookpoint::output
