#include "translation/report.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "text/json.h"
#include "text/number.h"

namespace hookpoint::translation {
namespace {

constexpr int digits = 4;

/// A length [m] or, with `per` "/s", a speed, in a unit that keeps its digits before the exponent.
std::string length_text(double value, const char* per = "") {
  constexpr std::array<std::pair<double, const char*>, 4> units{
      {{1., "m"}, {1e-3, "mm"}, {1e-6, "um"}, {1e-9, "nm"}}};
  for (const auto& [size, name] : units)
    if (std::abs(value) >= 0.1 * size)
      return fmt::format("{} {}{}", text::rounded(value / size, digits), name, per);
  return fmt::format("{} m{}", text::rounded(value, digits), per);
}

std::string predicted_text(const Behaviour& does) {
  std::string text;
  const auto add = [&](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  if (does.static_depth) add("depth " + length_text(*does.static_depth));
  if (does.creep) add("creep on 10 deg " + length_text(*does.creep, "/s"));
  if (does.rebound) add("rebound " + text::rounded(*does.rebound, 3) + " at 1 m/s");
  add(does.largest_stable_step
          ? "largest stable step " + text::rounded(*does.largest_stable_step, digits) + " s"
          : std::string("any step is stable"));
  if (!does.unknown.empty()) add("unknown: " + does.unknown);
  return text;
}

std::string desired_text(const DesiredContact& desired) {
  const auto number = [](double value) { return text::rounded(value, digits); };
  return fmt::format(
      "{} N/m and {} N s/m along the normal, {} N/m and {} N s/m along the ground, friction {}",
      number(desired.stiffness), number(desired.damping), number(desired.tangential_stiffness),
      number(desired.tangential_damping),
      desired.static_friction == desired.kinetic_friction
          ? number(desired.kinetic_friction)
          : number(desired.static_friction) + " and, sliding, " + number(desired.kinetic_friction));
}

const char* basis_text(Basis basis) {
  return basis == Basis::measured ? "measured" : "formula, not run";
}

std::string indented(const std::string& text, const std::string& by) {
  std::string result = by;
  for (const char c : text) {
    result += c;
    if (c == '\n') result += by;
  }
  return result + "\n";
}

/// Constants as a block of the language.
std::string material_block(const Answer& answer) {
  const DesiredContact& desired = answer.desired;
  std::string block = fmt::format("Material {} {{\n", answer.material);
  const auto field = [&](const char* name, double value, const char* unit) {
    block += fmt::format("  {} = {}{}{};\n", name, text::rounded(value, 6), *unit ? " " : "", unit);
  };
  field("normal_stiffness", desired.stiffness, "N/m");
  field("normal_damping", desired.damping, "N.s/m");
  field("tangential_stiffness", desired.tangential_stiffness, "N/m");
  field("tangential_damping", desired.tangential_damping, "N.s/m");
  field("static_friction", desired.static_friction, "");
  field("kinetic_friction", desired.kinetic_friction, "");
  return block + "}";
}

std::string heading(const Answer& answer) {
  std::string text = answer.material;
  if (answer.from) text += fmt::format(", read from {}", answer.from->target->title);
  if (!answer.law.empty()) text += fmt::format(" under law {}", answer.law);
  if (!answer.robot.empty()) text += fmt::format(", under robot {}", answer.robot);
  const Situation& at = answer.at;
  text += fmt::format(": {} N and {} kg on {}, step {} s\n", text::rounded(at.load, digits),
                      text::rounded(at.mass, digits),
                      at.contacts == 1. ? std::string("a contact")
                                        : fmt::format("each of {} contacts", at.contacts),
                      text::rounded(at.deltat, digits));
  return text;
}

void write_numbers(text::JsonWriter& json, const Value& value) {
  if (!value.word.empty()) {
    json.value(value.word);
  } else if (value.numbers.size() == 1) {
    json.value(value.numbers.front());
  } else {
    json.numbers(value.numbers);
  }
}

void write_optional(text::JsonWriter& json, const char* name, const std::optional<double>& value) {
  json.key(name);
  if (value) {
    json.value(*value);
  } else {
    json.null();
  }
}

void write_behaviour(text::JsonWriter& json, const Behaviour& does) {
  json.begin_object();
  write_optional(json, "static_depth", does.static_depth);
  write_optional(json, "creep_10deg", does.creep);
  write_optional(json, "rebound", does.rebound);
  write_optional(json, "largest_stable_step", does.largest_stable_step);
  json.member("friction_shape", does.friction_shape).member("unknown", does.unknown);
  json.end_object();
}

void write_translation(text::JsonWriter& json, const Translation& translation,
                       const Situation& at) {
  const Target& target = *translation.target;
  json.begin_object().member("engine", target.name).key("parameters").begin_object();
  for (const Parameter& row : translation.parameters.rows()) {
    json.key(row.name);
    write_numbers(json, translation.parameters.value(row.name));
  }
  json.end_object().member("snippet", target.snippet(translation.parameters, at));
  json.key("predicted");
  write_behaviour(json, translation.behaviour);
  json.member("basis", target.basis == Basis::measured ? "measured" : "formula");
  json.key("cannot").begin_array();
  for (const std::string& note : translation.cannot) json.value(note);
  json.end_array().member("source", target.source).end_object();
}

void write_answer(text::JsonWriter& json, const Answer& answer) {
  const Situation& at = answer.at;
  json.begin_object().member("material", answer.material);
  if (!answer.law.empty()) json.member("law", answer.law);
  if (!answer.robot.empty()) json.member("robot", answer.robot);
  json.member("load", at.load).member("mass", at.mass).member("contacts", at.contacts);
  json.member("effective_mass", at.row_mass()).member("inverse_weight", at.foot_inverse_weight());
  json.member("deltat", at.deltat).key("constants").begin_object();
  const DesiredContact& desired = answer.desired;
  json.member("normal_stiffness", desired.stiffness).member("normal_damping", desired.damping);
  json.member("tangential_stiffness", desired.tangential_stiffness);
  json.member("tangential_damping", desired.tangential_damping);
  json.member("static_friction", desired.static_friction);
  json.member("kinetic_friction", desired.kinetic_friction).end_object();
  if (answer.own) {
    json.key("predicted");
    write_behaviour(json, *answer.own);
  }
  if (answer.from) {
    json.key("from");
    write_translation(json, *answer.from, at);
    json.member("block", material_block(answer));
  }
  json.key("targets").begin_array();
  for (const Translation& translation : answer.targets) write_translation(json, translation, at);
  json.end_array().end_object();
}

std::string default_text(const Parameter& row) {
  return row.choices.empty() ? numbers_text(row.default_.numbers, ", ") : row.default_.word;
}

}  // namespace

std::string text_of(std::span<const Answer> answers) {
  std::string text;
  for (const Answer& answer : answers) {
    if (!text.empty()) text += "\n";
    text += heading(answer) + "  " + desired_text(answer.desired) + "\n";
    if (answer.own) text += "  hookpoint: " + predicted_text(*answer.own) + "\n";
    if (answer.from) {
      text += fmt::format("  {}: {} ({})\n", answer.from->target->title,
                          predicted_text(answer.from->behaviour),
                          basis_text(answer.from->target->basis));
      text += "\n" + indented(material_block(answer), "    ");
    }
    for (const Translation& translation : answer.targets) {
      const Target& target = *translation.target;
      text += fmt::format("\n{} ({})\n", target.title, basis_text(target.basis));
      text += indented(target.snippet(translation.parameters, answer.at), "    ");
      text += fmt::format("  predicted: {}; friction: {}\n", predicted_text(translation.behaviour),
                          translation.behaviour.friction_shape);
      for (const std::string& note : translation.cannot) text += "  note: " + note + "\n";
      text += fmt::format("  source: {}\n", target.source);
    }
  }
  return text;
}

std::string json_of(std::span<const Answer> answers) {
  text::JsonWriter json;
  if (answers.size() != 1) json.begin_array();
  for (const Answer& answer : answers) write_answer(json, answer);
  if (answers.size() != 1) json.end_array();
  return json.text();
}

std::string parameters_page() {
  std::string page =
      "# Contact parameters of engines\n\n"
      "What each parameter of a contact is in N/m, N s/m or m/s.\n"
      "`hookpoint translate` computes the numbers, both ways: [translate.md](translate.md).\n"
      "This page is written by `hookpoint translate --parameters`.\n";
  for (const Target* target : targets()) {
    page += fmt::format("\n## {}\n\nEngine `{}`, {}.\nSource: {}.\n\n", target->title, target->name,
                        target->basis == Basis::measured
                            ? "whose predictions are measured in the engine itself"
                            : "by formula, not run here",
                        target->source);
    page += "| parameter | unit | default | what it is |\n|---|---|---|---|\n";
    for (const Parameter& row : target->parameters)
      page += fmt::format("| `{}` | {} | {} | {} |\n", row.name, row.unit, default_text(row),
                          row.meaning);
  }
  return page;
}

}  // namespace hookpoint::translation
