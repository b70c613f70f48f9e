// What a task leaves for a paper beside its report: tables as LaTeX, figures as PDF.
#pragma once

#include <string>
#include <vector>

#include "output/files/result_folder.h"
#include "output/latex/latex.h"
#include "studies/report/report.h"

namespace hookpoint::studies {

/// Which of them are requested.
struct PublicationForms {
  bool latex = false;  ///< tables and figures as LaTeX, the figures as PDF too
  bool pdf = false;    ///< figures as PDF
  bool any() const { return latex || pdf; }
};

struct Publication {
  std::string title;
  std::vector<output::LatexTable> tables;  ///< those of one name, one after the other, are a file
  std::vector<ReportFigure> figures;       ///< as the report has them
  std::string origin;  ///< the last sentence of every caption: versions and hash
};

/// Writes them into the folder, whose names hold theirs. What could not be drawn, a line each.
/// Throws output::FileError.
std::vector<std::string> write_publication(output::ResultFolder& folder, Publication publication,
                                           const PublicationForms& forms);

}  // namespace hookpoint::studies
