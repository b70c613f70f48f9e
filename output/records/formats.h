// One factory a format; each stands in a file of its own.
#pragma once

#include <filesystem>
#include <memory>

#include "output/records/recorder.h"

namespace hookpoint::output {

std::unique_ptr<RecordWriter> make_csv_record(const std::filesystem::path& path,
                                              const RecordHeader& header);
std::unique_ptr<RecordWriter> make_mat5_record(const std::filesystem::path& path,
                                               const RecordHeader& header);
std::unique_ptr<RecordWriter> make_mat73_record(const std::filesystem::path& path,
                                                const RecordHeader& header);
std::unique_ptr<RecordWriter> make_hdf5_record(const std::filesystem::path& path,
                                               const RecordHeader& header);
std::unique_ptr<RecordWriter> make_wl_record(const std::filesystem::path& path,
                                             const RecordHeader& header);
std::unique_ptr<RecordWriter> make_mcap_record(const std::filesystem::path& path,
                                               const RecordHeader& header);

}  // namespace hookpoint::output
