#include "language/document/plugin_search.h"

#include <algorithm>
#include <vector>

namespace hookpoint::language {

void PluginSearch::visit(const ParsedFile& file) {
  if (!visited_.insert(&file).second) return;
  report_.order_file(file.source);
  report_.append(file.report);
  // A Plugin counts at the top only, an Include anywhere. Nested items stand before what holds them
  // in the table; the order of the text is the user's.
  const Syntax& syntax = file.syntax;
  std::vector<const Item*> items;
  for (std::uint32_t i = 0; i < syntax.items.size(); ++i) {
    const ItemKind kind = syntax.items[i].kind;
    const bool top = i >= syntax.top.begin && i < syntax.top.end;
    if (kind == ItemKind::include || (kind == ItemKind::plugin && top))
      items.push_back(&syntax.items[i]);
  }
  std::ranges::sort(items, {}, [](const Item* item) { return item->place.offset; });
  for (const Item* item : items) {
    if (item->kind == ItemKind::include) {
      include(file, *item);
    } else {
      load(file, *item);
    }
  }
}

void PluginSearch::include(const ParsedFile& file, const Item& item) {
  if (!item.value.empty()) return;  // its path is a value: no Plugin may stand there
  Report unreported;                // the evaluation says which files are missing
  const std::filesystem::path found = find_named(files_, file, item, unreported);
  if (found.empty()) return;
  const ParsedFile& included = files_.load(found);
  report_.enter_include(included.source, {&file.source, item.place.offset, item.place.length});
  visit(included);
  report_.leave_include();
}

void PluginSearch::load(const ParsedFile& file, const Item& item) {
  const std::filesystem::path found = find_named(files_, file, item, report_);
  if (found.empty()) {
    all_loaded_ = false;
    return;
  }
  if (!loaded_.insert(found).second) return;
  const std::string problem = load_(found);
  if (problem.empty()) return;
  all_loaded_ = false;
  const Span path = file.syntax.details[item.detail].path;
  const std::string written =
      unquote(std::string_view(file.source.text).substr(path.offset, path.length));
  report_.error({&file.source, path.offset, path.length},
                "the plugin `" + written + "` " + problem);
}

bool PluginSearch::deliver(Diagnostics& diagnostics) const {
  if (!all_loaded_) report_.deliver(diagnostics);
  return all_loaded_;
}

}  // namespace hookpoint::language
