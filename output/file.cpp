#include "output/file.h"

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

namespace hookpoint::output {

PartialFile::PartialFile(std::filesystem::path path) : path_(std::move(path)), partial_(path_) {
  partial_ += ".partial";
  std::error_code ignored;  // fopen reports the reason if the folder could not be made
  if (path_.has_parent_path()) std::filesystem::create_directories(path_.parent_path(), ignored);
  file_ = std::fopen(partial_.c_str(), "wb");
  if (file_ == nullptr) fail("create");
}

PartialFile::~PartialFile() {
  if (file_ != nullptr) std::fclose(file_);
}

void PartialFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail("write");
}

void PartialFile::complete() {
  std::FILE* file = std::exchange(file_, nullptr);
  if (std::fclose(file) != 0) fail("write");
  std::error_code error;
  std::filesystem::rename(partial_, path_, error);
  if (error) throw FileError("cannot rename " + partial_.string() + ": " + error.message());
}

void PartialFile::fail(const char* doing) const {
  throw FileError(std::string("cannot ") + doing + " " + partial_.string() + ": " +
                  std::strerror(errno));
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  PartialFile file(path);
  file.write(text);
  file.complete();
}

}  // namespace hookpoint::output
