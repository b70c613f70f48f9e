#include "apps/shared/fixture.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "apps/shared/exported.h"
#include "apps/shared/subject_words.h"
#include "contact/force_law.h"
#include "output/files/file.h"
#include "output/files/result_folder.h"
#include "reference/process/experiment_json.h"
#include "simulation/run/expectation.h"
#include "studies/blocks/wall.h"
#include "text/json.h"

namespace hookpoint::application {
namespace {

using simulation::ExpectationSpec;
using simulation::Experiment;

constexpr const char* check_file = "check.py";

/// Fields of a Subject, in the language.
std::string subject_block(const std::vector<std::pair<std::string, std::string>>& fields) {
  std::string name, text;
  for (const auto& [field, word] : fields) {
    if (field != "engine" || word != "dts") name += (name.empty() ? "" : "_") + word;
    text += fmt::format(" {} = {};", field, word);
  }
  return fmt::format("  Subject {} {{{} }}\n", name, text);
}

/// The words, and where they leave it open each law or each setting.
std::string subject_blocks(const Application& application, const std::string& words) {
  const auto fields = subject_fields(application.schema(), words, "subject");
  const auto given = [&](std::string_view field) -> const std::string* {
    const auto found =
        std::ranges::find(fields, field, &std::pair<std::string, std::string>::first);
    return found == fields.end() ? nullptr : &found->second;
  };
  const std::string& engine = *given("engine");
  const bool ours = engine == "dts";
  const char* open = ours ? "contact" : "settings";
  if (given(open) != nullptr) return subject_block(fields);
  const std::vector<std::string> choices =
      ours ? contact::law_names() : application.engines().at(engine).describe().settings;
  if (choices.empty()) return subject_block(fields);  // an engine that is not found
  std::string text;
  for (const std::string& choice : choices) {
    auto chosen = fields;
    chosen.emplace_back(open, choice);
    text += subject_block(chosen);
  }
  return text;
}

/// Column of check.py's files that a port of a body is.
std::string column_of(const ExpectationSpec& spec) {
  static const std::map<std::string, std::string> columns{
      {"position.x", "x"},      {"position.y", "y"},       {"position.z", "z"},
      {"orientation.w", "qw"},  {"orientation.x", "qx"},   {"orientation.y", "qy"},
      {"orientation.z", "qz"},  {"contact.force.x", "fx"}, {"contact.force.y", "fy"},
      {"contact.force.z", "fz"}};
  for (const auto& [port, column] : columns)
    if (spec.trail.ends_with("." + port)) return column;
  throw simulation::ExperimentError(fmt::format(
      "Expect {}: a phenomenon of the fixture is measured of the first body's position, orientation or "
      "contact.force",
      spec.name));
}

std::string text_of(const std::filesystem::path& file) {
  auto text = output::read_file(file);
  if (!text) throw output::FileError("cannot read " + file.string());
  return std::move(*text);
}

/// The lines of comment that a file begins with.
std::string leading_comment(const std::string& text) {
  std::string comment;
  std::size_t at = 0;
  while (text.compare(at, 3, "// ") == 0) {
    const std::size_t end = text.find('\n', at);
    comment += (comment.empty() ? "" : " ") + text.substr(at + 3, end - at - 3);
    if (end == std::string::npos) break;
    at = end + 1;
  }
  return comment;
}

/// A phenomenon as it is exported.
struct Phenomenon {
  std::string name, title, comment;
  std::filesystem::path file;
  Experiment experiment;
  const ExpectationSpec* spec = nullptr;  ///< of the experiment
  std::optional<double> accepted;
  std::string accepted_by;
};

std::string reduction_word(const ExpectationSpec& spec) {
  return simulation::reduction_names()[static_cast<std::size_t>(spec.reduction.take)];
}

std::string expected_json(const Phenomenon& phenomenon) {
  const ExpectationSpec& spec = *phenomenon.spec;
  text::JsonWriter json;
  json.begin_object();
  json.member("phenomenon", phenomenon.name).member("title", phenomenon.title);
  json.member("description", phenomenon.comment);
  json.member("value", spec.expected).member("unit", spec.unit);
  json.member("scale", spec.scale.value_or(std::abs(spec.expected)));
  json.member("tolerance", std::max(spec.within, spec.tolerance * std::abs(spec.expected)));
  json.member("source", spec.source);
  json.key("measure").begin_object();
  json.member("column", column_of(spec)).member("take", reduction_word(spec));
  json.member("from", spec.reduction.from);
  json.member("to", spec.reduction.to.value_or(phenomenon.experiment.duration));
  if (spec.reduction.level) json.member("level", *spec.reduction.level);
  json.member("deltat", phenomenon.experiment.deltat);
  json.end_object();
  if (phenomenon.accepted) {
    json.key("accepted").begin_object();
    json.member("error", *phenomenon.accepted).member("by", phenomenon.accepted_by).end_object();
  }
  return json.end_object().text();
}

/// What becomes of the column's values, for a reader.
std::string measure_text(const Phenomenon& phenomenon) {
  static const std::map<std::string, std::string> words{
      {"final", "the last value"},
      {"maximum", "the greatest value"},
      {"minimum", "the least value"},
      {"slope", "the slope of the least-squares line over time"},
      {"curvature", "the second derivative of the least-squares parabola over time"},
      {"time_at",
       "the time of the first crossing of the level, on the straight line between two rows"},
      {"integral", "the integral over time by the trapezoid rule"}};
  const ExpectationSpec& spec = *phenomenon.spec;
  std::string text = fmt::format("`{}`: {}, from {:g} s to {:g} s", column_of(spec),
                                 words.at(reduction_word(spec)), spec.reduction.from,
                                 spec.reduction.to.value_or(phenomenon.experiment.duration));
  if (spec.reduction.level) text += fmt::format("; level {:g}", *spec.reduction.level);
  return text;
}

std::string phenomenon_readme(const Phenomenon& phenomenon,
                              const std::vector<std::string>& left_out) {
  const ExpectationSpec& spec = *phenomenon.spec;
  const std::string unit = spec.unit.empty() ? "" : " " + spec.unit;
  std::string text = fmt::format(
      "# {0}: {1}\n\n{2}\n\n- step: {3:g} s, {4:g} s long\n- measured: {5}\n- closed form: {6:.10g}{7} "
      "({8})\n- scale of its error: {9:.6g}{7}\n\n",
      phenomenon.name, phenomenon.title, phenomenon.comment, phenomenon.experiment.deltat,
      phenomenon.experiment.duration, measure_text(phenomenon), spec.expected, unit, spec.source,
      spec.scale.value_or(std::abs(spec.expected)));
  if (phenomenon.accepted)
    text += fmt::format("{} accept an error of {:g}{}.\n\n", phenomenon.accepted_by,
                        *phenomenon.accepted, unit);
  text +=
      "`scene.json` has everything: bodies with mass and inertia, where they are and how they move at the "
      "start, the ground, what the contact is made of, gravity and the step. The other formats "
      "lack:\n\n";
  for (const std::string& line : left_out) text += "- " + line + "\n";
  return text;
}

std::string fixture_readme(const std::vector<Phenomenon>& phenomena) {
  std::string text =
      "# The neutral fixture\n\nScenes with closed forms, for any engine.\n\n1. Run the scene of each "
      "folder: `scene.json` (the experiment of hookpoint's engine protocol; SI units, quaternions w, x, "
      "y, z), or `scene.xml` (MJCF), `scene.urdf`, `scene.sdf`.\n2. Write `RESULTS/PHENOMENON.csv`: a "
      "row for the start and for every step with `time,x,y,z,qw,qx,qy,qz` of the first body, and "
      "`fx,fy,fz`, the force of the ground on it, for the touch-downs.\n3. `python3 check.py RESULTS` "
      "prints a score a phenomenon: log10 of the error over its scale. Several folders stand side by "
      "side.\n\nNobody has to have hookpoint for that. Who has: `hookpoint fixture run` does all of it "
      "for the engines at hand.\n\n| phenomenon | | closed form |\n|---|---|---|\n";
  for (const Phenomenon& phenomenon : phenomena)
    text += fmt::format("| [{0}]({0}/README.md) | {1} | {2} |\n", phenomenon.name, phenomenon.title,
                        phenomenon.spec->source);
  return text;
}

/// Those of the Wall's scenes; nothing after errors, which are reported.
std::optional<std::vector<Phenomenon>> load_phenomena(Application& application,
                                                      const language::Object& wall) {
  std::vector<Phenomenon> phenomena;
  for (const language::Object* block : wall.children_of("Scene")) {
    const studies::SceneBlock scene = studies::scene_block(*block);
    Phenomenon phenomenon;
    phenomenon.name = block->name;
    phenomenon.title = scene.title;
    phenomenon.file = application.find(studies::scene_file(*block));
    phenomenon.comment = leading_comment(text_of(phenomenon.file));
    if (scene.accepted != nullptr) phenomenon.accepted = scene.accepted->numbers[0];
    phenomenon.accepted_by = scene.accepted_by;
    auto experiment = application.load(phenomenon.file, {});
    if (!experiment) return std::nullopt;
    if (experiment->expectations.size() != 1)
      throw simulation::ExperimentError(
          fmt::format("{}: a phenomenon of the fixture has one Expect", phenomenon.name));
    phenomenon.experiment = std::move(*experiment);
    phenomena.push_back(std::move(phenomenon));
  }
  for (Phenomenon& phenomenon : phenomena)
    phenomenon.spec = &phenomenon.experiment.expectations.front();
  return phenomena;
}

}  // namespace

std::string fixture_wall(const Application& application, const std::vector<std::string>& subjects) {
  std::string text =
      "Wall fixture {\n  title = \"The neutral fixture\";\n  question = \"How near does each engine come "
      "to the closed form of each phenomenon?\";\n  score_card = true;\n  Include "
      "\"fixture/scenes.hook\";\n";
  if (!subjects.empty()) {
    for (const std::string& words : subjects) text += subject_blocks(application, words);
    return text + "}\n";
  }
  text += subject_blocks(application, "dts");
  for (const auto& [name, engine] : application.engines())
    if (name != "dts" && engine.describe().found) text += subject_blocks(application, name);
  return text + "}\n";
}

bool export_fixture(Application& application, const std::filesystem::path& folder) {
  const std::filesystem::path file = "fixture.hook";
  application.give(file, fixture_wall(application, {"hookpoint"}));
  const auto root = application.evaluate(file, {});
  if (!root) return false;
  const auto phenomena = load_phenomena(application, *root->children_of("Wall").front());
  if (!phenomena) return false;
  std::map<std::string, std::string> files;
  files[check_file] = text_of(application.find(std::string("fixture/") + check_file));
  files["README.md"] = fixture_readme(*phenomena);
  for (const Phenomenon& phenomenon : *phenomena) {
    const std::string place = phenomenon.name + "/";
    std::vector<std::string> left_out;
    for (const auto& [format, name] :
         std::array{std::pair{"mjcf", "scene.xml"}, std::pair{"urdf", "scene.urdf"},
                    std::pair{"sdf", "scene.sdf"}}) {
      ExportRequest request;
      request.file = phenomenon.file;
      request.format = format;
      const auto model = exported(application, request);
      if (!model) return false;
      files[place + name] = model->text;
      for (const std::string& what : model->left_out)
        left_out.push_back(fmt::format("{}: {}", name, what));
    }
    files[place + "scene.json"] = reference::experiment_json(phenomenon.experiment);
    files[place + "expected.json"] = expected_json(phenomenon);
    files[place + "README.md"] = phenomenon_readme(phenomenon, left_out);
  }
  std::vector<std::string> names;
  for (const auto& [name, text] : files) names.push_back(name);
  output::ResultFolder written(folder, {"fixture", {}, {}, {}}, names);
  for (const auto& [name, text] : files) written.write(name, text);
  written.finish();
  return true;
}

}  // namespace hookpoint::application
