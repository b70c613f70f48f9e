#include "studies/results/matched_grounds.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "studies/results/selection.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

using simulation::MatchedConstant;
using simulation::MatchedMaterial;

/// Least and largest of what runs have.
struct Spread {
  double least = HUGE_VAL, largest = -HUGE_VAL;
  void add(double value) {
    least = std::min(least, value);
    largest = std::max(largest, value);
  }
  std::string text() const {
    const std::string low = text::rounded(least), high = text::rounded(largest);
    return low == high ? low : low + " … " + high;
  }
};

struct MatchedRuns {
  Spread load, speed, depth, stiffness, rebound;
  std::map<std::string, std::pair<Spread, Spread>> constants;  ///< own and chosen
  std::vector<MatchedConstant> order;

  void add(const MatchedMaterial& material) {
    load.add(material.under.load);
    speed.add(material.under.impact_speed);
    depth.add(material.depth);
    stiffness.add(material.stiffness);
    rebound.add(material.rebound);
    for (const MatchedConstant& constant : material.constants) {
      auto& [own, chosen] = constants[constant.name];
      if (!std::ranges::count(order, constant.name, &MatchedConstant::name))
        order.push_back(constant);
      own.add(constant.own);
      chosen.add(constant.chosen);
    }
  }
};

/// What is hookpoint's, then what is not and by how much.
std::string agreement(const MatchedRuns& gathered) {
  constexpr double alike = 1e-6;
  const bool lands = gathered.speed.largest > 0.;
  std::string same, other;
  const auto tell = [&](const std::string& what, const Spread& ratio) {
    const bool is_same = std::abs(ratio.least - 1.) < alike && std::abs(ratio.largest - 1.) < alike;
    std::string& list = is_same ? same : other;
    if (!list.empty()) list += ", ";
    list += is_same ? what : what + " " + ratio.text() + " times";
  };
  tell("depth", gathered.depth);
  tell("stiffness", gathered.stiffness);
  tell(lands ? "rebound" : "damping", gathered.rebound);
  if (same.empty() || other.empty()) return same + other;
  return same + "; " + other;
}

}  // namespace

std::vector<MatchedLine> matched_lines(const StudyResult& study) {
  std::map<std::pair<int, std::string>, MatchedRuns> by_subject;
  for (const MatchedRun& run : study.matched)
    for (const MatchedMaterial& material : run.materials)
      by_subject[{run.subject, material.name}].add(material);
  std::vector<MatchedLine> lines;
  for (const auto& [key, gathered] : by_subject) {
    MatchedLine line{study.subjects[static_cast<std::size_t>(key.first)].name,
                     key.second,
                     gathered.load.text() + " N a contact",
                     {},
                     agreement(gathered)};
    line.under += gathered.speed.largest > 0. ? " that lands at " + gathered.speed.text() + " m/s"
                                              : " at rest";
    for (const MatchedConstant& constant : gathered.order) {
      const auto& [own, chosen] = gathered.constants.at(constant.name);
      line.constants.push_back({constant.name, constant.unit, own.text(), chosen.text()});
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

std::string constants_text(const MatchedLine& line) {
  std::string text;
  for (const ChosenConstant& constant : line.constants) {
    text +=
        (text.empty() ? "" : ", ") + constant.name + " " + constant.own + " → " + constant.chosen;
    if (!constant.unit.empty()) text += " " + constant.unit;
  }
  return text.empty() ? "the file's own" : text;
}

output::CsvTable matched_table(const StudyResult& study) {
  output::CsvTable table;
  for (const SweepColumn& sweep : study.sweeps)
    table.header.push_back(output::column_title(sweep.name, sweep.unit));
  for (const char* name :
       {"subject", "material", "load [N]", "impact_speed [m/s]", "constant", "unit", "own",
        "chosen", "depth_ratio", "stiffness_ratio", "rebound_ratio"})
    table.header.emplace_back(name);
  for (const MatchedRun& run : study.matched)
    for (const MatchedMaterial& material : run.materials)
      for (const MatchedConstant& constant : material.constants) {
        std::vector<std::string>& row = table.rows.emplace_back();
        for (std::size_t i = 0; i < run.parameters.size(); ++i)
          row.push_back(exact_label_of(study.sweeps[i], run.parameters[i]));
        row.insert(row.end(),
                   {study.subjects[static_cast<std::size_t>(run.subject)].name, material.name,
                    text::shortest(material.under.load),
                    text::shortest(material.under.impact_speed), constant.name, constant.unit,
                    text::shortest(constant.own), text::shortest(constant.chosen)});
        for (const double ratio : {material.depth, material.stiffness, material.rebound})
          row.push_back(text::shortest(ratio));
      }
  return table;
}

}  // namespace hookpoint::studies
