#include "studies/cluster/run_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <memory>
#include <utility>

#include "output/files/file.h"
#include "simulation/run/expectation.h"
#include "text/json.h"
#include "text/json_reader.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

void write_pair(text::JsonWriter& json, const std::string& name, const std::string& value) {
  json.begin_array().value(name).value(value).end_array();
}

void write_parameters(text::JsonWriter& json, const char* key,
                      const std::map<std::string, std::string>& parameters) {
  json.key(key).begin_array();
  for (const auto& [name, value] : parameters) write_pair(json, name, value);
  json.end_array();
}

/// What a UserMetric is told by, in this order, its trails last.
enum OwnPart {
  own_name,
  own_expectation,
  own_trace,
  own_scale,
  own_formula,
  own_take,
  own_from,
  own_to,
  own_level,
  own_band,
  own_trails
};

void write_own(text::JsonWriter& json, const UserMetric& metric) {
  const simulation::ReductionSpec& spec = metric.reduction;
  json.begin_array().value(metric.name).value(metric.expectation).value(metric.trace);
  json.value(text::shortest(metric.scale)).value(metric.of == nullptr ? "" : metric.of->text);
  json.value(simulation::reduction_names()[static_cast<std::size_t>(spec.take)]);
  json.value(text::shortest(spec.from)).value(text::shortest(spec.to));
  json.value(text::shortest(spec.level)).value(text::shortest(spec.band));
  for (const std::string& trail : metric.trails) json.value(trail);
  json.end_array();
}

/// What was measured, each curve once: many runs are held against the same.
class WrittenTraces {
 public:
  explicit WrittenTraces(const RunList& list) {
    for (const RunRequest& run : list.runs)
      for (const auto& [name, trace] : run.measurement.traces)
        if (numbers_.try_emplace(trace.get(), traces_.size()).second)
          traces_.push_back(trace.get());
  }
  void write(text::JsonWriter& json) const {
    json.key("measured").begin_array();
    for (const TracePlan* trace : traces_) {
      json.begin_object().member("unit_of_port", trace->unit_of_port);
      json.member("weight", trace->weight).key("parts").begin_array();
      for (const std::string& part : trace->parts) json.value(part);
      json.end_array();
      write_numbers(json, "time", trace->measured.time);
      write_numbers(json, "value", trace->measured.value);
      json.end_object();
    }
    json.end_array();
  }
  std::size_t number_of(const TracePlan& trace) const { return numbers_.at(&trace); }

 private:
  static void write_numbers(text::JsonWriter& json, const char* key,
                            const std::vector<double>& numbers) {
    json.key(key).begin_array();
    for (const double number : numbers) json.value(number);
    json.end_array();
  }

  std::vector<const TracePlan*> traces_;
  std::map<const TracePlan*, std::size_t> numbers_;
};

void write_run(text::JsonWriter& json, const RunRequest& run, const WrittenTraces& traces) {
  json.begin_object().member("name", run.name).member("identity", run.identity);
  json.member("scene", std::filesystem::absolute(run.scene.file).string());
  write_parameters(json, "parameters", run.scene.options.parameters);
  if (run.scene.ground) {
    json.member("ground", std::filesystem::absolute(run.scene.ground->file).string());
    write_parameters(json, "ground_parameters", run.scene.ground->parameters);
  }
  json.key("overrides").begin_array();
  for (const language::Override& set : run.scene.options.overrides)
    write_pair(json, set.trail, set.value);
  json.end_array();
  json.member("body", run.measurement.body);
  json.member("settle", run.measurement.settle).member("duration", run.measurement.duration);
  json.key("metrics").begin_array();
  for (const MetricDefinition* metric : run.measurement.metrics)
    if (metric->user == nullptr) json.value(metric->name);
  json.end_array().key("own").begin_array();
  for (const MetricDefinition* metric : run.measurement.metrics)
    if (metric->user != nullptr) write_own(json, *metric->user);
  json.end_array().key("traces").begin_array();
  for (const auto& [name, trace] : run.measurement.traces)
    write_pair(json, name, std::to_string(traces.number_of(*trace)));
  json.end_array().key("signals").begin_array();
  for (const RecordedSignal& recorded : run.measurement.signals)
    write_pair(json, std::string(recorded.signal->name), recorded.logarithmic ? "log" : "linear");
  json.end_array().member("path", run.measurement.path).end_object();
}

