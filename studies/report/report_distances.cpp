#include "studies/report/report_distances.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "studies/report/report_page.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

/// Smaller distances are rounding and have the palest colour [m].
constexpr double least_coloured = 1e-12;

using Matrix = std::vector<std::optional<double>>;

/// Subjects x subjects: of each pair the largest distance over the swept values.
Matrix largest(const StudyResult& study) {
  Matrix matrix(study.subjects.size() * study.subjects.size());
  for (const PeerDistances& one : study.peer_distances)
    for (std::size_t cell = 0; cell < matrix.size(); ++cell)
      if (one.distances[cell])
        matrix[cell] = std::max(matrix[cell].value_or(0.), *one.distances[cell]);
  return matrix;
}

/// The unit of the table's numbers and the range of its colours.
struct Scale {
  double least, greatest;  ///< distances of the palest and the darkest colour [m]
  std::string unit;
  double factor;  ///< from metres to `unit`
};

Scale scale_of(const Matrix& matrix) {
  double least = std::numeric_limits<double>::infinity(), greatest = least_coloured;
  for (const auto& distance : matrix) {
    if (!distance || !(*distance > least_coloured)) continue;
    least = std::min(least, *distance);
    greatest = std::max(greatest, *distance);
  }
  if (greatest >= 1.) return {least, greatest, "m", 1.};
  return greatest >= 1e-3 ? Scale{least, greatest, "mm", 1e3} : Scale{least, greatest, "um", 1e6};
}

/// How far along the range of colours a distance lies, 0 to 1, by its logarithm.
double color_share(double distance, const Scale& scale) {
  if (!(distance > scale.least)) return 0.;
  return std::log(distance / scale.least) / std::log(scale.greatest / scale.least);
}

std::string cell(const std::optional<double>& distance, const Scale& scale,
                 const std::string& pair) {
  if (!distance) return "<td class=\"soft\">–</td>";
  return fmt::format("<td style=\"background:rgba(214,96,30,{:.2f})\" title=\"{}\">{}</td>",
                     0.05 + 0.7 * color_share(*distance, scale), html(pair),
                     text::rounded(scale.factor * *distance, 2));
}

}  // namespace

std::string distance_table(const StudyResult& study) {
  if (study.peer_distances.empty()) return "";
  const Matrix matrix = largest(study);
  const std::size_t subjects = study.subjects.size();
  const Scale scale = scale_of(matrix);
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < subjects; ++i)
    if (matrix[i * subjects + i]) shown.push_back(i);
  std::string head = "<tr><th class=\"text\">subject</th>", rows;
  for (std::size_t line = 0; line < shown.size(); ++line) {
    const std::string& name = study.subjects[shown[line]].name;
    head += fmt::format("<th title=\"{}\">{}</th>", html(name), line + 1);
    rows += fmt::format("<tr><th scope=\"row\">{} {}</th>", line + 1, html(name));
    for (const std::size_t column : shown)
      rows += column == shown[line] ? "<td></td>"
                                    : cell(matrix[shown[line] * subjects + column], scale,
                                           name + ", " + study.subjects[column].name);
    rows += "</tr>\n";
  }
  return "<h2 id=\"distances\">Distances between subjects</h2>\n"
         "<p class=\"note soft\">Greatest distance of the body's origin, in " +
         scale.unit +
         ", between two subjects at equal swept values, the largest over these; the darker, by "
         "decades, the farther. Columns are numbered as rows. Each pair at each value: "
         "<a href=\"peer_distance.csv\">peer_distance.csv</a>.</p>\n"
         "<div class=\"scroll\" tabindex=\"0\"><table class=\"summary distances\"><thead>" +
         head + "</tr></thead><tbody>\n" + rows + "</tbody></table></div>\n";
}

}  // namespace hookpoint::studies
