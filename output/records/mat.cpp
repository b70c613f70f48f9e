// MATLAB files by libmatio: `time`, `record` and a struct a channel. A .mat cannot be appended to
// readably, so the rows go to a spool, from which `close` or `recover_spool` writes the file.
#include <matio.h>

#include <algorithm>
#include <array>
#include <memory>
#include <new>

#include "output/records/formats.h"
#include "output/records/hdf5_times.h"
#include "output/records/matlab_names.h"
#include "output/records/spool.h"
#include "text/utf8.h"

namespace hookpoint::output {
namespace {

struct CloseMat {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
using MatFile = std::unique_ptr<mat_t, CloseMat>;
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

struct Field {
  std::string name;
  Variable value;
};

/// libmatio hands out null where it finds no memory.
Variable require_made(matvar_t* variable) {
  if (variable == nullptr) throw std::bad_alloc();
  return Variable(variable);
}

/// libmatio copies the data and leaves them alone, whatever its signature says.
Variable array(const char* name, matio_classes kind, matio_types type,
               std::array<std::size_t, 2> dimensions, const void* data) {
  return require_made(
      Mat_VarCreate(name, kind, type, 2, dimensions.data(), const_cast<void*>(data), 0));
}

Variable numbers(const char* name, const std::vector<double>& values) {
  return array(name, MAT_C_DOUBLE, MAT_T_DOUBLE, {values.size(), 1}, values.data());
}

Variable text(const std::string& utf8) {
  const std::u16string units = text::utf16(utf8);
  return array(nullptr, MAT_C_CHAR, MAT_T_UTF16, {units.empty() ? 0UL : 1UL, units.size()},
               units.data());
}

Variable structure(const char* name, std::vector<Field> fields) {
  std::vector<const char*> names;
  for (const Field& field : fields) names.push_back(field.name.c_str());
  std::size_t dimensions[] = {1, 1};
  Variable result = require_made(
      Mat_VarCreateStruct(name, 2, dimensions, names.data(), static_cast<unsigned>(names.size())));
  for (Field& field : fields)
    Mat_VarSetStructFieldByName(result.get(), field.name.c_str(), 0, field.value.release());
  return result;
}

Variable about(const RecordHeader& header) {
  std::vector<std::string> keys;
  for (const auto& annotation : header.annotations) keys.push_back(annotation.first);
  const std::vector<std::string> names = matlab_names(keys, {});
  std::vector<Field> annotations;
  for (std::size_t i = 0; i < names.size(); ++i)
    annotations.push_back({names[i], text(header.annotations[i].second)});
  std::vector<Field> fields;
  fields.push_back({"name", text(header.name)});
  fields.push_back({"period", numbers(nullptr, {header.period})});
  fields.push_back({"annotations", structure(nullptr, std::move(annotations))});
  fields.push_back({"experiment", text(header.experiment)});
  return structure("record", std::move(fields));
}

Variable channel_variable(const std::string& name, const Channel& channel,
                          const std::vector<double>& data) {
  std::vector<Field> fields;
  fields.push_back({"path", text(channel.path)});
  fields.push_back({"data", numbers(nullptr, data)});
  fields.push_back({"unit", text(channel.unit)});
  fields.push_back({"type", text(channel.type)});
  fields.push_back({"min", numbers(nullptr, {channel.minimum})});
  fields.push_back({"max", numbers(nullptr, {channel.maximum})});
  fields.push_back({"doc", text(channel.doc)});
  return structure(name.c_str(), std::move(fields));
}

/// An upper bound of the file's size: all data uncompressed, two bytes a character, and what the
/// format adds to each of ten fields.
std::uint64_t room(const RecordHeader& header, std::int64_t rows) {
  constexpr std::uint64_t per_variable = 32768;
  std::uint64_t characters = header.experiment.size() + header.name.size();
  for (const auto& [key, value] : header.annotations) characters += key.size() + value.size();
  for (const Channel& channel : header.channels)
    characters += channel.path.size() + channel.doc.size() + channel.unit.size();
  const std::uint64_t variables = header.channels.size() + 2;
  return 2 * characters +
         variables * (sizeof(double) * static_cast<std::uint64_t>(rows) + per_variable);
}

class MatWriter {
 public:
  MatWriter(const std::filesystem::path& file, mat_ft version) : path_(file) {
    // Unlike the rest of a file's head, its text says when it was made unless one is given.
    file_.reset(Mat_CreateVer(file.c_str(), "MATLAB MAT-file, written by hookpoint", version));
    if (!file_) fail_file("create", file);
  }
  void write(const Variable& variable) {
    if (Mat_VarWrite(file_.get(), variable.get(), MAT_COMPRESSION_ZLIB) != 0)
      throw FileError("cannot write " + path_.string());
    ++written_;
  }
  /// libmatio tells nothing of a write that failed: what is in the file is counted.
  void close() {
    file_.reset();
    const MatFile reopened(Mat_Open(path_.c_str(), MAT_ACC_RDONLY));
    std::size_t found = 0;
    while (reopened) {
      const Variable next(Mat_VarReadNextInfo(reopened.get()));
      if (!next) break;
      ++found;
    }
    if (found != written_) throw FileError("cannot write " + path_.string() + " whole");
  }