using text::JsonValue;
using ListedTraces = std::vector<std::shared_ptr<const TracePlan>>;

/// `number` becomes what the text says; false if it is no number.
bool read_number(const std::string& text, double& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size();
}
bool read_number(const std::string& text, std::optional<double>& number) {
  return text.empty() || read_number(text, number.emplace());
}

/// Calls `take` with each item of a list; false if it is no list, or `take` says so.
template <class Take>
bool read_each(const JsonValue& list, Take take) {
  return list.is_list() && std::ranges::all_of(list.items(), take);
}

/// Calls `take` with the two texts of each item, as write_pair writes them.
template <class Take>
bool read_pairs(const JsonValue& list, Take take) {
  return read_each(list, [&](const JsonValue& item) {
    const auto pair = item.items();
    return pair.size() == 2 && take(pair[0].text(), pair[1].text());
  });
}

bool read_parameters(const JsonValue& list, std::map<std::string, std::string>& parameters) {
  return read_pairs(list, [&](const std::string& name, const std::string& value) {
    parameters[name] = value;
    return true;
  });
}

bool read_numbers(const JsonValue& list, std::vector<double>& numbers) {
  return read_each(list, [&](const JsonValue& item) {
    return read_number(item.text(), numbers.emplace_back());
  });
}

/// One curve; null where it is not whole, or has not as many samples as times.
std::shared_ptr<const TracePlan> read_measured(const JsonValue& object) {
  auto trace = std::make_shared<TracePlan>();
  MeasuredTrace& measured = trace->measured;
  for (const auto& [name, value] : object.members()) {
    const bool whole = name == "unit_of_port" ? read_number(value.text(), trace->unit_of_port)
                       : name == "weight"     ? read_number(value.text(), trace->weight)
                       : name == "time"       ? read_numbers(value, measured.time)
                       : name == "value"      ? read_numbers(value, measured.value)
                       : name == "parts"      ? read_each(value,
                                                          [&](const JsonValue& part) {
                                                       trace->parts.push_back(part.text());
                                                       return true;
                                                     })
                                              : false;
    if (!whole) return nullptr;
  }
  measured.width = trace->parts.size();
  return measured.value.size() == measured.time.size() * measured.width ? trace : nullptr;
}

/// A metric of the user's own, from its parts. The run's traces are there.
bool read_own(const JsonValue& list, Measurement& measurement) {
  std::vector<std::string> parts;
  for (const JsonValue& part : list.items()) parts.push_back(part.text());
  if (parts.size() < own_trails) return false;
  UserMetric metric;
  metric.name = parts[own_name];
  metric.expectation = parts[own_expectation];
  metric.trace = parts[own_trace];
  metric.trails.assign(parts.begin() + own_trails, parts.end());
  const auto take = simulation::find_reduction(parts[own_take]);
  if (!take) return false;
  metric.reduction.take = *take;
  const bool numbers = read_number(parts[own_scale], metric.scale) &&
                       read_number(parts[own_from], metric.reduction.from) &&
                       read_number(parts[own_to], metric.reduction.to) &&
                       read_number(parts[own_level], metric.reduction.level) &&
                       read_number(parts[own_band], metric.reduction.band);
  if (!numbers) return false;
  if (!metric.trace.empty()) {
    if (!measurement.traces.contains(metric.trace)) return false;
  } else if (metric.expectation.empty()) {
    auto formula = language::read_formula(parts[own_formula]);
    if (!formula || formula->names.size() != metric.trails.size()) return false;
    metric.of = std::make_shared<const language::Formula>(std::move(*formula));
  }
  auto stored = std::make_shared<UserMetric>(std::move(metric));
  complete(*stored);
  measurement.metrics.push_back(&stored->definition);
  measurement.owned.push_back(std::move(stored));
  return true;
}

bool read_metrics(const JsonValue& list, Measurement& measurement) {
  return read_each(list, [&](const JsonValue& name) {
    measurement.metrics.push_back(find_metric(name.text()));
    return measurement.metrics.back() != nullptr;
  });
}

