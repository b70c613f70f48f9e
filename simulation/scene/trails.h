// The names by which a run knows the objects of its file. There is one naming: ports, records,
// wires and windows go by it.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "language/diagnostics.h"
#include "language/tree/object.h"
#include "language/tree/references.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// Every object's trail from the top, no two alike.
using ObjectTrails = std::map<const language::Object*, std::string>;

/// An object without a name goes by its type; what stands in two objects without a name may be
/// called alike: #2, #3 ... tell them apart, in file order.
ObjectTrails trails_of(const language::Object& root);

/// Why a run of the experiment has no such port though the class has it; "" when it has.
std::string missing_port(const Experiment& experiment, const language::Object& object,
                         const language::FieldSchema& field);

/// Whether a field holds a number, or several.
bool is_number(const language::FieldSchema& field);
/// How many numbers a field holds as ports: 4 of an orientation, the most that a list may have.
int components_of(const language::FieldSchema& field);

/// A number of a run that a trail of the file names.
struct NumberPort {
  language::Target target;
  std::string trail;  ///< of its port, from the top
};
/// The number that `trail`, written at `place`, names from `from`; none after saying what is wrong.
std::optional<NumberPort> find_number(const language::Object& from, const std::string& trail,
                                      const language::Position& place, language::Names& names,
                                      const ObjectTrails& trails, const Experiment& experiment,
                                      language::Diagnostics& diagnostics);

}  // namespace hookpoint::simulation
