// An MJCF file and those that it includes, as one document; its default classes; the attributes of
// an element with what its class gives them.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "language/syntax/files.h"
#include "simulation/experiment/kinematics.h"
#include "simulation/scene/urdf/xml.h"

namespace hookpoint::simulation {

/// An element, and the file that it stands in.
struct MjcfElement {
  pugi::xml_node node;
  UrdfXml* file = nullptr;

  std::string_view tag() const { return node.name(); }
  language::Position place() const { return file->place(node); }
  language::Position place(std::string_view attribute) const {
    return file->place(node, attribute);
  }
  std::string text(const char* attribute) const { return node.attribute(attribute).value(); }
};

class MjcfDocument;

/// An element's attributes: its own before those of its class, these before the class's that holds
/// it.
class MjcfAttributes {
 public:
  MjcfAttributes(MjcfElement own, std::vector<MjcfElement> defaults)
      : own_(own), defaults_(std::move(defaults)) {}

  const MjcfElement& own() const { return own_; }
  bool has(const char* attribute) const { return find(attribute) != nullptr; }
  /// "" where nothing gives it.
  std::string word(const char* attribute) const;
  double number(const char* attribute, double otherwise) const;
  /// As many numbers as `otherwise` has, which stand for those that nothing gives: an attribute may
  /// give the first ones alone.
  std::vector<double> numbers(const char* attribute, std::vector<double> otherwise) const;
  Vector3d vector(const char* attribute, const Vector3d& otherwise) const;
  /// `true`, `false`, or neither: `otherwise`.
  bool boolean(const char* attribute, bool otherwise) const;
  /// Where it is given, otherwise the element.
  language::Position place(const char* attribute) const;
  bool fail(const char* attribute, const std::string& message) const;

 private:
  const MjcfElement* find(const char* attribute) const;

  MjcfElement own_;
  std::vector<MjcfElement> defaults_;  ///< innermost class first
};

/// What <compiler> says of the rest.
struct MjcfCompiler {
  bool degrees = true, autolimits = true, balance_inertia = false;
  std::string euler_sequence = "xyz";
  std::string mesh_folder;
  enum class FromGeoms { no, where_missing, always } inertia_from_geoms = FromGeoms::where_missing;
  double least_mass = 0., least_inertia = 0., total_mass = 0.;  ///< total: 0 for none
  double first_group = 0., last_group = 5.;                     ///< of geoms that have mass
};

class MjcfDocument {
 public:
  MjcfDocument(const language::SourceFile& file, language::FileStore& files,
               language::Report& report);

  /// False after an error.
  bool open();
  bool good() const;
  const MjcfElement& root() const { return root_; }
  /// The elements in another, those of included files in their places.
  std::vector<MjcfElement> children(const MjcfElement& of);
  /// All elements in the sections of that name.
  std::vector<MjcfElement> in_sections(std::string_view section);
  /// `childclass`: the class that holds the element, "" for the outermost.
  MjcfAttributes attributes(const MjcfElement& element, const std::string& childclass);
  /// The frame of an element in that which it stands in.
  Pose pose(const MjcfAttributes& element);
  Quaterniond orientation(const MjcfAttributes& element);
  const MjcfCompiler& compiler() const { return compiler_; }
  /// An angle as the file writes it [rad].
  double angle(double written) const;
  const language::SourceFile& main_file() const { return file_; }

 private:
  struct DefaultClass {
    std::string outer;  ///< "" for the outermost
    std::vector<MjcfElement> elements;
  };
  MjcfElement open_included(const MjcfElement& include);
  void read_defaults(const MjcfElement& section, const std::string& outer, bool outermost);
  void read_compiler();

  const language::SourceFile& file_;
  language::FileStore& files_;
  language::Report& report_;
  std::vector<std::unique_ptr<UrdfXml>> open_files_;
  std::map<const UrdfXml*, const language::SourceFile*> sources_;
  std::map<std::pair<const UrdfXml*, std::ptrdiff_t>, MjcfElement> included_;
  std::set<std::string> paths_;
  std::map<std::string, DefaultClass> classes_;
  MjcfElement root_;
  MjcfCompiler compiler_;
};

}  // namespace hookpoint::simulation
