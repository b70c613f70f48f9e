#include "output/figures/pdf.h"

#include "output/figures/plot.h"
#include "output/files/child.h"
#include "output/files/file.h"
#include "output/files/temporary_folder.h"

namespace hookpoint::output {
namespace {

/// The script with another terminal: a pixel of the SVG is 1/96 inch. "" where it draws no SVG.
std::string pdf_script(const std::string& script, const std::string& name) {
  const std::string key = "\nset terminal svg size ";
  const std::size_t begin = script.find(key);
  const std::size_t line_end = script.find('\n', begin == std::string::npos ? begin : begin + 1);
  if (line_end == std::string::npos) return "";
  const std::size_t output_end = script.find('\n', line_end + 1);
  const std::size_t width = begin + key.size(), comma = script.find(',', width);
  const std::size_t height = comma + 1, height_end = script.find(' ', height);
  return script.substr(0, begin) + "\nset terminal pdfcairo size " +
         script.substr(width, comma - width) + "./96," +
         script.substr(height, height_end - height) +
         "./96 enhanced font 'Helvetica,13' fontscale 0.7 linewidth 2\nset output " +
         gnuplot_quoted(name + ".pdf") + script.substr(output_end);
}

/// The date of drawing, which cairo writes as plain text, becomes a fixed one of the same length.
std::string without_date(std::string pdf) {
  const std::string key = "/CreationDate (D:";
  const std::size_t place = pdf.find(key);
  constexpr std::string_view fixed = "20000101000000";
  if (place != std::string::npos) pdf.replace(place + key.size(), fixed.size(), fixed);
  return pdf;
}

}  // namespace

std::string draw_pdf(const std::string& name, const std::filesystem::path& folder) {
  const std::string script = pdf_script(read_file(folder / (name + ".gp")).value_or(""), name);
  if (script.empty()) return "there is no drawing " + name + " to be made a PDF";
  const std::filesystem::path pdf = folder / (name + ".pdf");
  std::error_code ignored;
  std::filesystem::remove(pdf, ignored);  // an older drawing must not pass for this one
  const TemporaryFolder work("figure");
  const std::filesystem::path file = work.path() / "pdf.gp";
  write_file(file, script);
  const auto run = run_program("gnuplot", {"--default-settings", file.string()}, folder);
  if (!run)
    return "gnuplot is not installed (Debian: gnuplot-nox), so " + name + ".pdf was not drawn";
  const std::string drawing = run->status == 0 ? read_file(pdf).value_or("") : "";
  if (drawing.empty()) {
    std::filesystem::remove(pdf, ignored);
    return "gnuplot could not draw " + pdf.string() + ": " + run->output;
  }
  write_file(pdf, without_date(drawing));
  return "";
}

}  // namespace hookpoint::output
