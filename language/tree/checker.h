// What can only be checked when the whole tree is there: required fields, references, wires,
// overrides.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include "language/syntax/files.h"
#include "language/tree/evaluate_options.h"
#include "language/tree/hints.h"
#include "language/tree/prepared.h"
#include "language/tree/references.h"

namespace hookpoint::language {

class Checker {
 public:
  using LeftOut = std::set<std::string, std::less<>>;

  /// `left_out`: names that are missing from the tree for an error already reported.
  /// `hints`: what may explain an error in a reference.
  Checker(const PreparedSchema& schema, FileStore& files, const LeftOut& left_out,
          const Hints& hints, Report& report)
      : schema_(schema), files_(files), left_out_(left_out), hints_(hints), report_(report) {}

  /// Sets a field from outside. `params`: the names of the file's Params, for a hint.
  void apply(Object& root, const Override& setting, const std::vector<std::string>& params);
  /// Checks the whole tree and fills in its references.
  void check(Object& root);

 private:
  void check_object(Object& object);
  void check_required(const Object& object);
  /// Values are in the unit that the object's choices require.
  void check_units(Object& object);
  void check_reference(const Object& object, Field& field);
  /// The error that `reference` leads nowhere, unless what it speaks of was left out.
  void report_unresolved(const Reference& reference, const Unresolved& why);

  // wires.cpp
  struct End {
    Target target;
    Position position;
    Dimension dimension;
  };
  void check_wire(Object& object, Wire& wire);
  std::optional<End> check_end(const Object& object, std::optional<Reference>& reference,
                               const Wire& wire, bool from);
  bool use_default_port(Target& target, bool from) const;
  void check_agreement(const End& from, const End& to, const Wire& wire);
  void check_noise(const End& from, const Wire& wire);
  void claim_input(const End& to, const Wire& wire);

  const PreparedSchema& schema_;
  FileStore& files_;
  const LeftOut& left_out_;
  const Hints& hints_;
  Report& report_;
  Names names_;
  /// Where each input (object, field, part) was first wired.
  std::map<std::tuple<const Object*, const FieldSchema*, int>, Position> wired_;
};

}  // namespace hookpoint::language
