// What a class tells the language about itself, once: its fields and ports with type, unit, range,
// default and one line of documentation. Parsing, checking, `describe`, the manual, data
// annotations and plot labels all come from here.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hookpoint::language {

enum class FieldType {
  number,       ///< one quantity
  integer,      ///< a whole number
  boolean,      ///< true or false
  text,         ///< "a string"
  choice,       ///< a bare word out of `choices`
  numbers,      ///< min_count..max_count quantities of one unit: location = 0,0,.3
  orientation,  ///< quaternion w,x,y,z, or roll, pitch, yaw angles
  object,       ///< a reference to an object whose class starts with `refers_to`
  port,         ///< a reference to a port's trail: block.base.location.x
  words,        ///< one or more bare words or strings
  formula,      ///< an expression of names that get their values later: kept, not evaluated
};

/// Another unit of a field where another field of the object says so: metres instead of radians
/// where `joint = prismatic`.
struct OtherUnit {
  std::string field, word;  ///< the choice and its word that require it: "joint", "prismatic"
  std::string unit;         ///< SI unit as the language writes it
};

/// Which ends of a wire may be joined to the field.
enum class Direction { none, input, output, both };

struct FieldSchema {
  std::string name;
  FieldType type = FieldType::number;
  std::string unit;  ///< SI unit as the language writes it: "m/s", "N.m/rad"; "" is dimensionless;
                     ///< "?" any unit
  std::optional<OtherUnit> other_unit;  ///< of a number
  std::string
      default_text;  ///< in the language's own syntax; "" when there is no default (see `required`)
  std::string doc;   ///< one line
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool exclusive_minimum = false;  ///< value > minimum instead of >=
  bool exclusive_maximum = false;
  int min_count = 1, max_count = 1;  ///< of `numbers` and `words`
  bool or_words = false;  ///< of `number` and `numbers`: words or strings may stand in their place
  bool one_or_all = false;  ///< of `numbers`: `max_count`, or one that stands for all; none between
  std::vector<std::string> choices;  ///< of a choice; of a number, words that may stand for it
  std::string refers_to;  ///< class name or prefix ("Terrain") of `object`; several: "Base|Link";
                          ///< "" any class
  bool required = false;
  bool setting = true;  ///< may be assigned in a file; false: a port only
  Direction port = Direction::none;
};

/// The fields of a Wire. A component that speaks of its own wires has fields of the same names.
inline constexpr const char *wire_rate = "rate", *wire_delay = "delay", *wire_noise = "noise";

enum class Naming { optional, required, forbidden };

struct ClassSchema {
  std::string name;  ///< "Terrain.Slope"
  /// The class within which alone the name means this; elsewhere it may mean another: a Plot in a
  /// Study. "" where it means this everywhere.
  std::string only_in;
  std::string doc;                  ///< one line
  std::string origin;               ///< the plugin's file; "" when it is the program's own
  std::vector<FieldSchema> fields;  ///< fields and ports, in the order of the manual
  std::vector<std::string>
      children;            ///< classes that may stand inside; "Shape." allows the whole family
  bool top_level = false;  ///< may stand at the top of a file
  bool own_file = false;   ///< stands in a file of its own, which `print` includes in its place
  bool implicit = false;  ///< one stands at the top of every file without being written (Simulator)
  Naming naming = Naming::optional;
  /// The name says what the object is about (Measure creep_speed, Truth creep_speed): only two of
  /// the same class clash.
  bool names_a_subject = false;
  std::string default_name;  ///< what an unnamed one is called in a trail: "base" for Base.fixed;
                             ///< "" if none
  std::string default_input, default_output;  ///< the ports that a wire without an end means

  const FieldSchema* find(std::string_view field) const;
};

struct ForeignArguments;
struct ForeignObject;
struct SourceFile;
class FileStore;
class Report;
/// Reads a file that is not in the language (foreign.h): the objects that an Include of it with
/// these arguments creates. `files` says where others are looked up, and keeps what is read of
/// them. What is wrong goes to the report.
using ForeignReader = std::function<std::vector<ForeignObject>(
    const SourceFile& file, const ForeignArguments& arguments, FileStore& files, Report& report)>;

/// All classes. Every folder that owns objects of the language adds its own; the command joins
/// them.
class Schema {
 public:
  /// Holds the language's own classes: Wire (what a wire's block may say) and Group (what a named
  /// Include creates).
  Schema();
  void add(ClassSchema schema);
  const ClassSchema* find(std::string_view name) const;
  /// What the name means inside an object of the class `within`.
  const ClassSchema* find(std::string_view name, std::string_view within) const;
  /// By their names; "Plot in Study" is what Plot means there only.
  const std::map<std::string, ClassSchema, std::less<>>& classes() const { return classes_; }
  /// Files whose names end in `extension` (".urdf") are read by `reader`.
  void add_reader(std::string extension, ForeignReader reader);
  /// Null for files in the language itself.
  const ForeignReader* find_reader(const std::string& extension) const;

 private:
  std::map<std::string, ClassSchema, std::less<>> classes_;
  std::map<std::string, ForeignReader> readers_;
};

/// What is wrong with a schema itself, one line each: units and defaults that do not parse, names
/// of classes that do not exist. Empty for a good one; every program that builds a schema tests
/// this.
std::vector<std::string> schema_problems(const Schema& schema);

}  // namespace hookpoint::language
