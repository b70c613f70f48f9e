// What the elements and attributes of a robot's file, URDF, MJCF or SDF, say, every mistake at its place.
#pragma once

#include <initializer_list>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "language/report.h"
#include "language/source.h"
#include "math/vector3.h"

namespace hookpoint::simulation {

/// The side on which a number lies beyond all that are read, infinity too.
enum class Beyond { no, below, above };
/// Of what stands in a text; `no` where that is no number.
Beyond beyond_numbers(const std::string& text);

class UrdfXml {
 public:
  UrdfXml(const language::SourceFile& file, language::Report& report)
      : file_(file), report_(report) {}

  /// The document's element, which has one of these names; none after an error. `format`: what such
  /// a file is.
  pugi::xml_node open(std::initializer_list<std::string_view> names, const char* format);
  /// The only child of that name, or none; a second is an error.
  pugi::xml_node only(const pugi::xml_node& parent, const char* name);
  /// The attribute `name`, which must be there.
  std::string name_of(const pugi::xml_node& node);
  /// A number, `otherwise` where it is not given; 0 after an error.
  double number(const pugi::xml_node& node, const char* attribute, std::optional<double> otherwise);
  double not_negative(const pugi::xml_node& node, const char* attribute);
  /// What stands in an element, comments and blanks at the ends left out.
  static std::string text_in(const pugi::xml_node& node);
  /// The number that stands in an element; 0 after an error.
  double content(const pugi::xml_node& node);
  /// The numbers that stand in an element, none after an error; more than `most` are an error.
  std::vector<double> content_numbers(const pugi::xml_node& node, std::size_t most);
  /// A number above 0 that bounds something, as a text states it; nothing where that bounds nothing:
  /// not above 0, infinite, or beyond all numbers.
  std::optional<double> bound(const std::string& text, const language::Position& at);
  /// The stop of a joint on the side `side`, as a text states it; nothing where it lies beyond all
  /// numbers on that side: no stop.
  std::optional<double> stop(const std::string& text, Beyond side, const language::Position& at);
  /// A constant of a surface as a text states it, `name` in messages: not negative, and the largest
  /// number where it is beyond all (Gazebo's own kp is 1e13, friction without end is inf).
  double surface_constant(const std::string& text, const std::string& name,
                          const language::Position& at);
  /// Three numbers, `otherwise` where they are not given or after an error.
  Vector3d vector(const pugi::xml_node& node, const char* attribute, const Vector3d& otherwise);

  /// The numbers of an attribute, none where it is not given or after an error; more than `most` are
  /// an error.
  std::vector<double> numbers(const pugi::xml_node& node, const char* attribute, std::size_t most);

  /// Of an element's name; of its attribute, if it is given.
  language::Position place(const pugi::xml_node& node) const;
  language::Position place(const pugi::xml_node& node, std::string_view attribute) const;
  /// False, for the caller to return.
  bool fail(const language::Position& at, std::string message) {
    report_.error(at, std::move(message));
    ++errors_;
    return false;
  }
  void note(const language::Position& at, std::string message) {
    report_.note(at, std::move(message));
  }
  /// No error so far.
  bool good() const { return errors_ == 0; }
  std::size_t errors() const { return errors_; }
  /// So many errors that nobody reads more.
  bool full() const { return report_.full(); }

 private:
  std::optional<double> parse(std::string_view text, const language::Position& at);
  std::vector<double> parse_all(std::string_view text, const language::Position& at,
                                std::string_view what, std::size_t most);

  const language::SourceFile& file_;
  language::Report& report_;
  pugi::xml_document document_;
  std::size_t errors_ = 0;
};

/// An element, and the file that it stands in.
struct XmlElement {
  pugi::xml_node node;
  UrdfXml* file = nullptr;

  std::string_view tag() const { return node.name(); }
  language::Position place() const { return file->place(node); }
  language::Position place(std::string_view attribute) const {
    return file->place(node, attribute);
  }
  std::string text(const char* attribute) const { return node.attribute(attribute).value(); }
};

}  // namespace hookpoint::simulation
