// The lines of a gnuplot script that say what it draws into.
#pragma once

#include <string>

namespace hookpoint::output {

/// NAME.svg, of this size in pixels.
std::string svg_terminal(const std::string& name, double width, double height);

/// The script of NAME.svg as one of NAME.pdf: a pixel is 1/96 inch. "" where it has no such lines.
std::string with_pdf_terminal(const std::string& script, const std::string& name);

}  // namespace hookpoint::output
