#include "studies/run/provenance.h"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <set>
#include <thread>

#include "output/files/hash.h"
#include "text/json.h"

namespace hookpoint::studies {
namespace {

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text.data();
}

}  // namespace

namespace {

/// "dts, ode": of the subjects that run on this machine, each word once.
std::string words_of(const StudyPlan& plan, std::string SubjectInfo::*word) {
  std::vector<SubjectInfo> subjects = plan.compositions;
  for (const SubjectPlan& subject : plan.subjects) subjects.push_back(subject.info);
  std::set<std::string> words;
  for (const SubjectInfo& subject : subjects)
    if (subject.available && !(subject.*word).empty()) words.insert(subject.*word);
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace

output::Manifest manifest_of(const StudyPlan& plan) {
  return {plan.hash,
          {{"engines", words_of(plan, &SubjectInfo::engine)},
           {"laws", words_of(plan, &SubjectInfo::law)}},
          {},
          {}};
}

Provenance make_provenance(const StudyPlan& plan, const EngineTable& engines) {
  utsname host{};
  uname(&host);
  Provenance provenance;
  provenance.study = plan.name;
  provenance.file = plan.file;
  provenance.hash = plan.hash;
  provenance.quick = plan.quick;
  provenance.hookpoint = HOOKPOINT_VERSION;
  provenance.program = output::hash_of_program();
  provenance.compiler = HOOKPOINT_FLAGS;
  provenance.inputs = plan.inputs;
  for (const auto& [name, entry] : engines) {
    // A program is not started for a study that has nothing to do with it.
    const auto is_of = [&](const SubjectInfo& info) { return info.engine == name; };
    const bool runs = std::ranges::any_of(plan.compositions, is_of) ||
                      std::ranges::any_of(plan.subjects, is_of, &SubjectPlan::info);
    if (runs || !entry.is_program) provenance.engines.emplace_back(name, entry.describe());
  }
  provenance.seeds.assign(plan.seeds.begin(), plan.seeds.end());
  provenance.host = host.nodename;
  provenance.system = fmt::format("{} {}", host.sysname, host.release);
  provenance.machine = host.machine;
  provenance.cores = std::thread::hardware_concurrency();
  provenance.date = utc_now();
  return provenance;
}

std::string provenance_json(const Provenance& provenance) {
  text::JsonWriter json;
  json.begin_object()
      .member("study", provenance.study)
      .member("file", provenance.file)
      .member("hash", provenance.hash)
      .member("quick", provenance.quick)
      .member("hookpoint", provenance.hookpoint)
      .member("program", provenance.program)
      .member("compiler", provenance.compiler);
  json.key("engines").begin_object();
  for (const auto& [name, engine] : provenance.engines) {
    json.key(name).begin_object().member("found", engine.found);
    json.member("version", engine.version).member("precision", engine.precision);
    if (!engine.program.empty()) json.member("program", engine.program);
    json.end_object();
  }
  json.end_object().key("inputs").begin_array();
  for (const output::InputFile& input : provenance.inputs)
    json.begin_object().member("path", input.path).member("hash", input.hash).end_object();
  json.end_array().key("seeds").begin_array();
  for (const std::uint64_t seed : provenance.seeds) json.value(seed);
  json.end_array().key("host").begin_object();
  json.member("name", provenance.host).member("system", provenance.system);
  json.member("machine", provenance.machine).member("cores", provenance.cores);
  json.end_object().member("date", provenance.date).end_object();
  return json.text();
}

std::string origin_words(const Provenance& provenance, const std::vector<SubjectInfo>& subjects) {
  constexpr std::size_t digits = 12;  // as in the folder's name
  std::string words = fmt::format("hookpoint {}, experiment {}", HOOKPOINT_VERSION,
                                  provenance.hash.substr(0, digits));
  std::string engines;
  for (const auto& [name, engine] : provenance.engines)
    if (name != "dts" && std::ranges::any_of(subjects, [&](const SubjectInfo& subject) {
          return subject.engine == name && subject.available;
        }))
      engines += (engines.empty() ? "; " : ", ") + name + " " + engine.version;
  return words + engines + (provenance.quick ? "; quick." : ".");
}

std::vector<std::pair<std::string, std::string>> provenance_lines(const Provenance& provenance) {
  std::vector<std::pair<std::string, std::string>> lines{
      {"study", provenance.study + " of " + provenance.file + (provenance.quick ? ", quick" : "")},
      {"hash of the experiment", provenance.hash},
      {"hookpoint", provenance.hookpoint},
      {"hash of the program", provenance.program},
      {"compiler", provenance.compiler}};
  for (const auto& [name, engine] : provenance.engines)
    lines.emplace_back(name, engine.found ? engine.version + ", " + engine.precision + " precision"
                                          : "not on this machine");
  lines.emplace_back("seeds", fmt::format("{}", fmt::join(provenance.seeds, ", ")));
  lines.emplace_back("host", fmt::format("{}: {}, {}, {} cores", provenance.host, provenance.system,
                                         provenance.machine, provenance.cores));
  lines.emplace_back("date", provenance.date);
  return lines;
}

}  // namespace hookpoint::studies
