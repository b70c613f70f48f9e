#include "studies/cluster/run_list.h"

#include <charconv>
#include <map>
#include <memory>
#include <string_view>
#include <utility>

#include "output/file.h"
#include "output/text/json.h"
#include "output/text/json_reader.h"
#include "output/text/number.h"
#include "simulation/run/expectation.h"

namespace hookpoint::studies {
namespace {

constexpr std::string_view runs_key = "runs[", measured_key = "measured[";

void write_pair(output::JsonWriter& json, const std::string& name, const std::string& value) {
  json.begin_array().value(name).value(value).end_array();
}

void write_parameters(output::JsonWriter& json, const char* key,
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

std::string optional_text(const std::optional<double>& value) {
  return value ? output::shortest(*value) : "";
}

void write_own(output::JsonWriter& json, const UserMetric& metric) {
  const simulation::ReductionSpec& spec = metric.reduction;
  json.begin_array().value(metric.name).value(metric.expectation).value(metric.trace);
  json.value(output::shortest(metric.scale)).value(metric.of == nullptr ? "" : metric.of->text);
  json.value(simulation::reduction_names()[static_cast<std::size_t>(spec.take)]);
  json.value(output::shortest(spec.from)).value(optional_text(spec.to));
  json.value(optional_text(spec.level)).value(optional_text(spec.band));
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
  void write(output::JsonWriter& json) const {
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
  static void write_numbers(output::JsonWriter& json, const char* key,
                            const std::vector<double>& numbers) {
    json.key(key).begin_array();
    for (const double number : numbers) json.value(number);
    json.end_array();
  }

  std::vector<const TracePlan*> traces_;
  std::map<const TracePlan*, std::size_t> numbers_;
};

void write_run(output::JsonWriter& json, const RunRequest& run, const WrittenTraces& traces) {
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

bool read_number(const std::string& text, double& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size();
}

/// Reads the leaves of what was measured as they come: "measured[2].time[7]".
class TraceListReader {
 public:
  bool read(std::string_view key, const std::string& value) {
    const std::size_t dot = key.find('.');
    if (dot == std::string_view::npos) return false;
    if (place_ != key.substr(0, dot)) {
      place_ = key.substr(0, dot);
      traces_.push_back(std::make_shared<TracePlan>());
    }
    TracePlan& trace = *traces_.back();
    const std::string_view field = key.substr(dot + 1);
    const std::string_view kind = field.substr(0, field.find('['));
    if (kind == "unit_of_port") return read_number(value, trace.unit_of_port);
    if (kind == "weight") return read_number(value, trace.weight);
    if (kind == "time") return read_number(value, trace.measured.time.emplace_back());
    if (kind == "value") return read_number(value, trace.measured.value.emplace_back());
    if (kind != "parts") return false;
    trace.parts.push_back(value);
    trace.measured.width = trace.parts.size();
    return true;
  }
  /// The curve of that number; null where there is none, or not as many samples as times.
  std::shared_ptr<const TracePlan> trace(std::size_t number) const {
    if (number >= traces_.size()) return nullptr;
    const auto& found = traces_[number];
    const MeasuredTrace& measured = found->measured;
    return measured.value.size() == measured.time.size() * found->parts.size() ? found : nullptr;
  }

 private:
  std::string place_;
  std::vector<std::shared_ptr<TracePlan>> traces_;
};

/// Reads the leaves of one run as they come.
class RunReader {
 public:
  RunReader(RunRequest& run, const TraceListReader& traces) : run_(run), traces_(traces) {}

  /// `key` from the run on: "overrides[2][0]". False for what no run has.
  bool read(std::string_view key, const std::string& value) {
    const std::string_view kind = key.substr(0, key.find('['));
    const bool second = key.ends_with("[1]");
    if (kind == "name")
      run_.name = value;
    else if (kind == "identity")
      run_.identity = value;
    else if (kind == "scene")
      run_.scene.file = value;
    else if (kind == "parameters")
      return read_parameter(run_.scene.options.parameters, second, value);
    else if (kind == "ground")
      run_.scene.ground = {value, {}};
    else if (kind == "ground_parameters" && run_.scene.ground)
      return read_parameter(run_.scene.ground->parameters, second, value);
    else if (kind == "overrides")
      return read_override(second, value);
    else if (kind == "body")
      run_.measurement.body = value;
    else if (kind == "settle")
      return read_number(value, run_.measurement.settle);
    else if (kind == "duration")
      return read_number(value, run_.measurement.duration);
    else if (kind == "metrics")
      return read_metric(value);
    else if (kind == "own")
      return read_own(key, value);
    else if (kind == "traces")
      return read_trace(second, value);
    else if (kind == "signals")
      return read_signal(second, value);
    else if (kind == "path")
      run_.measurement.path = value == "true";
    else
      return false;
    return true;
  }

  /// Once all has been read: false where a metric of the user's own is not whole.
  bool finish() {
    for (const std::vector<std::string>& parts : own_)
      if (!add_own(parts)) return false;
    return true;
  }

 private:
  bool read_own(std::string_view key, const std::string& value) {
    if (key.ends_with("[0]")) own_.emplace_back();
    if (own_.empty()) return false;
    own_.back().push_back(value);
    return true;
  }
  static bool read_optional(const std::string& text, std::optional<double>& number) {
    return text.empty() || read_number(text, number.emplace());
  }
  bool add_own(const std::vector<std::string>& parts) {
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
                         read_optional(parts[own_to], metric.reduction.to) &&
                         read_optional(parts[own_level], metric.reduction.level) &&
                         read_optional(parts[own_band], metric.reduction.band);
    if (!numbers) return false;
    if (!metric.trace.empty()) {
      if (!run_.measurement.traces.contains(metric.trace)) return false;
    } else if (metric.expectation.empty()) {
      auto formula = language::read_formula(parts[own_formula]);
      if (!formula || formula->names.size() != metric.trails.size()) return false;
      metric.of = std::make_shared<const language::Formula>(std::move(*formula));
    }
    auto kept = std::make_shared<UserMetric>(std::move(metric));
    complete(*kept);
    run_.measurement.metrics.push_back(&kept->definition);
    run_.measurement.owned.push_back(std::move(kept));
    return true;
  }
  bool read_parameter(std::map<std::string, std::string>& parameters, bool second,
                      const std::string& value) {
    if (second)
      parameters[parameter_] = value;
    else
      parameter_ = value;
    return true;
  }
  bool read_override(bool second, const std::string& value) {
    auto& overrides = run_.scene.options.overrides;
    if (!second)
      overrides.push_back({value, {}});
    else if (!overrides.empty())
      overrides.back().value = value;
    return true;
  }
  bool read_trace(bool second, const std::string& value) {
    if (!second) {
      trace_ = value;
      return true;
    }
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error != std::errc{} || end != value.data() + value.size()) return false;
    auto& trace = run_.measurement.traces[trace_];
    trace = traces_.trace(number);
    return trace != nullptr;
  }
  bool read_metric(const std::string& name) {
    run_.measurement.metrics.push_back(find_metric(name));
    return run_.measurement.metrics.back() != nullptr;
  }
  bool read_signal(bool second, const std::string& value) {
    auto& signals = run_.measurement.signals;
    if (!second)
      signals.push_back({find_signal(value), false});
    else if (!signals.empty())
      signals.back().logarithmic = value == "log";
    return !signals.empty() && signals.back().signal != nullptr;
  }

  RunRequest& run_;
  const TraceListReader& traces_;
  std::string parameter_, trace_;
  std::vector<std::vector<std::string>> own_;
};

}  // namespace

std::string run_list_text(const RunList& list) {
  output::JsonWriter json;
  const WrittenTraces traces(list);
  json.begin_object().member("allow_plugins", list.allow_plugins);
  traces.write(json);
  json.key("runs").begin_array();
  for (const RunRequest& run : list.runs) write_run(json, run, traces);
  json.end_array().end_object();
  return json.text();
}

RunList read_run_list(const std::filesystem::path& file) {
  const auto text = output::read_file(file);
  if (!text) throw RunListError("cannot read " + file.string());
  const auto leaves = output::json_leaves(*text);
  const auto refuse = [&](const std::string& why) {
    throw RunListError(file.string() + " is no list of runs of this hookpoint: " + why);
  };
  if (!leaves) refuse("it is not JSON");
  RunList list;
  std::string place;
  TraceListReader traces;
  std::unique_ptr<RunReader> reader;
  for (const auto& [key, value] : *leaves) {
    if (key == "allow_plugins") {
      list.allow_plugins = value == "true";
      continue;
    }
    if (key.starts_with(measured_key)) {
      if (!traces.read(key, value)) refuse("`" + key + "` is " + value);
      continue;
    }
    const std::size_t dot = key.find('.');
    if (!key.starts_with(runs_key) || dot == std::string::npos) refuse("`" + key + "`");
    if (place != key.substr(0, dot)) {
      if (reader && !reader->finish()) refuse("a metric of " + list.runs.back().name);
      place = key.substr(0, dot);
      reader = std::make_unique<RunReader>(list.runs.emplace_back(), traces);
    }
    if (!reader->read(std::string_view(key).substr(dot + 1), value))
      refuse("`" + key + "` is " + value);
  }
  if (reader && !reader->finish()) refuse("a metric of " + list.runs.back().name);
  return list;
}

}  // namespace hookpoint::studies
