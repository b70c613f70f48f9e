#include "language/syntax/files.h"

#include <fstream>
#include <utility>

#include "language/names.h"
#include "language/search.h"
#include "text/formats.h"

namespace hookpoint::language {
namespace {

constexpr std::size_t most_bytes = (256UL << 20) + 1;

/// Reads no more than the parser would take into `source`, whose path is known.
void read(SourceFile& source, Report& report) {
  const std::filesystem::path path = source.path;
  std::error_code ignored;
  const Position start{&source, 0, 1};
  if (!std::filesystem::exists(path, ignored)) return report.error(start, "there is no such file");
  if (std::filesystem::is_directory(path, ignored))
    return report.error(start, "this is a folder, expected a file");
  // Nobody may ever write to a pipe.
  if (!std::filesystem::is_regular_file(path, ignored))
    return report.error(start, "this is a pipe or a device, expected a file");
  std::ifstream stream(path, std::ios::binary);
  std::string text;
  std::vector<char> block(1 << 16);
  while (stream && text.size() < most_bytes) {
    stream.read(block.data(), static_cast<std::streamsize>(block.size()));
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
  }
  if (!stream.eof() && text.size() < most_bytes) report.error(start, "the file cannot be read");
  source = source_file(path.string(), std::move(text));
}

}  // namespace

std::filesystem::path FileStore::find(const std::filesystem::path& path,
                                      const std::filesystem::path& from) const {
  return find_along(path, from, search_path_);
}

std::vector<std::string> FileStore::searched(const std::filesystem::path& path,
                                             const std::filesystem::path& from) const {
  if (path.is_absolute()) return {path.parent_path().string()};
  std::vector<std::string> folders;
  for (const std::filesystem::path& folder : search_folders(from, search_path_))
    folders.push_back(folder.empty() ? "." : folder.string());
  return folders;
}

std::unique_ptr<FileStore::StoredFile>& FileStore::place_of(const std::filesystem::path& path) {
  std::error_code ignored;
  const std::string key = std::filesystem::weakly_canonical(path, ignored).string();
  return files_[key.empty() ? path.string() : key];
}

void FileStore::take(ParsedFile& file) const {
  const std::filesystem::path path = file.source.path;
  const std::string_view ending = text::usual_ending(file.source.text, path);
  file.reader =
      schema_.find_reader(ending.empty() ? path.extension().string() : std::string(ending));
  if (file.report.has_errors()) return;
  const std::string refusal = text::refusal(file.source.text, path, text::Use::experiment);
  if (!refusal.empty()) return file.report.error({&file.source, 0, 1}, refusal);
  if (file.reader == nullptr) parse(file);
}

const ParsedFile& FileStore::load(const std::filesystem::path& path) {
  const std::lock_guard lock(mutex_);
  std::unique_ptr<StoredFile>& file = place_of(path);
  if (file == nullptr) {
    file = std::make_unique<StoredFile>(source_file(path.string(), ""));
    read(file->source, file->parsed.report);
    take(file->parsed);
  }
  return file->parsed;
}

void FileStore::give(const std::filesystem::path& path, std::string text) {
  const std::lock_guard lock(mutex_);
  std::unique_ptr<StoredFile>& file = place_of(path);
  if (file != nullptr) return;
  file = std::make_unique<StoredFile>(source_file(path.string(), std::move(text)));
  take(file->parsed);
}

const SourceFile& FileStore::override_source(const std::string& trail, const std::string& value) {
  const std::lock_guard lock(mutex_);
  std::string text = trail + '=' + value;
  if (const auto found = overrides_.find(text); found != overrides_.end()) return *found->second;
  auto source =
      std::make_unique<const SourceFile>(source_file("<--set " + trail + ">", std::move(text)));
  const std::string_view key = source->text;
  return *overrides_.emplace(key, std::move(source)).first->second;
}

ParsedFile FileStore::override_text(const std::string& trail, const std::string& value) {
  ParsedFile file{override_source(trail, value)};
  parse_override(file);
  return file;
}

std::filesystem::path find_named(const FileStore& files, const ParsedFile& file,
                                 const std::string& path, const Position& place, Report& report) {
  const std::string& from = file.source.path;
  std::filesystem::path found;
  if (!path.empty()) found = files.find(path, from);
  if (found.empty()) {
    report.error(place, "there is no file `" + path + "`; looked in " +
                            join(files.searched(path, from), ", "));
  }
  return found;
}

std::filesystem::path find_named(const FileStore& files, const ParsedFile& file, const Item& item,
                                 Report& report) {
  const Span span = file.syntax.details[item.detail].path;
  const std::string_view written =
      std::string_view(file.source.text).substr(span.offset, span.length);
  return find_named(files, file, unquote(written), {&file.source, span.offset, span.length},
                    report);
}

const Item* find_param(const ParsedFile& file, std::string_view name) {
  for (std::uint32_t i = file.syntax.top.begin; i < file.syntax.top.end; ++i) {
    const Item& item = file.syntax.items[i];
    const std::string_view param =
        std::string_view(file.source.text).substr(item.name.offset, item.name.length);
    if (item.kind == ItemKind::param && param == name) return &item;
  }
  return nullptr;
}

std::vector<std::string> param_names(const ParsedFile& file) {
  std::vector<std::string> names;
  for (std::uint32_t i = file.syntax.top.begin; i < file.syntax.top.end; ++i) {
    const Item& item = file.syntax.items[i];
    if (item.kind == ItemKind::param)
      names.emplace_back(file.source.text, item.name.offset, item.name.length);
  }
  return names;
}

}  // namespace hookpoint::language
