// The report and the terminal's table of a made-up study whose every number is known.
#include "studies/report/report.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <tuple>

#include "output/figures/plot.h"
#include "studies/report/figures.h"
#include "studies/report/terminal_table.h"
#include "studies/results/summary.h"
#include "tests/support/synthetic_study.h"
#include "tests/support/text.h"

namespace hookpoint::studies {
namespace {

namespace fs = std::filesystem;
using testing::count;
using testing::synthetic_creep;
using testing::synthetic_row;
using testing::synthetic_study;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
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
  EXPECT_EQ(failures_of(synthetic_study()).size(), 6u);  // those of runs that stopped stand apart
  EXPECT_EQ(stopped_rows(synthetic_study()).size(), 6u);
}

TEST(Summary, ARunThatBreaksOffAsATruthSaysIsNoFailure) {
  StudyResult study = synthetic_study();
  for (RunResult& row : study.rows)
    if (row.status.starts_with("not_finite")) row.metrics[0] = {1., 1., true};
  const StudySummary summary = summarise(study);
  EXPECT_EQ(summary.total.stopped, 0);
  EXPECT_EQ(summary.total.expected, 6);
  EXPECT_EQ(summary.total.rows(), 108);
  EXPECT_TRUE(stopped_rows(study).empty());
  study.rows[0].status = "not_finite at 1 s";
  study.rows[0].metrics = {{0., 0., true}, {1., 2., false}, {}};
  EXPECT_EQ(outcome_of(study.rows[0]), RunOutcome::stopped);
}

/// Slope 30 slides; creep says something where friction holds only.
StudyResult two_regimes() {
  StudyResult study = synthetic_study();
  study.metrics[0].regime = Regime::holds;
  for (RunResult& row : study.rows)
    row.regime = row.parameters[0] < 30. ? Regime::holds : Regime::slides;
  for (RunResult& row : study.rows)
    if (row.regime == Regime::slides) row.metrics[0].ok.reset();
  return study;
}

TEST(Summary, KeepsRegimesApart) {
  const StudyResult study = two_regimes();
  const std::vector<RegimeTable> tables = regime_tables(study);
  ASSERT_EQ(tables.size(), 2u);
  EXPECT_EQ(tables[0].regime, Regime::holds);
  EXPECT_EQ(tables[0].summary.total.rows(), 90);
  EXPECT_EQ(tables[1].summary.total.rows(), 18);
  EXPECT_EQ(tables[0].metrics, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(tables[1].metrics, (std::vector<std::size_t>{1, 2}));
  const MetricSummary& creep = tables[0].summary.subjects[1].metrics[0];
  EXPECT_EQ(study.rows[static_cast<std::size_t>(creep.worst)].parameters[0], 25.);
  EXPECT_DOUBLE_EQ(creep.largest, 1.002 * synthetic_creep(25.));
}

TEST(Summary, AMetricThatATruthJudgesIsShownInAnyRegime) {
  StudyResult study = two_regimes();
  for (RunResult& row : study.rows)
    if (row.regime == Regime::slides) row.metrics[0].ok = true;
  EXPECT_EQ(regime_tables(study)[1].metrics, (std::vector<std::size_t>{0, 1, 2}));
}

TEST(Summary, AStudyOutsideTheRegimesIsOneTableWithoutAName) {
  const std::vector<RegimeTable> tables = regime_tables(synthetic_study());
  ASSERT_EQ(tables.size(), 1u);
  EXPECT_EQ(tables[0].heading, "");
  EXPECT_EQ(tables[0].subjects.size(), 6u);
}

TEST(Summary, WhereEveryRunHoldsTheTableIsNotCalledSo) {
  StudyResult study = synthetic_study();
  for (RunResult& row : study.rows) row.regime = Regime::holds;
  const std::vector<RegimeTable> tables = regime_tables(study);
  ASSERT_EQ(tables.size(), 1u);
  EXPECT_EQ(tables[0].heading, "");
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

TEST(Figures, APanelForEachValueOfASweep) {
  StudyResult study = synthetic_study();
  PlotSpec& spec = study.plots[0];  // over the slope
  spec.where = {{"dt", {1., 10.}}};
  spec.panels = {"dt"};
  spec.references = {{.label = "rigid", .value = 0.5, .where = {{"dt", {10.}}}}};
  std::erase_if(study.rows,
                [](const RunResult& row) { return row.subject == 2 && row.parameters[1] == 1.; });
  const Figure figure = make_figure(study, 0);
  ASSERT_TRUE(figure.panels);
  EXPECT_EQ(figure.panels->subtitle, "");
  EXPECT_TRUE(contains(figure.caption, "Black, dashed: rigid."));
  ASSERT_EQ(figure.panels->panels.size(), 2u);
  const output::Plot &first = figure.panels->panels[0], &second = figure.panels->panels[1];
  EXPECT_EQ(first.title, "dt = 1 ms");
  EXPECT_EQ(second.title, "dt = 10 ms");
  ASSERT_EQ(first.series.size(), 6u);  // five subjects, the sixth is not installed, and the line
  ASSERT_EQ(second.series.size(), 6u);
  EXPECT_EQ(first.series[2].label, "dts_hunt_crossley");  // without a run in this panel
  EXPECT_TRUE(first.series[2].measured.x.empty());
  EXPECT_EQ(second.series[2].measured.x.size(), 6u);
  EXPECT_DOUBLE_EQ(first.series[3].measured.y[0], -3.1e-7);
  EXPECT_DOUBLE_EQ(second.series[3].measured.y[0], -3.1e-6);
  EXPECT_EQ(first.series[4].unfinished.size(), 0u);
  EXPECT_EQ(second.series[4].unfinished.size(), 6u);
  EXPECT_TRUE(first.series[5].reference);
  EXPECT_TRUE(first.series[5].predicted.x.empty());
  EXPECT_EQ(second.series[5].predicted.x, (std::vector{5., 30.}));
  EXPECT_EQ(second.series[5].predicted.y, (std::vector{0.5, 0.5}));
}

TEST(Figures, OfTwoSweepsTheFirstRunsDownAndTheSecondAcross) {
  StudyResult study = synthetic_study();
  PlotSpec& spec = study.plots[2];  // over time
  spec.where = {{"slope", {15., 20.}}};
  spec.panels = {"slope", "dt"};
  const Figure figure = make_figure(study, 2);
  ASSERT_TRUE(figure.panels);
  EXPECT_EQ(figure.panels->across, 3u);
  ASSERT_EQ(figure.panels->panels.size(), 6u);
  EXPECT_EQ(figure.panels->panels[1].title, "slope = 15 deg, dt = 1 ms");
  EXPECT_EQ(figure.panels->panels[3].title, "slope = 20 deg, dt = 0.1 ms");
}

TEST(Figures, AFamilySharesAColourAndItsMembersDifferInMarker) {
  StudyResult study = synthetic_study();
  study.subjects[2].law = "hookpoint";
  study.subjects[4].engine = "ode_quickstep";
  const int next = output::style_colors;
  EXPECT_EQ(subject_styles(study), (std::vector<int>{0, 1, next, 2, next + 2, 3}));
}

/// The first study with as many subjects, each a family of its own.
StudyResult study_of_families(int families) {
  StudyResult study = synthetic_study();
  study.subjects.clear();
  study.rows.clear();
  for (int i = 0; i < families; ++i) {
    const std::string name = "law_" + std::to_string(i);
    study.subjects.push_back({name, "dts", name, "", "", true});
    for (const double slope : study.sweeps[0].values) {
      study.rows.push_back(synthetic_row(0, slope, 1.));
      study.rows.back().subject = i;
    }
  }
  return study;
}

/// Colour, marker and dashes of every series of the figure.
std::set<std::tuple<std::string, int, output::Dashes>> looks_of(const Figure& figure) {
  std::set<std::tuple<std::string, int, output::Dashes>> looks;
  for (const output::Series& series : figure.plot.series) {
    const output::SeriesStyle style = output::series_style(series.style);
    looks.emplace(style.color, style.shape, style.dashes);
  }
  return looks;
}

TEST(Figures, NoTwoSeriesLookTheSame) {
  const StudyResult few = study_of_families(17);
  std::set<std::string> colors;
  for (const int style : subject_styles(few)) colors.insert(output::series_style(style).color);
  EXPECT_EQ(colors.size(), 17u);
  for (const int families : {25, 60}) {
    const Figure figure = make_figure(study_of_families(families), 0);
    EXPECT_EQ(looks_of(figure).size(), static_cast<std::size_t>(families));
  }
  // Of one law, by one integrator or by two: colour and marker alone tell them apart.
  for (const int integrators : {1, 2}) {
    StudyResult same = study_of_families(45);
    for (std::size_t i = 0; i < same.subjects.size(); ++i) {
      same.subjects[i].law = "lugre";
      same.subjects[i].integrator =
          i % 2 < static_cast<std::size_t>(integrators - 1) ? "rk4" : "euler";
    }
    std::set<std::pair<std::string, int>> marks;
    for (const int style : subject_styles(same))
      marks.emplace(output::series_style(style).color, output::series_style(style).shape);
    EXPECT_EQ(marks.size(), same.subjects.size()) << integrators;
  }
  // Two members of a family, at each value of a sweep.
  StudyResult study = study_of_families(2);
  study.subjects[1].law = study.subjects[0].law;
  study.plots[0].series = "dt";
  for (const RunResult& row : std::vector(study.rows))
    for (const double dt : {0.1, 10.}) {
      study.rows.push_back(row);
      study.rows.back().parameters[1] = dt;
    }
  study.plots[0].where.clear();
  const Figure figure = make_figure(study, 0);
  EXPECT_EQ(figure.plot.series.size(), 6u);
  EXPECT_EQ(looks_of(figure).size(), 6u);
  // At the first value they look as they do elsewhere in the report.
  EXPECT_EQ(figure.plot.series[0].style, subject_styles(study)[0]);
  EXPECT_EQ(figure.plot.series[3].style, subject_styles(study)[1]);
}

TEST(Figures, ASubjectWithoutARunTakesNoColour) {
  StudyResult study = study_of_families(3);
  std::erase_if(study.rows, [](const RunResult& row) { return row.subject == 0; });
  EXPECT_EQ(subject_styles(study), (std::vector<int>{2, 0, 1}));
  study = study_of_families(3);
  study.subjects[1].available = false;
  EXPECT_EQ(subject_styles(study), (std::vector<int>{0, 2, 1}));
}

TEST(Figures, ReferencesDifferInTheirDashes) {
  StudyResult study = synthetic_study();
  study.plots[0].references = {{.label = "rigid", .value = 0.5, .where = {}},
                               {.label = "soft", .value = 0.1, .where = {}},
                               {.label = "rigid", .value = 0.6, .where = {}}};
  const Figure figure = make_figure(study, 0);
  std::vector<int> styles;
  for (const output::Series& series : figure.plot.series)
    if (series.reference) styles.push_back(series.style);
  EXPECT_EQ(styles, (std::vector<int>{0, 1, 0}));
  EXPECT_NE(output::reference_dashes(0), output::reference_dashes(1));
  EXPECT_TRUE(contains(figure.caption, "Black, dashed: rigid. Black, dotted: soft."));
}

TEST(Figures, DrawOnlyTheRowsThatTheBlockChooses) {
  StudyResult study = synthetic_study();
  study.plots[0].where = {{"dt", {1.}}, {"slope", {10., 20.}}};
  const Figure figure = make_figure(study, 0);
  EXPECT_EQ(figure.plot.series[1].measured.x, (std::vector{10., 20.}));
}

TEST(Tables, ARegimeOfWhichNoMetricSaysAnythingHasNone) {
  StudyResult study = synthetic_study();
  study.metrics = {{"creep_speed", "m/s", false, Regime::holds}};
  for (RunResult& row : study.rows) {
    row.regime = Regime::slides;
    row.metrics.resize(1);
    row.metrics[0].ok.reset();
  }
  EXPECT_FALSE(contains(terminal_table(study), "creep speed [m/s]"));
  EXPECT_TRUE(contains(report_html(study, {}, {}), "Every run"));
}

TEST(Figures, LongCurvesKeepTheirEnvelope) {
  StudyResult study = synthetic_study();
  for (RunResult& row : study.rows) {
    Trace curve = row.traces[2].read();
    if (curve.value.empty()) continue;
    curve.value[1234] = 7.;  // one sample among 2001
    row.traces[2] = curve;
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
                           "skipped", "48 of 60 verdicts hold", "FAIL 48/60     creep: creep_speed",
                           "at slope, dt", "6 stopped on the way"})
    EXPECT_TRUE(contains(table, word)) << word;
  EXPECT_FALSE(contains(table, "\033"));
}

TEST(TerminalTable, ShowsOneTableARegimeTheAnswerFirst) {
  const std::string table = terminal_table(two_regimes());
  const auto question = table.find("Does a block creep");
  const auto holds = table.find("Where friction holds: tan(slope) <= mu");
  const auto creep = table.find("creep_speed [m/s]");
  const auto slides = table.find("Where the body slides: tan(slope) > mu");
  EXPECT_EQ(question, 0u);
  EXPECT_LT(holds, creep);
  EXPECT_LT(creep, slides);
  EXPECT_EQ(table.find("creep_speed [m/s]", slides), std::string::npos);
}

TEST(TerminalTable, SaysWhereWhenAndWhyARunStopped) {
  const std::string table = terminal_table(synthetic_study(), {.color = false, .width = 100});
  EXPECT_TRUE(
      contains(table,
               "stopped  bullet_default at slope = 5 deg, dt = 10 ms: not_finite at 0.37 s in "
               "block.base: reduce\n         deltat <or> damping\n"))
      << table;
}

TEST(TerminalTable, NarrowTerminalsGetMetricsBelowOneAnother) {
  const std::string table = terminal_table(synthetic_study(), {.color = false, .width = 80});
  EXPECT_EQ(count(table, "\node_quickstep_recommended  "), 2u);
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
}

TEST(Report, SaysWhatHappened) {
  ReportContext context;
  context.command = "hookpoint study configs/studies/creep.hook";
  context.peers = {{"ode", "recommended", "CFM", "1e-10", "its manual"}};
  context.provenance = {{"ODE", "0.16.2, double"}};
  StudyResult study = synthetic_study();
  study.title = "Who creeps?";
  study.truths[0].first_failure = 74;
  const std::string page = report_html(
      study, context, {{"creep_by_slope", "A caption", "", "gnuplot is not installed"}});
  for (const std::string& part :
       {study.question, context.command,
        std::string("12 of 60 verdicts <a href=\"#truths\">do not hold</a>"),
        std::string("<h1>Who creeps?</h1>"), std::string("✗ 48/60"),
        std::string("6 runs <a href=\"#stopped\">stopped on the way</a>"),
        std::string("<a href=\"#run-74\">"), std::string("id=\"run-74\""),
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
  const std::string page = testing::read_file(folder / "report.html");
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
  EXPECT_TRUE(contains(report_html(study, {}, {}), "No truth is claimed."));
  EXPECT_TRUE(contains(terminal_table(study), "1 run: 1 finished; no truth to hold"));
}

}  // namespace
}  // namespace hookpoint::studies
