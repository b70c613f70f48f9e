#include "simulation/scene/urdf/xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace hookpoint::simulation {
namespace {

using language::Position;

/// Only what links and joints need is read; a larger file is no robot's description.
constexpr std::size_t largest_file = 64UL << 20;
constexpr std::string_view blanks = " \t\r\n";
constexpr double largest_number = 1e12;  // squares and products of such numbers stay finite

}  // namespace

Beyond beyond_numbers(const std::string& text) {
  // As strtod has it, in whatever locale, but neither nan nor hexadecimal numbers.
  if (text.find_first_not_of("0123456789+-.eEinfINFtyTY \t\r\n") != std::string::npos)
    return Beyond::no;
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (std::string_view(end).find_first_not_of(blanks) != std::string_view::npos) return Beyond::no;
  if (value > largest_number) return Beyond::above;
  return value < -largest_number ? Beyond::below : Beyond::no;
}

pugi::xml_node UrdfXml::open(std::initializer_list<std::string_view> names, const char* format) {
  const std::string& text = file_.text;
  const Position start{&file_, 0, 1};
  if (text.size() > largest_file) {
    fail(start, fmt::format("the file is larger than {} MB", largest_file >> 20));
    return {};
  }
  const pugi::xml_parse_result parsed =
      document_.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
  if (!parsed) {
    const auto offset = std::min(static_cast<std::size_t>(parsed.offset), text.size());
    fail({&file_, offset, 1}, fmt::format("this is not XML: {}", parsed.description()));
    return {};
  }
  const pugi::xml_node root = document_.document_element();
  if (std::ranges::count(names, std::string_view(root.name())) > 0) return root;
  fail(root ? place(root) : start,
       fmt::format("this is no {}: expected <{}>", format, *names.begin()));
  return {};
}

pugi::xml_node UrdfXml::only(const pugi::xml_node& parent, const char* name) {
  const pugi::xml_node found = parent.child(name);
  if (const pugi::xml_node second = found.next_sibling(name))
    fail(place(second), fmt::format("a second <{}> in <{}>", name, parent.name()));
  return found;
}

std::string UrdfXml::name_of(const pugi::xml_node& node) {
  std::string name = node.attribute("name").value();
  if (name.empty()) fail(place(node), fmt::format("this <{}> has no name", node.name()));
  return name;
}

double UrdfXml::number(const pugi::xml_node& node, const char* attribute,
                       std::optional<double> otherwise) {
  const pugi::xml_attribute found = node.attribute(attribute);
  if (!found && otherwise) return *otherwise;
  if (!found) fail(place(node), fmt::format("<{}> lacks {}=\"...\"", node.name(), attribute));
  return found ? parse(found.value(), place(node, attribute)).value_or(0.) : 0.;
}

double UrdfXml::not_negative(const pugi::xml_node& node, const char* attribute) {
  const double value = number(node, attribute, {});
  if (value < 0.) fail(place(node, attribute), fmt::format("{} is not negative", attribute));
  return value;
}

std::string UrdfXml::text_in(const pugi::xml_node& node) {
  std::string text;
  for (const pugi::xml_node& part : node.children()) {
    if (part.type() == pugi::node_pcdata || part.type() == pugi::node_cdata)
      text += (text.empty() ? "" : " ") + std::string(part.value());
  }
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

double UrdfXml::content(const pugi::xml_node& node) {
  return parse(text_in(node), place(node)).value_or(0.);
}

std::optional<double> UrdfXml::bound(const std::string& text, const Position& at) {
  if (beyond_numbers(text) != Beyond::no) return std::nullopt;
  const double value = parse(text, at).value_or(0.);
  return value > 0. ? std::optional(value) : std::nullopt;
}

std::optional<double> UrdfXml::stop(const std::string& text, Beyond side, const Position& at) {
  if (beyond_numbers(text) == side) return std::nullopt;
  return parse(text, at).value_or(0.);
}

double UrdfXml::surface_constant(const std::string& text, const std::string& name,
                                 const Position& at) {
  if (beyond_numbers(text) == Beyond::above) return largest_number;
  const double value = parse(text, at).value_or(0.);
  if (value < 0.) fail(at, fmt::format("{} is not negative", name));
  return std::max(value, 0.);
}

std::vector<double> UrdfXml::numbers(const pugi::xml_node& node, const char* attribute,
                                     std::size_t most) {
  return parse_all(node.attribute(attribute).value(), place(node, attribute), attribute, most);
}

std::vector<double> UrdfXml::content_numbers(const pugi::xml_node& node, std::size_t most) {
  return parse_all(text_in(node), place(node), fmt::format("<{}>", node.name()), most);
}

std::vector<double> UrdfXml::parse_all(std::string_view text, const Position& at,
                                       std::string_view what, std::size_t most) {
  std::vector<double> numbers;
  for (std::size_t start = text.find_first_not_of(blanks); start != std::string_view::npos;
       start = text.find_first_not_of(blanks)) {
    text.remove_prefix(start);
    const std::string_view word = text.substr(0, text.find_first_of(blanks));
    const std::optional<double> value = parse(word, at);
    if (!value) return {};
    if (numbers.size() == most) {
      fail(at, fmt::format("{} takes {} number{}", what, most, most == 1 ? "" : "s at most"));
      return {};
    }
    numbers.push_back(*value);
    text.remove_prefix(word.size());
  }
  return numbers;
}

Vector3d UrdfXml::vector(const pugi::xml_node& node, const char* attribute,
                         const Vector3d& otherwise) {
  if (!node.attribute(attribute)) return otherwise;
  const std::size_t before = errors_;
  constexpr std::size_t enough = 1000;  // to count them
  const std::vector<double> read = numbers(node, attribute, enough);
  if (errors_ == before && read.size() != 3)
    fail(place(node, attribute), fmt::format("{} takes three numbers: \"x y z\"", attribute));
  return errors_ == before ? Vector3d{read[0], read[1], read[2]} : otherwise;
}

std::optional<double> UrdfXml::parse(std::string_view text, const Position& at) {
  constexpr std::size_t longest = 40;
  std::string_view digits = text;
  digits.remove_prefix(std::min(digits.find_first_not_of(blanks), digits.size()));
  digits = digits.substr(0, digits.find_last_not_of(blanks) + 1);
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double value = 0.;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool whole = error == std::errc() && end == digits.data() + digits.size();
  if (whole && std::fabs(value) <= largest_number) return value;
  fail(at, fmt::format(
               "`{}` is no number{}", text.substr(0, longest),
               whole ? fmt::format(" from {:g} to {:g}", -largest_number, largest_number) : ""));
  return std::nullopt;
}

Position UrdfXml::place(const pugi::xml_node& node) const {
  return {&file_, static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0)),
          std::max<std::size_t>(std::string_view(node.name()).size(), 1)};
}

Position UrdfXml::place(const pugi::xml_node& node, std::string_view attribute) const {
  const Position element = place(node);
  const std::string_view text = file_.text;
  const std::size_t end = std::min(text.find('>', element.offset), text.size());
  const std::string_view tag = text.substr(element.offset, end - element.offset);
  for (std::size_t at = tag.find(attribute); at != std::string_view::npos;
       at = tag.find(attribute, at + 1)) {
    const std::size_t after = tag.find_first_not_of(" \t\r\n", at + attribute.size());
    const bool apart = at > 0 && std::string_view(" \t\r\n").find(tag[at - 1]) != std::string::npos;
    if (apart && after != std::string_view::npos && tag[after] == '=')
      return {&file_, element.offset + at, attribute.size()};
  }
  return element;
}

}  // namespace hookpoint::simulation