 private:
  std::filesystem::path path_;
  MatFile file_;
  std::size_t written_ = 0;
};

/// The spool's record as the file `target`. Columns are read a few at a time: as many as fit into
/// some 64 MB.
void convert(SpoolReader& spool, const std::filesystem::path& target) {
  const RecordHeader& header = spool.header();
  { PartialFile room_maker(target, ""); }
  reserve_room(target, room(header, spool.rows()));
  MatWriter file(target, spool.format() == "mat73" ? MAT_FT_MAT73 : MAT_FT_MAT5);
  file.write(about(header));

  std::vector<std::string> paths;
  for (const Channel& channel : header.channels) paths.push_back(channel.path);
  const std::vector<std::string> names =
      matlab_names(paths, std::vector<std::string>{"time", "record"});
  const std::size_t width = header.channels.size() + 1;
  const std::size_t at_once =
      std::clamp<std::size_t>((8U << 20U) / (static_cast<std::size_t>(spool.rows()) + 1), 1, width);
  std::vector<std::vector<double>> columns(at_once);
  for (std::size_t first = 0; first < width; first += at_once) {
    columns.resize(std::min(at_once, width - first));
    spool.read(first, columns);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const std::size_t column = first + i;
      file.write(column == 0 ? numbers("time", columns[i])
                             : channel_variable(names[column - 1], header.channels[column - 1],
                                                columns[i]));
    }
  }
  file.close();
  if (spool.format() == "mat73") clear_object_times(target);
}

class MatRecord final : public RecordWriter {
 public:
  MatRecord(const std::filesystem::path& path, std::string_view format, const RecordHeader& header)
      : RecordWriter(header.channels.size()), path_(path), spool_(path, format, header) {}

 private:
  void append(double time, std::span<const double> values) override { spool_.row(time, values); }
  void finish() override {
    make(partial_name(path_));
    rename_file(partial_name(path_), path_);
    std::filesystem::remove(spool_.path());
  }
  Kept keep() override {
    try {
      make(partial_name(path_));
    } catch (const FileError&) {
      std::error_code ignored;
      std::filesystem::remove(partial_name(path_), ignored);
      return {spool_.path(), spool_.rows()};
    }
    std::filesystem::remove(spool_.path());
    return {partial_name(path_), spool_.rows()};
  }
  void make(const std::filesystem::path& target) const {
    SpoolReader reader(spool_.path());
    convert(reader, target);
  }

  std::filesystem::path path_;
  SpoolWriter spool_;
};

}  // namespace

RecoveredRecord recover_spool(const std::filesystem::path& spool) {
  SpoolReader reader(spool);
  std::filesystem::path path = spool;
  if (path.extension() == spool_suffix) path.replace_extension();
  convert(reader, partial_name(path));
  rename_file(partial_name(path), path);
  std::filesystem::remove(spool);
  return {path, reader.rows()};
}

std::unique_ptr<RecordWriter> make_mat5_record(const std::filesystem::path& path,
                                               const RecordHeader& header) {
  return std::make_unique<MatRecord>(path, "mat5", header);
}

std::unique_ptr<RecordWriter> make_mat73_record(const std::filesystem::path& path,
                                                const RecordHeader& header) {
  return std::make_unique<MatRecord>(path, "mat73", header);
}

}  // namespace hookpoint::output
