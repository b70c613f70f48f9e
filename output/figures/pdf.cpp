#include "output/figures/pdf.h"

#include "output/figures/plot.h"
#include "output/figures/terminal_lines.h"
#include "output/files/file.h"
#include "output/files/temporary_folder.h"

namespace hookpoint::output {
namespace {

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
  const std::string script =
      with_pdf_terminal(read_file(folder / (name + ".gp")).value_or(""), name);
  if (script.empty()) return "there is no drawing " + name + " to be made a PDF";
  const TemporaryFolder work("figure");
  const std::filesystem::path file = work.path() / "pdf.gp";
  write_file(file, script);
  GnuplotOutcome outcome = run_gnuplot(folder, file.string(), name + ".pdf");
  if (!outcome.drawing.empty())
    write_file(folder / (name + ".pdf"), without_date(std::move(outcome.drawing)));
  return outcome.message;
}

}  // namespace hookpoint::output