bool read_traces(const JsonValue& list, const ListedTraces& all, Measurement& measurement) {
  return read_pairs(list, [&](const std::string& name, const std::string& text) {
    double number = -1.;
    const bool there =
        read_number(text, number) && number >= 0. && number < static_cast<double>(all.size());
    if (there) measurement.traces[name] = all[static_cast<std::size_t>(number)];
    return there;
  });
}

bool read_signals(const JsonValue& list, Measurement& measurement) {
  return read_pairs(list, [&](const std::string& name, const std::string& scale) {
    measurement.signals.push_back({find_signal(name), scale == "log"});
    return measurement.signals.back().signal != nullptr;
  });
}

bool read_overrides(const JsonValue& list, std::vector<language::Override>& overrides) {
  return read_pairs(list, [&](const std::string& trail, const std::string& value) {
    overrides.push_back({trail, value});
    return true;
  });
}

/// One member of a run; false for what no run has. Metrics of the user's own come after all others.
bool read_member(const std::string& name, const JsonValue& value, const ListedTraces& traces,
                 RunRequest& run) {
  Measurement& measurement = run.measurement;
  if (name == "parameters") return read_parameters(value, run.scene.options.parameters);
  if (name == "ground_parameters")
    return run.scene.ground && read_parameters(value, run.scene.ground->parameters);
  if (name == "overrides") return read_overrides(value, run.scene.options.overrides);
  if (name == "metrics") return read_metrics(value, measurement);
  if (name == "own") return value.is_list();
  if (name == "traces") return read_traces(value, traces, measurement);
  if (name == "signals") return read_signals(value, measurement);
  if (!value.is_leaf()) return false;
  const std::string& text = value.text();
  if (name == "settle") return read_number(text, measurement.settle);
  if (name == "duration") return read_number(text, measurement.duration);
  if (name == "name")
    run.name = text;
  else if (name == "identity")
    run.identity = text;
  else if (name == "scene")
    run.scene.file = text;
  else if (name == "ground")
    run.scene.ground = {text, {}};
  else if (name == "body")
    measurement.body = text;
  else if (name == "path")
    measurement.path = text == "true";
  else
    return false;
  return true;
}

}  // namespace

std::string run_list_text(const RunList& list) {
  text::JsonWriter json;
  const WrittenTraces traces(list);
  json.begin_object().member("allow_plugins", list.code.allow_plugins);
  json.member("allow_engines", list.code.allow_engines).key("engine_files").begin_array();
  for (const std::string& file : list.code.engine_files) json.value(file);
  json.end_array();
  traces.write(json);
  json.key("runs").begin_array();
  for (const RunRequest& run : list.runs) write_run(json, run, traces);
  json.end_array().end_object();
  return json.text();
}

RunList read_run_list(const std::filesystem::path& file) {
  const auto content = output::read_file(file);
  if (!content) throw RunListError("cannot read " + file.string());
  const auto refuse = [&](const std::string& why) {
    throw RunListError(file.string() + " is no list of runs of this hookpoint: " + why);
  };
  const auto root = text::read_json(*content);
  if (!root) refuse("it is not JSON");
  RunList list;
  ListedTraces traces;
  for (const auto& [key, value] : root->members()) {
    if (key == "allow_plugins") {
      list.code.allow_plugins = value.text() == "true";
    } else if (key == "allow_engines") {
      list.code.allow_engines = value.text() == "true";
    } else if (key == "engine_files") {
      for (const JsonValue& name : value.items()) list.code.engine_files.push_back(name.text());
    } else if (key == "measured") {
      for (const JsonValue& trace : value.items()) {
        traces.push_back(read_measured(trace));
        if (traces.back() == nullptr) refuse(fmt::format("`measured[{}]`", traces.size() - 1));
      }
    } else if (key != "runs" || !value.is_list()) {
      refuse("`" + key + "`");
    } else {
      for (const JsonValue& object : value.items()) {
        RunRequest& run = list.runs.emplace_back();
        for (const auto& [name, member] : object.members())
          if (!read_member(name, member, traces, run))
            refuse(fmt::format("`runs[{}].{}`{}", list.runs.size() - 1, name,
                               member.is_leaf() ? " is " + member.text() : ""));
        const JsonValue* own = object.member("own");
        if (own != nullptr)
          for (const JsonValue& metric : own->items())
            if (!read_own(metric, run.measurement)) refuse("a metric of " + run.name);
      }
    }
  }
  return list;
}

}  // namespace hookpoint::studies
