// A comparison for people and for machines.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "studies/compare/comparison.h"
#include "studies/report/terminal_blocks.h"
#include "text/display.h"
#include "text/json.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

using text::rounded;

constexpr std::size_t most_listed = 20;
constexpr int digits = 6;

Cell left(std::string text, Tone tone = Tone::plain) { return {std::move(text), tone, false}; }
Cell right(std::string text, Tone tone = Tone::plain) { return {std::move(text), tone, true}; }

/// A table of at most `most_listed` rows, indented, under a heading; nothing without rows.
std::string listed(const std::string& heading, CellRow titles, const std::vector<CellRow>& rows,
                   bool color) {
  if (rows.empty()) return "";
  ColumnGroup group;
  group.rows.push_back(std::move(titles));
  group.rows.insert(group.rows.end(), rows.begin(),
                    rows.begin() + static_cast<long>(std::min(rows.size(), most_listed)));
  for (CellRow& row : group.rows) row.front().text.insert(0, "  ");
  group.measure();
  std::string text = "\n" + text::printable(heading) + "\n" + print_groups({&group}, color);
  if (rows.size() > most_listed)
    text += fmt::format("  and {} more (--json lists all)\n", rows.size() - most_listed);
  return text;
}

std::string count(std::size_t number, const char* noun) {
  return fmt::format("{} {}{}", number, noun, number == 1 ? "" : "s");
}

std::string settings_part(const char* heading, const std::vector<SettingDifference>& differences,
                          bool color) {
  std::vector<CellRow> rows;
  for (const SettingDifference& each : differences)
    rows.push_back({left(each.trail), left(each.first.value_or("(not there)")),
                    left(each.second.value_or("(not there)"))});
  return listed(fmt::format("{}: {}", heading, count(rows.size(), "difference")),
                {left("what"), left("first"), left("second")}, rows, color);
}

/// The row with the largest relative difference of the metric; a value that only one run has is
/// larger than any. Null without differences.
const ValueDifference* worst_of(const MetricComparison& metric) {
  const auto badness = [](const ValueDifference& value) {
    return value.first && value.second ? value.relative : HUGE_VAL;
  };
  const auto worst =
      std::ranges::max_element(metric.differences, {}, [&](const auto& d) { return badness(d); });
  return worst == metric.differences.end() ? nullptr : &*worst;
}

std::string value_text(const std::optional<double>& value) {
  return rounded(value, "none", digits);
}

std::string metrics_part(const Comparison& comparison, bool color) {
  std::vector<CellRow> rows;
  for (const MetricComparison& metric : comparison.metrics) {
    const ValueDifference* worst = worst_of(metric);
    const Tone tone = worst == nullptr ? Tone::good : metric.timing ? Tone::faint : Tone::bad;
    rows.push_back({left(metric.title + (metric.timing ? " (reported only)" : "")),
                    right(fmt::format("{} of {}", metric.differences.size(), metric.rows), tone),
                    right(rounded(metric.greatest_absolute, 3)),
                    right(rounded(metric.greatest_relative, 3)),
                    left(worst == nullptr ? ""
                                          : fmt::format("{} -> {} at {}", value_text(worst->first),
                                                        value_text(worst->second), worst->row))});
  }
  return listed(
      "metrics, rows with the same " + fmt::format("{}", fmt::join(comparison.joined_by, ", ")),
      {left("metric"), right("differ"), right("largest"), right("relative"), left("where most")},
      rows, color);
}

std::string words_part(const Comparison& comparison, bool color) {
  std::vector<CellRow> rows;
  for (const WordChange& change : comparison.words)
    rows.push_back({left(change.what), left(change.first.empty() ? "none" : change.first),
                    left(change.second.empty() ? "none" : change.second), left(change.row)});
  return listed("verdicts and statuses that changed: " + std::to_string(rows.size()),
                {left("what"), left("first"), left("second"), left("row")}, rows, color);
}

std::string trajectories_part(const Comparison& comparison, bool color) {
  std::vector<CellRow> rows;
  std::size_t channels = 0;
  for (const TrajectoryComparison& trajectory : comparison.trajectories) {
    for (const ChannelComparison& channel : trajectory.channels) {
      ++channels;
      if (!channel.parts_at) continue;
      rows.push_back({left(trajectory.name + (trajectory.interpolated ? " (interpolated)" : "")),
                      left(channel.title), right(rounded(*channel.parts_at, digits), Tone::bad),
                      right(rounded(channel.greatest, 3)),
                      right(rounded(channel.greatest_at, digits))});
    }
  }
  if (channels == 0) return "";
  const std::string heading =
      fmt::format("trajectories: {} of {} part", rows.size(), count(channels, "channel"));
  if (rows.empty()) return "\n" + heading + "\n";
  return listed(heading,
                {left("trajectory"), left("channel"), right("parts at [s]"), right("largest"),
                 right("at [s]")},
                rows, color);
}

