// The study of docs/papers/low_stiffness/page.md: its page is that of its summary, and its reduced size
// says what the page says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/command.h"
#include "tests/support/folders.h"

namespace hookpoint::testing {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

/// Largest `metric` of the rows of a results.csv with these values, by the titles of columns
/// without their units; a negative number if there is none.
double largest(const std::string& results, const std::string& metric,
               const std::map<std::string, std::string>& where) {
  std::istringstream in(results);
  std::string line;
  std::getline(in, line);
  std::vector<std::string> titles = cells_of(line);
  for (std::string& title : titles) title = title.substr(0, title.find(" ["));
  double found = -1.;
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = cells_of(line);
    bool wanted = true;
    std::string value;
    for (std::size_t i = 0; i < std::min(cells.size(), titles.size()); ++i) {
      const auto at = where.find(titles[i]);
      wanted = wanted && (at == where.end() || at->second == cells[i]);
      if (titles[i] == metric) value = cells[i];
    }
    if (wanted && !value.empty()) found = std::max(found, std::stod(value));
  }
  return found;
}

TEST(LowStiffness, ThePageIsThatOfItsSummaryAndOfItsPrediction) {
  const Workplace work;
  const std::string command = "'" + testing::source_folder() +
                              "/docs/papers/low_stiffness/make.py' --check >'" +
                              (work.folder() / "out").string() + "' 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << work.read("out");
}

TEST(LowStiffness, TripodsBounceOnSoftGroundAndFeetSlipLessOnHard) {
  const Workplace work;
  const auto run =
      work.hookpoint("study " + config("studies/low_stiffness.hook") + " --quick --out quick");
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  const std::string results = work.read("quick/results.csv");
  for (const std::string ground : {"1", "4"}) {
    const auto tripods = [&](const std::string& metric, const std::string& stiffness,
                             const std::string& subject) {
      return largest(
          results, metric,
          {{"cruse", "0"}, {"ground", ground}, {"stiffness", stiffness}, {"subject", subject}});
    };
    EXPECT_GT(tripods("hook_losses", "3", "hookpoint"), 1.5);
    EXPECT_LT(tripods("hook_losses", "95", "hookpoint"), 1.);
    EXPECT_LT(tripods("hook_losses", "3", "nominal"), 1.);
    EXPECT_GT(tripods("stance_slip", "3", "hookpoint"),
              2. * tripods("stance_slip", "95", "hookpoint"));
    // What a step beyond the largest stable one makes of it.
    EXPECT_GT(tripods("stance_slip", "95", "fixed_step"),
              3. * tripods("stance_slip", "95", "hookpoint"));
  }
}

}  // namespace
}  // namespace hookpoint::testing
