// A column of a record.
#pragma once

#include <limits>
#include <string>

namespace hookpoint::output {

struct Channel {
  std::string path;             ///< trail: "simplebot.leg1.link1.angle"
  std::string unit;             ///< "rad"; "" for none
  std::string type = "double";  ///< or "bool" (0, 1), "int" (whole numbers)
  double minimum = -std::numeric_limits<double>::infinity();  ///< declared range, in `unit`
  double maximum = std::numeric_limits<double>::infinity();
  std::string doc;  ///< one line
};

}  // namespace hookpoint::output
