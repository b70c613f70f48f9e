// The report and the terminal's table of a made-up study whose every number is known.
#include "studies/report.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

#include "studies/figures.h"
#include "studies/summary.h"
#include "studies/terminal_table.h"
#include "tests/support/synthetic_study.h"

namespace hookpoint::studies {
namespace {

namespace fs = std::filesystem;
using testing::synthetic_creep;
using testing::synthetic_study;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(Summary, CountsRunsAndVerdicts) {
  // 6 slopes x 3 steps x 6 subjects; subject 2 fails at 2 slopes x 3 steps, subject 4 stops at 6
  // slopes x 1 step.
  const StudySummary summary = summarise(synthetic_study());
  EXPECT_EQ(summary.total.rows(), 108);
  EXPECT_EQ(summary.total.stopped, 6);
  EXPECT_EQ(summary.total.skipped, 18);
  EXPECT_EQ(summary.passed, 18 + 18 + 12);
  EXPECT_EQ(summary.failed, 6 + 6);
  EXPECT_EQ(failures_of(synthetic_study()).size(), 12u);
}

TEST(Summary, TheWorstRunFailsRatherThanLiesFar) {
  const StudyResult study = synthetic_study();
  const MetricSummary creep = summarise(study).subjects[2].metrics[0];
  const RunResult& worst = study.rows[static_cast<std::size_t>(creep.worst)];
  EXPECT_EQ(worst.parameters[0], 30.);
  EXPECT_FALSE(*worst.metrics[0].ok);
  EXPECT_DOUBLE_EQ(creep.largest, 0.13 * synthetic_creep(30.));
}

TEST(Figures, KeepASubjectsStyleAndMarkWhatStopped) {
  const Figure figure = make_figure(synthetic_study(), 1);
  ASSERT_EQ(figure.plot.series.size(), 5u);  // the sixth is not installed
  for (int i = 0; i < 5; ++i) EXPECT_EQ(figure.plot.series[static_cast<std::size_t>(i)].style, i);
  EXPECT_EQ(figure.plot.series[4].unfinished.size(), 6u);
  EXPECT_EQ(figure.plot.series[4].measured.x, (std::vector{0.1, 1.}));
  EXPECT_TRUE(contains(figure.plot.subtitle, "largest over slope"));
  EXPECT_TRUE(contains(figure.caption, "Not on this machine: mujoco_matched."));
  EXPECT_DOUBLE_EQ(figure.plot.series[1].measured.y[0], 1.002 * synthetic_creep(30.));
}

TEST(Figures, LongCurvesKeepTheirEnvelope) {
  StudyResult study = synthetic_study();
  for (RunResult& row : study.rows) {
    if (row.traces[2].value.empty()) continue;
    row.traces[2].value[1234] = 7.;  // one sample among 2001
  }
  const Figure figure = make_figure(study, 2);
  const auto& y = figure.plot.series[1].measured.y;
  EXPECT_LE(y.size(), 802u);
  EXPECT_EQ(std::count(y.begin(), y.end(), 7.), 1);
  EXPECT_TRUE(std::is_sorted(figure.plot.series[1].measured.x.begin(),
                             figure.plot.series[1].measured.x.end()));
}

TEST(TerminalTable, FitsTheWidthAndNamesEverything) {
  const std::string table = terminal_table(synthetic_study());
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 120u) << line;
  for (const char* word : {"dts_hookpoint", "creep_speed [m/s]", "pass 18/18", "FAIL 12/18",
                           "skipped", "48 of 60 verdicts hold"})
    EXPECT_TRUE(contains(table, word)) << word;
  EXPECT_FALSE(contains(table, "\033"));
}

TEST(TerminalTable, NarrowTerminalsGetMetricsBelowOneAnother) {
  const std::string table = terminal_table(synthetic_study(), {.color = false, .width = 80});
  EXPECT_EQ(count(table, "ode_quickstep_recommended  "), 2u);
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
}

TEST(Report, SaysWhatHappened) {
  ReportContext context;
  context.command = "hookpoint study configs/studies/creep.hook";
  context.peers = {{"ode", "recommended", "CFM", "1e-10", "its manual"}};
  context.provenance = {{"ODE", "0.16.2, double"}};
  const StudyResult study = synthetic_study();
  const std::string page = report_html(
      study, context, {{"creep_by_slope", "A caption", "", "gnuplot is not installed"}});
  for (const std::string& part :
       {study.question, context.command, std::string("12 of 60 verdicts do not hold"),
        std::string("creep_speed equals predicted within 1 %"),
        std::string("reduce deltat &lt;or&gt; damping"), std::string("skipped: engine mujoco"),
        std::string("its manual"), std::string("0.16.2, double"),
        std::string("gnuplot is not installed")})
    EXPECT_TRUE(contains(page, part)) << part;
  EXPECT_EQ(count(page, "<tr data-kind="), 108u);
  EXPECT_EQ(count(page, "data-kind=\"fails "), 12u);
  EXPECT_FALSE(contains(page, "<or>"));
  EXPECT_FALSE(contains(page, "http"));
  EXPECT_EQ(page, report_html(study, context,
                              {{"creep_by_slope", "A caption", "", "gnuplot is not installed"}}));
}

TEST(Report, IsOneSelfContainedFile) {
  const fs::path folder =
      fs::temp_directory_path() / ("hookpoint_report_" + std::to_string(::getpid()));
  const ReportOutcome outcome = write_report(synthetic_study(), {}, folder);
  std::ifstream file(folder / "report.html", std::ios::binary);
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  fs::remove_all(folder);
  EXPECT_TRUE(contains(page, "</html>"));
  for (const char* outside : {"src=", "<link", "@import", "url("})
    EXPECT_FALSE(contains(page, outside)) << outside;
  EXPECT_EQ(count(page, "<svg") + outcome.messages.size(), 3u);
}

TEST(Report, AStudyWithoutSweepsTruthsOrPlotsIsAPageToo) {
  StudyResult study;
  study.name = "single";
  study.subjects = {{"only", "dts", "hookpoint", "rk4", "", true}};
  study.metrics = {{"creep_speed", "m/s", false}};
  RunResult row;
  row.metrics = {{1e-9, {}, {}}};
  study.rows = {row};
  EXPECT_TRUE(contains(report_html(study, {}, {}), "No truth was asked for."));
  EXPECT_TRUE(contains(terminal_table(study), "no truth to hold"));
}

}  // namespace
}  // namespace hookpoint::studies
