#include <algorithm>
#include <set>

#include "language/document/document.h"
#include "language/document/plugin_search.h"
#include "language/syntax/files.h"
#include "language/tree/builder.h"
#include "language/tree/checker.h"
#include "language/tree/prepared.h"

namespace hookpoint::language {

struct Library::Implementation {
  Implementation(const Schema& schema, std::vector<std::filesystem::path> search_path)
      : prepared(schema), files(schema, std::move(search_path)) {}
  PreparedSchema prepared;
  FileStore files;
};

Library::Library(const Schema& schema, std::vector<std::filesystem::path> search_path)
    : implementation_(std::make_unique<Implementation>(schema, std::move(search_path))) {}

Library::~Library() = default;

void Library::give(const std::filesystem::path& path, std::string text) {
  implementation_->files.give(path, std::move(text));
}

std::unique_ptr<Object> Library::evaluate(const std::filesystem::path& file,
                                          const EvaluateOptions& options,
                                          Diagnostics& diagnostics) {
  const ParsedFile& parsed = implementation_->files.load(file);
  // An override by a lone name that is a Param gives the Param its value.
  EvaluateOptions split;
  split.parameters = options.parameters;
  for (const Override& setting : options.overrides) {
    if (find_param(parsed, setting.trail) != nullptr) {
      split.parameters[setting.trail] = setting.value;
    } else {
      split.overrides.push_back(setting);
    }
  }
  Report report;
  report.order_file(parsed.source);
  Builder builder(implementation_->prepared, implementation_->files, report);
  std::unique_ptr<Object> root = builder.build(parsed, split);
  if (options.amend) options.amend(*root);
  Checker checker(implementation_->prepared, implementation_->files, builder.left_out(),
                  builder.hints(), report);
  // Of a file that could not be read at all nothing is known.
  const bool unread = parsed.report.has_errors() && parsed.syntax.items.empty();
  for (const Override& setting : unread ? std::vector<Override>{} : split.overrides)
    checker.apply(*root, setting, param_names(parsed));
  checker.check(*root);
  report.deliver(diagnostics);
  return report.has_errors() ? nullptr : std::move(root);
}

bool Library::load_plugins(const std::filesystem::path& file, const PluginLoader& load,
                           Diagnostics& diagnostics) {
  PluginSearch search(implementation_->files, load);
  search.visit(implementation_->files.load(file));
  return search.deliver(diagnostics);
}

std::vector<ParameterDeclaration> Library::parameters(const std::filesystem::path& file,
                                                      Diagnostics& diagnostics) {
  const ParsedFile& parsed = implementation_->files.load(file);
  parsed.report.deliver(diagnostics);
  const std::string& text = parsed.source.text;
  std::vector<ParameterDeclaration> declarations;
  for (const std::string& name : param_names(parsed)) {
    const Item& item = *find_param(parsed, name);
    ParameterDeclaration& declaration = declarations.emplace_back();
    declaration.name = name;
    declaration.position = {&parsed.source, item.name.offset, item.name.length};
    if (item.value.empty()) continue;
    const Span first = parsed.syntax.expressions[item.value.begin].span;
    const Span last = parsed.syntax.expressions[item.value.end - 1].span;
    declaration.default_text = text.substr(first.offset, last.offset + last.length - first.offset);
  }
  return declarations;
}

namespace {

/// The first object at the top whose class is `type`, or is not.
const Item* find_at_top(const ParsedFile& parsed, std::string_view type, bool of_type) {
  const std::string_view text = parsed.source.text;
  const Range top = parsed.syntax.top;
  for (std::uint32_t i = top.begin; i < top.end; ++i) {
    const Item& item = parsed.syntax.items[i];
    if (item.kind != ItemKind::object) continue;
    if ((text.substr(item.place.offset, item.place.length) == type) == of_type) return &item;
  }
  return nullptr;
}

void collect_included(FileStore& files, const ParsedFile& file,
                      std::vector<const ParsedFile*>& found) {
  if (std::ranges::find(found, &file) != found.end()) return;
  found.push_back(&file);
  Report unreported;  // the evaluation says which files are missing
  for (const Item& item : file.syntax.items) {
    if (item.kind != ItemKind::include || !item.value.empty()) continue;
    const std::filesystem::path path = find_named(files, file, item, unreported);
    if (!path.empty()) collect_included(files, files.load(path), found);
  }
}

}  // namespace

bool Library::declares(const std::filesystem::path& file, std::string_view type) {
  return find_at_top(implementation_->files.load(file), type, true) != nullptr;
}

std::vector<std::filesystem::path> Library::declaring(const std::filesystem::path& file,
                                                      std::string_view type) {
  std::vector<const ParsedFile*> files;
  collect_included(implementation_->files, implementation_->files.load(file), files);
  std::vector<std::filesystem::path> declaring;
  for (const ParsedFile* each : files)
    if (find_at_top(*each, type, true) != nullptr) declaring.emplace_back(each->source.path);
  return declaring;
}

std::optional<Position> Library::other_than(const std::filesystem::path& file,
                                            std::string_view type) {
  const ParsedFile& parsed = implementation_->files.load(file);
  const Item* item = find_at_top(parsed, type, false);
  if (item == nullptr) return std::nullopt;
  return Position{&parsed.source, item->place.offset, item->place.length};
}

std::filesystem::path Library::find(const std::filesystem::path& path,
                                    const std::filesystem::path& from) const {
  return implementation_->files.find(path, from);
}

const std::vector<std::filesystem::path>& Library::search_path() const {
  return implementation_->files.search_path();
}

namespace {

void collect_sources(const Object& object, std::set<const SourceFile*>& sources) {
  sources.insert(object.position.file);
  for (const Field& field : object.fields) sources.insert(field.position.file);
  for (const Wire& wire : object.wires) sources.insert(wire.position.file);
  for (const auto& child : object.children) collect_sources(*child, sources);
}

}  // namespace

std::vector<std::string> sources_of(const Object& root) {
  std::set<const SourceFile*> sources;
  collect_sources(root, sources);
  std::set<std::string> paths;
  std::error_code error;
  for (const SourceFile* source : sources) {
    // What was set on the command line has no file.
    if (source == nullptr || !std::filesystem::is_regular_file(source->path, error)) continue;
    paths.insert(std::filesystem::absolute(source->path).lexically_normal().string());
  }
  return {paths.begin(), paths.end()};
}

}  // namespace hookpoint::language
