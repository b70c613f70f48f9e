#include "studies/report/publication.h"

#include <algorithm>

#include "output/figures/pdf.h"

namespace hookpoint::studies {
namespace {

/// Writes the tables, and returns the names of their files.
std::vector<std::string> write_tables(output::ResultFolder& folder,
                                      std::vector<output::LatexTable> tables,
                                      const std::string& origin) {
  std::vector<std::string> names;
  for (auto first = tables.begin(); first != tables.end();) {
    const auto end = std::find_if(first, tables.end(), [&](const output::LatexTable& table) {
      return table.name != first->name;
    });
    const std::string name = first->name;
    std::string text;
    for (; first != end; ++first) {
      first->caption += " " + origin;
      text += output::latex_table(*first);
    }
    if (text.empty()) continue;
    folder.write(name + ".tex", text);
    names.push_back(name);
  }
  return names;
}

}  // namespace

std::vector<std::string> write_publication(output::ResultFolder& folder, Publication publication,
                                           const PublicationForms& forms) {
  std::vector<std::string> problems, names;
  if (forms.latex) names = write_tables(folder, std::move(publication.tables), publication.origin);
  for (const ReportFigure& figure : publication.figures) {
    if (figure.svg.empty()) continue;  // the report says why
    std::string problem = output::draw_pdf(figure.name, folder.path());
    if (!problem.empty()) {
      problems.push_back(std::move(problem));
    } else if (forms.latex) {
      folder.write(figure.name + ".tex",
                   output::latex_figure(figure.name, figure.caption + " " + publication.origin));
      names.push_back(figure.name);
    }
  }
  if (forms.latex)
    folder.write(std::string(output::latex_document_name) + ".tex",
                 output::latex_document(publication.title, names));
  folder.finish();
  return problems;
}

}  // namespace hookpoint::studies
