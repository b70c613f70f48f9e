// An MJCF file and those that it includes, as one document; its default classes; the attributes of
// an element with what its class gives them.
#pragma once

#include <array>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "language/syntax/files.h"
#include "simulation/experiment/kinematics.h"
#include "simulation/scene/urdf/xml.h"

namespace hookpoint::simulation {

class MjcfDocument;

/// An element's attributes: its own before those of its class, these before the class's that holds
/// it.
class MjcfAttributes {
 public:
  MjcfAttributes(XmlElement own, std::vector<XmlElement> defaults)
      : own_(own), defaults_(std::move(defaults)) {}

  const XmlElement& own() const { return own_; }
  bool has(const char* attribute) const { return find(attribute) != nullptr; }
  /// The elements that give attributes, the weakest first, its own last.
  std::vector<XmlElement> levels() const;
  /// "" where nothing gives it.
  std::string word(const char* attribute) const;
  double number(const char* attribute, double otherwise) const;
  /// As many numbers as `otherwise` has, which stand for those that nothing gives: an attribute may
  /// give the first ones alone.
  std::vector<double> numbers(const char* attribute, std::vector<double> otherwise) const;
  Vector3d vector(const char* attribute, const Vector3d& otherwise) const;
  /// Both ends of a range, 0 where nothing gives them; infinite where the file has an infinity or a
  /// number beyond 1e12, which bounds nothing.
  std::array<double, 2> ends(const char* attribute) const;
  /// The notation of the orientation that counts, "" without one. One of the element itself goes
  /// before those of its classes, and `quat` counts where there is no other.
  std::string orientation() const;
  /// `true`, `false`, or neither: `otherwise`.
  bool boolean(const char* attribute, bool otherwise) const;
  /// Where it is given, otherwise the element.
  language::Position place(const char* attribute) const;
  bool fail(const char* attribute, const std::string& message) const;

 private:
  const XmlElement* find(const char* attribute) const;

  XmlElement own_;
  std::vector<XmlElement> defaults_;  ///< the strongest first: innermost class, latest in the file
};

/// What <compiler> says of the rest.
struct MjcfCompiler {
  bool degrees = true, autolimits = true, balance_inertia = false, strip_path = false;
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
  const XmlElement& root() const { return root_; }
  /// The elements in another, those of included files in their places.
  std::vector<XmlElement> children(const XmlElement& of);
  /// All elements in the sections of that name.
  std::vector<XmlElement> in_sections(std::string_view section);
  /// `childclass`: the class that holds the element, "" for the outermost.
  MjcfAttributes attributes(const XmlElement& element, const std::string& childclass);
  /// The frame of an element in that which it stands in.
  Pose pose(const MjcfAttributes& element);
  Quaterniond orientation(const MjcfAttributes& element);
  /// The ends of `range` where the attribute `limited`, or `autolimits`, says that they hold; nothing
  /// otherwise and after an error.
  std::optional<std::array<double, 2>> range(const MjcfAttributes& given, const char* range,
                                             const char* limited) const;
  const MjcfCompiler& compiler() const { return compiler_; }
  /// An angle as the file writes it [rad].
  double angle(double written) const;
  const language::SourceFile& main_file() const { return file_; }

 private:
  struct DefaultClass {
    static constexpr std::size_t all = std::numeric_limits<std::size_t>::max();
    std::string outer;  ///< "" for the outermost
    /// How many of the outer class's elements stood before this one, which has no others of it.
    std::size_t from_outer = all;
    std::vector<XmlElement> elements;
  };
  XmlElement open_included(const XmlElement& include);
  /// `depth`: of <default> in others, 0 for the outermost.
  void read_defaults(const XmlElement& section, const std::string& outer, std::size_t depth);
  DefaultClass* open_class(const XmlElement& section, const std::string& outer, std::size_t depth);
  /// Elements of a kind in the class and those that hold it, the strongest first.
  std::vector<XmlElement> defaults_of(const XmlElement& element, const std::string& name) const;
  void read_compiler();

  const language::SourceFile& file_;
  language::FileStore& files_;
  language::Report& report_;
  std::vector<std::unique_ptr<UrdfXml>> open_files_;
  std::map<const UrdfXml*, const language::SourceFile*> sources_;
  std::map<std::pair<const UrdfXml*, std::ptrdiff_t>, XmlElement> included_;
  std::set<std::string> paths_;
  std::map<std::string, DefaultClass> classes_;
  XmlElement root_;
  MjcfCompiler compiler_;
};

}  // namespace hookpoint::simulation
