#include "studies/report_distances.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "output/number.h"
#include "studies/report_page.h"

namespace hookpoint::studies {
namespace {

/// Below, rounding: the palest colour [m].
constexpr double least_coloured = 1e-12;

using Matrix = std::vector<std::optional<double>>;

/// The largest over the swept values, subjects x subjects.
Matrix largest(const StudyResult& study) {
  Matrix matrix(study.subjects.size() * study.subjects.size());
  for (const PeerDistances& one : study.peer_distances)
    for (std::size_t cell = 0; cell < matrix.size(); ++cell)
      if (one.distances[cell])
        matrix[cell] = std::max(matrix[cell].value_or(0.), *one.distances[cell]);
  return matrix;
}

/// Decades between what is least coloured and `greatest`, as a part from 0 to 1.
double heat(double distance, double greatest) {
  if (!(distance > least_coloured) || !(greatest > least_coloured)) return 0.;
  return std::log(distance / least_coloured) / std::log(greatest / least_coloured);
}

std::string cell(const std::optional<double>& distance, double greatest, const std::string& pair) {
  if (!distance) return "<td class=\"soft\">–</td>";
  return fmt::format("<td style=\"background:rgba(214,96,30,{:.2f})\" title=\"{}\">{}</td>",
                     0.6 * heat(*distance, greatest), html(pair), output::rounded(*distance, 2));
}

}  // namespace

std::string distance_table(const StudyResult& study) {
  if (study.peer_distances.empty()) return "";
  const Matrix matrix = largest(study);
  const std::size_t subjects = study.subjects.size();
  std::vector<std::size_t> shown;
  double greatest = 0.;
  for (std::size_t i = 0; i < subjects; ++i)
    if (matrix[i * subjects + i]) shown.push_back(i);
  for (const auto& distance : matrix) greatest = std::max(greatest, distance.value_or(0.));
  std::string head = "<tr><th class=\"text\">subject</th>", rows;
  for (std::size_t line = 0; line < shown.size(); ++line) {
    head +=
        fmt::format("<th title=\"{}\">{}</th>", html(study.subjects[shown[line]].name), line + 1);
    rows += fmt::format("<tr><th scope=\"row\">{} {}</th>", line + 1,
                        html(study.subjects[shown[line]].name));
    for (const std::size_t column : shown)
      rows += column == shown[line]
                  ? "<td></td>"
                  : cell(matrix[shown[line] * subjects + column], greatest,
                         study.subjects[shown[line]].name + ", " + study.subjects[column].name);
    rows += "</tr>\n";
  }
  return "<h2 id=\"distances\">Distances between subjects</h2>\n"
         "<p class=\"note soft\">Greatest distance of the body's origin, in m, between two "
         "subjects "
         "at equal swept values, the largest over these; the darker, by decades, the farther. "
         "Columns are numbered as rows. Each pair at each value: "
         "<a href=\"peer_distance.csv\">peer_distance.csv</a>.</p>\n"
         "<div class=\"scroll\" tabindex=\"0\"><table class=\"wide\"><thead>" +
         head + "</tr></thead><tbody>\n" + rows + "</tbody></table></div>\n";
}

}  // namespace hookpoint::studies
