// report.html: the study as one self-contained page, for the screen (light and dark) and for paper.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "studies/results/result.h"

namespace hookpoint::studies {

/// One setting of a peer as it was run.
struct PeerSetting {
  std::string engine;    ///< "ode"
  std::string settings;  ///< "recommended"
  std::string name;      ///< "contact softness (CFM)"
  std::string value;     ///< "1e-10"
  std::string source;    ///< whose advice it is, "" when it is the library's own default
};

/// What the page says beside the results.
struct ReportContext {
  std::string command;             ///< how to rerun: "hookpoint study configs/studies/creep.hook"
  std::vector<PeerSetting> peers;  ///< in the order to print
  /// Versions, flags, host, seeds, date: "ODE" -> "0.16.2, double". Only this part differs between
  /// two equal runs.
  std::vector<std::pair<std::string, std::string>> provenance;
  std::vector<std::string> files;  ///< of the folder, to link to: "results.csv"
};

/// A figure as the page takes it.
struct ReportFigure {
  std::string name;  ///< of its .svg and .csv beside the page
  std::string caption;
  std::string svg;      ///< the drawing; "" when it could not be drawn
  std::string message;  ///< why not
};

/// A figure's SVG as a page takes it, with its caption for who cannot see it.
std::string described_svg(const ReportFigure& figure);

/// The page. Pure: the same arguments give the same bytes.
std::string report_html(const StudyResult& study, const ReportContext& context,
                        const std::vector<ReportFigure>& figures);

/// What `write_report` could not do; the rest of the folder is written all the same.
struct ReportOutcome {
  std::vector<std::string> messages;  ///< a figure that was not drawn: exit status 3
  std::vector<ReportFigure> figures;  ///< as the page has them
};

/// Draws every Plot of the study into `folder` (`<plot>.svg`, `.csv`, `.gp`) and writes
/// `folder/report.html`. Throws output::FileError.
ReportOutcome write_report(const StudyResult& study, const ReportContext& context,
                           const std::filesystem::path& folder);

}  // namespace hookpoint::studies
