// The same drawings as PDF, for papers.
#pragma once

#include <filesystem>
#include <string>

namespace hookpoint::output {

/// Draws NAME.pdf from what `draw` left in `folder`, NAME.gp and its data, with gnuplot's terminal
/// pdfcairo: the SVG's size and proportions, its fonts embedded, and no date, so that the same figure
/// gives the same bytes. Why it could not; "" when drawn. Throws FileError.
std::string draw_pdf(const std::string& name, const std::filesystem::path& folder);

}  // namespace hookpoint::output
