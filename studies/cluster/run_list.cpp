#include "studies/cluster/run_list.h"

#include <charconv>
#include <string_view>
#include <utility>

#include "output/file.h"
#include "output/text/json.h"
#include "output/text/json_reader.h"

namespace hookpoint::studies {
namespace {

constexpr std::string_view runs_key = "runs[";

void write_pair(output::JsonWriter& json, const std::string& name, const std::string& value) {
  json.begin_array().value(name).value(value).end_array();
}

void write_parameters(output::JsonWriter& json, const char* key,
                      const std::map<std::string, std::string>& parameters) {
  json.key(key).begin_array();
  for (const auto& [name, value] : parameters) write_pair(json, name, value);
  json.end_array();
}

void write_run(output::JsonWriter& json, const RunRequest& run) {
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
  json.member("settle", run.measurement.settle).member("duration", run.measurement.duration);
  json.key("metrics").begin_array();
  for (const MetricDefinition* metric : run.measurement.metrics) json.value(metric->name);
  json.end_array().key("signals").begin_array();
  for (const RecordedSignal& recorded : run.measurement.signals)
    write_pair(json, std::string(recorded.signal->name), recorded.logarithmic ? "log" : "linear");
  json.end_array().member("path", run.measurement.path).end_object();
}

/// Reads the leaves of one run as they come.
class RunReader {
 public:
  explicit RunReader(RunRequest& run) : run_(run) {}

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
    else if (kind == "settle")
      return read_time(value, run_.measurement.settle);
    else if (kind == "duration")
      return read_time(value, run_.measurement.duration);
    else if (kind == "metrics")
      return read_metric(value);
    else if (kind == "signals")
      return read_signal(second, value);
    else if (kind == "path")
      run_.measurement.path = value == "true";
    else
      return false;
    return true;
  }

 private:
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
  static bool read_time(const std::string& text, double& time) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), time);
    return error == std::errc{} && end == text.data() + text.size();
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
  std::string parameter_;
};

}  // namespace

std::string run_list_text(const RunList& list) {
  output::JsonWriter json;
  json.begin_object().member("allow_plugins", list.allow_plugins).key("runs").begin_array();
  for (const RunRequest& run : list.runs) write_run(json, run);
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
  std::unique_ptr<RunReader> reader;
  for (const auto& [key, value] : *leaves) {
    if (key == "allow_plugins") {
      list.allow_plugins = value == "true";
      continue;
    }
    const std::size_t dot = key.find('.');
    if (!key.starts_with(runs_key) || dot == std::string::npos) refuse("`" + key + "`");
    if (place != key.substr(0, dot)) {
      place = key.substr(0, dot);
      reader = std::make_unique<RunReader>(list.runs.emplace_back());
    }
    if (!reader->read(std::string_view(key).substr(dot + 1), value))
      refuse("`" + key + "` is " + value);
  }
  return list;
}

}  // namespace hookpoint::studies
