#include "language/report.h"

#include <algorithm>

#include "text/display.h"

namespace hookpoint::language {

namespace {

/// Names in a message may be as long as the file.
std::string clipped(std::string message) {
  constexpr std::size_t longest = 600;
  if (message.size() <= longest) return message;
  return std::string(text::first_characters(message, longest)) + "...";
}

}  // namespace

void Report::error(const Position& position, std::string message) {
  message = clipped(std::move(message));
  // A loop or a file included twice finds the same mistake again and again.
  repeated_ = full() || !seen_.emplace(position.file, position.offset, message).second;
  if (repeated_) return;
  told_.emplace(position.file, position.offset);
  Finding& finding = findings_.emplace_back();
  finding.diagnostic = {Severity::error, position, std::move(message)};
  auto include = std::find_if(includes_.rbegin(), includes_.rend(),
                              [&](const Include& open) { return open.file == position.file; });
  for (; include != includes_.rend(); ++include) finding.included_from.push_back(include->place);
}

void Report::note(const Position& position, std::string message) {
  if (!repeated_)
    findings_.back().notes.push_back({Severity::note, position, clipped(std::move(message))});
}

void Report::remark(const Position& position, std::string message) {
  message = clipped(std::move(message));
  if (seen_.emplace(position.file, position.offset, message).second)
    remarks_.push_back({Severity::note, position, std::move(message)});
}

void Report::append(const Report& syntax_errors) {
  for (const Finding& finding : syntax_errors.findings_) {
    broken_.insert(finding.diagnostic.position.file);
    error(finding.diagnostic.position, finding.diagnostic.message);
    for (const Diagnostic& added : finding.notes) note(added.position, added.message);
  }
}

void Report::order_file(const SourceFile& file) {
  file_order_.try_emplace(&file, file_order_.size());
}

void Report::deliver(Diagnostics& diagnostics) const {
  const auto key = [this](const Finding& finding) {
    const Position& position = finding.diagnostic.position;
    const auto found = file_order_.find(position.file);
    return std::pair(found == file_order_.end() ? file_order_.size() : found->second,
                     position.offset);
  };
  for (const Diagnostic& remark : remarks_) diagnostics.note(remark.position, remark.message);
  std::vector<Finding> sorted = findings_;
  std::ranges::stable_sort(sorted, {}, key);
  for (const Finding& finding : sorted) {
    diagnostics.error(finding.diagnostic.position, finding.diagnostic.message);
    for (const Diagnostic& note : finding.notes) diagnostics.note(note.position, note.message);
    for (const Position& place : finding.included_from) diagnostics.note(place, "included here");
  }
}

}  // namespace hookpoint::language
