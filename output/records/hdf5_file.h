// What the writers and readers of HDF5 files share: identifiers that close themselves, texts and
// numbers as attributes and datasets.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "output/files/file.h"

namespace hookpoint::output {

/// Of deflate, 1 to 9: higher costs much time and gains little.
inline constexpr int deflate_level = 1;

/// An identifier of the library, closed by `close`. Throws FileError for one that was refused.
class Hdf5Handle {
 public:
  Hdf5Handle() = default;
  Hdf5Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {
    if (id_ < 0) throw FileError(refusal);
  }
  Hdf5Handle(Hdf5Handle&& other) noexcept
      : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Hdf5Handle() { reset(); }
  /// Whether closing went well.
  bool reset() { return id_ < 0 || close_(std::exchange(id_, -1)) >= 0; }
  operator hid_t() const {
    return id_;
  }  // NOLINT(google-explicit-constructor): passed to the library

  static constexpr const char* refusal = "the HDF5 library refused a call";

 private:
  hid_t id_ = -1;
  herr_t (*close_)(hid_t) = nullptr;
};

/// Throws FileError "cannot write FILE" for a call that failed.
void check_hdf5(herr_t result, const std::filesystem::path& file);
/// The same for a call that knows no file.
void require_hdf5(herr_t result);

void hdf5_annotate(hid_t object, const char* name, const std::string& text);
void hdf5_annotate(hid_t object, const char* name, double value);

/// Properties of a dataset to be made without the time at which it was: the same run gives the same
/// bytes.
Hdf5Handle clockless_dataset();

/// A text that may be longer than the 64 KB of an attribute.
void hdf5_write_text(hid_t group, const char* name, const std::string& text);

/// A new file. Failures come back as results and end as a FileError: the library's own report on
/// stderr is off from then on.
Hdf5Handle create_hdf5(const std::filesystem::path& file);

/// All that was written, to the operating system; the room that was reserved and not used is given
/// back.
void flush_hdf5(hid_t file, const std::filesystem::path& path);

}  // namespace hookpoint::output