std::string alone_part(const char* which, const std::vector<std::string>& things, bool color) {
  std::vector<CellRow> rows;
  for (const std::string& thing : things) rows.push_back({left(thing)});
  return listed(fmt::format("only in the {}: {}", which, things.size()), {left("what")}, rows,
                color);
}

std::string verdict(const Comparison& comparison, bool color) {
  const std::string of = comparison.nothing_measured
                             ? "neither run recorded anything; their experiments "
                             : fmt::format("within {} the results ", rounded(comparison.tolerance));
  return "\n" + of +
         (comparison.same() ? toned("are the same", Tone::good, color)
                            : toned("differ", Tone::bad, color)) +
         "\n";
}

void optional_member(text::JsonWriter& json, const char* name, const std::optional<double>& value) {
  json.key(name);
  value ? json.value(*value) : json.null();
}

void settings_json(text::JsonWriter& json, const char* name,
                   const std::vector<SettingDifference>& differences) {
  json.key(name).begin_array();
  for (const SettingDifference& each : differences) {
    json.begin_object().member("trail", each.trail);
    json.key("first");
    each.first ? json.value(*each.first) : json.null();
    json.key("second");
    each.second ? json.value(*each.second) : json.null();
    json.end_object();
  }
  json.end_array();
}

void texts_json(text::JsonWriter& json, const char* name, const std::vector<std::string>& texts) {
  json.key(name).begin_array();
  for (const std::string& text : texts) json.value(text);
  json.end_array();
}

void metrics_json(text::JsonWriter& json, const std::vector<MetricComparison>& metrics) {
  json.key("metrics").begin_array();
  for (const MetricComparison& metric : metrics) {
    json.begin_object().member("metric", metric.title).member("timing", metric.timing);
    json.member("rows", metric.rows).member("greatest_absolute", metric.greatest_absolute);
    json.member("greatest_relative", metric.greatest_relative).key("differences").begin_array();
    for (const ValueDifference& value : metric.differences) {
      json.begin_object().member("row", value.row);
      optional_member(json, "first", value.first);
      optional_member(json, "second", value.second);
      json.member("absolute", value.absolute).member("relative", value.relative).end_object();
    }
    json.end_array().end_object();
  }
  json.end_array();
}

void trajectories_json(text::JsonWriter& json,
                       const std::vector<TrajectoryComparison>& trajectories) {
  json.key("trajectories").begin_array();
  for (const TrajectoryComparison& trajectory : trajectories) {
    json.begin_object().member("trajectory", trajectory.name);
    json.member("instants", trajectory.instants).member("interpolated", trajectory.interpolated);
    json.key("channels").begin_array();
    for (const ChannelComparison& channel : trajectory.channels) {
      json.begin_object().member("channel", channel.title).member("greatest", channel.greatest);
      json.member("greatest_at", channel.greatest_at).member("allowed", channel.allowed);
      optional_member(json, "parts_at", channel.parts_at);
      json.end_object();
    }
    json.end_array().end_object();
  }
  json.end_array();
}

}  // namespace

std::string comparison_text(const Comparison& comparison, const TableStyle& style) {
  std::string text = "first:  " + comparison.first + "\nsecond: " + comparison.second + "\n";
  for (const std::string& note : comparison.notes) text += "note: " + text::printable(note) + "\n";
  text += settings_part("experiment", comparison.experiment, style.color);
  text += settings_part("provenance", comparison.provenance, style.color);
  if (comparison.experiment.empty() && comparison.provenance.empty())
    text += "\nsettings: the same\n";
  if (!comparison.metrics.empty()) text += metrics_part(comparison, style.color);
  text += words_part(comparison, style.color);
  text += trajectories_part(comparison, style.color);
  text += alone_part("first", comparison.only_first, style.color);
  text += alone_part("second", comparison.only_second, style.color);
  return text + verdict(comparison, style.color);
}

std::string comparison_json(const Comparison& comparison) {
  text::JsonWriter json;
  json.begin_object().member("first", comparison.first).member("second", comparison.second);
  json.member("tolerance", comparison.tolerance).member("same", comparison.same());
  json.key("settings").begin_object();
  settings_json(json, "experiment", comparison.experiment);
  settings_json(json, "provenance", comparison.provenance);
  json.end_object();
  texts_json(json, "joined_by", comparison.joined_by);
  metrics_json(json, comparison.metrics);
  json.key("changed").begin_array();
  for (const WordChange& change : comparison.words)
    json.begin_object()
        .member("row", change.row)
        .member("what", change.what)
        .member("first", change.first)
        .member("second", change.second)
        .end_object();
  json.end_array();
  trajectories_json(json, comparison.trajectories);
  texts_json(json, "only_first", comparison.only_first);
  texts_json(json, "only_second", comparison.only_second);
  texts_json(json, "notes", comparison.notes);
  return json.end_object().text();
}

}  // namespace hookpoint::studies
