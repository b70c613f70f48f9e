// The schema as a manual, and its numbers as text.
#pragma once

#include <string>

#include "language/schema/schema.h"

namespace hookpoint::language {

/// One class as a manual entry; `describe_all` is the index of all of them.
std::string describe(const ClassSchema& schema);
/// The same, with the classes that it may stand in.
std::string describe(const ClassSchema& schema, const Schema& all);
std::string describe_all(const Schema& schema);
/// All classes as a page of the manual, in Markdown.
std::string describe_markdown(const Schema& schema);

/// The shortest text that reads back to the same double.
std::string number_text(double value);
/// The values that a numeric field takes, as a user reads them: "greater than 0 kg", "from 0 to 1", ""
/// when any.
std::string range_text(const FieldSchema& field);
/// " kg", what follows the numbers of a range: nothing where no one unit does.
std::string unit_after(const FieldSchema& field);

}  // namespace hookpoint::language
