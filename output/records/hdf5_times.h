// Takes the clock out of an HDF5 file that a library wrote.
#pragma once

#include <filesystem>

namespace hookpoint::output {

/// Sets the modification time of every object in `file` to 0, so that the same rows give the same
/// bytes: libmatio has no option to leave them out. A time is known by its message's header (HDF5
/// file format 3, IV.A.2.s: type 0x12, 8 bytes, version 1) and by lying between the file's making
/// and now. Throws FileError.
void clear_object_times(const std::filesystem::path& file);

}  // namespace hookpoint::output
