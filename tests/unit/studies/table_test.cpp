// Table blocks: cells against means worked out by hand, and what is wrong with a block.
#include <gtest/gtest.h>

#include <cmath>

#include "output/files/csv.h"
#include "studies/report/report_pivots.h"
#include "studies/report/terminal_pivot.h"
#include "studies/report/terminal_table.h"
#include "studies/results/pivot.h"
#include "studies/results/seed_means.h"
#include "studies/results/statistics.h"
#include "tests/support/study_runner.h"
#include "tests/support/synthetic_study.h"

namespace hookpoint::studies {
namespace {

using testing::synthetic_creep;
using testing::synthetic_study;

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TableSpec by_slope() {
  return {.name = "creep",
          .title = "",
          .rows = "subject",
          .columns = "slope",
          .value = "creep_speed",
          .subjects = {},
          .where = {}};
}

/// Two subjects at two values of a sweep with four seeds; the second is the first plus 1, 2, 3, 4.
StudyResult study_of_seeds() {
  StudyResult study;
  study.name = "seeds";
  study.sweeps = {{"slope", "deg", {5., 10.}, {}}, {"seed", "", {1., 2., 3., 4.}, {}}};
  study.seed_sweep = 1;
  study.subjects = {{"one", "dts", "hookpoint", "", "", true}, {"two", "ode", "", "", "", true}};
  study.metrics = {{"creep_speed", "m/s", false, Regime::none}};
  study.tables = {{"creep", "", "subject", "slope", "creep_speed", {}, {}}};
  for (const double slope : {5., 10.})
    for (const double seed : {1., 2., 3., 4.})
      for (const int subject : {0, 1}) {
        RunResult row;
        row.parameters = {slope, seed};
        row.subject = subject;
        const double value = slope * slope * (seed == 2. ? 3. : 1.) + (subject == 0 ? 0. : seed);
        row.metrics = {{value, 7., std::nullopt, std::nullopt}};
        study.rows.push_back(row);
      }
  return study;
}

TEST(Tables, AStudyThatVariedOneThingIsToldValueByValue) {
  StudyResult study = study_of_seeds();
  study.tables.clear();
  const std::string told = terminal_table(study);
  EXPECT_TRUE(says(told, "creep speed [m/s] by subject and slope [deg]")) << told;
  EXPECT_TRUE(says(pivot_tables(over_seeds(study)), "slope [deg]"));
  // Of two swept things the user says what is told over which.
  StudyResult two = study_of_seeds();
  two.tables.clear();
  two.seed_sweep.reset();
  EXPECT_TRUE(shown_tables(two).empty());
  two.tables = {by_slope()};
  EXPECT_EQ(shown_tables(two).size(), 1u);
}

// Student's t of 3 and 4 degrees of freedom at 97.5 %: tables of the distribution.
constexpr double student_3 = 3.182446305284263, student_4 = 2.776445105197999;

TEST(Seeds, AnIntervalIsStudents) {
  // Sums by hand: mean 3, squares 4 + 1 + 0 + 1 + 4 = 10, s^2 = 2.5, s / sqrt(5) = sqrt(0.5).
  const auto interval = mean_interval(std::vector{1., 2., 3., 4., 5.});
  ASSERT_TRUE(interval);
  EXPECT_DOUBLE_EQ(interval->mean, 3.);
  EXPECT_NEAR(interval->half_width, student_4 * std::sqrt(0.5), 1e-12);
  EXPECT_FALSE(mean_interval(std::vector{1.}));
  EXPECT_EQ(mean_interval(std::vector{2., 2.})->half_width, 0.);
}

TEST(Seeds, ATableHasMeansTheirIntervalsAndPairedDifferences) {
  const StudyResult study = study_of_seeds();
  const Pivot pivot = pivot_of(study, study.tables[0]);
  EXPECT_EQ(pivot.seeds, 4U);
  EXPECT_EQ(pivot.first, "one");
  EXPECT_EQ(pivot.note, "");
  // 25, 75, 25, 25: mean 37.5, s = 25, s / sqrt(4) = 12.5.
  EXPECT_DOUBLE_EQ(pivot.at(0, 0).interval->mean, 37.5);
  EXPECT_NEAR(pivot.at(0, 0).interval->half_width, student_3 * 12.5, 1e-10);
  EXPECT_FALSE(pivot.at(0, 0).difference);
  // Whatever the seeds scatter, the differences are 1, 2, 3, 4: mean 2.5, s^2 = 5 / 3.
  for (const std::size_t column : {0U, 1U}) {
    const PivotCell& cell = pivot.at(1, column);
    EXPECT_NEAR(cell.difference->mean, 2.5, 1e-12);
    EXPECT_NEAR(cell.difference->half_width, student_3 * std::sqrt(5. / 12.), 1e-10);
  }
  const std::string terminal = terminal_table(study);
  EXPECT_TRUE(says(terminal, "37.5 ± 40")) << terminal;
  // Differences stand below, without the subject that they are to.
  EXPECT_TRUE(says(terminal,
                   "difference to one, paired by seed\n"
                   "subject           5          10\n"
                   "two       2.5 ± 2.1   2.5 ± 2.1\n"))
      << terminal;
  EXPECT_TRUE(says(terminal, "over 4 seeds")) << terminal;
  EXPECT_TRUE(says(pivot_tables(over_seeds(study)), "difference 2.5 ± 2.1"));
}

TEST(Seeds, ACellThatAveragesMoreThanSeedsTakesEachSeedsMean) {
  StudyResult study = study_of_seeds();
  const TableSpec table = study.tables[0];
  // Both slopes in one column: each seed's value is (25 + 100) / 2 times 1 or 3.
  for (RunResult& row : study.rows) row.parameters[0] = row.parameters[0] == 5. ? 5. : 5. + 1e-12;
  const Pivot pivot = pivot_of(study, table);
  EXPECT_DOUBLE_EQ(pivot.at(0, 0).interval->mean, 93.75);
  EXPECT_NEAR(pivot.at(0, 0).interval->half_width, student_3 * 62.5 / 2., 1e-9);
  // A run without a value: no interval claims to know it.
  study.rows[0].metrics[0].measured.reset();
  EXPECT_FALSE(pivot_of(study, table).at(0, 0).interval);
}

TEST(Seeds, RowsThatDifferInTheSeedAloneAreOneOfMeans) {
  StudyResult study = study_of_seeds();
  study.rows[2].status = "not_finite at 0.1 s";
  const StudyResult means = over_seeds(study);
  ASSERT_EQ(means.rows.size(), 4U);
  ASSERT_EQ(means.sweeps.size(), 1U);
  EXPECT_EQ(means.rows[3].parameters, (std::vector<double>{10.}));
  EXPECT_EQ(means.rows[3].subject, 1);
  EXPECT_DOUBLE_EQ(*means.rows[3].metrics[0].measured, 152.5);
  EXPECT_TRUE(means.rows[3].metrics[0].half_width);
  EXPECT_EQ(*means.rows[3].metrics[0].predicted, 7.);
  EXPECT_EQ(means.rows[0].status, "not_finite at 0.1 s (1 of 4 seeds)");
}

TEST(TerminalTable, SaysOnceWhyAnEngineRefusedRuns) {
  StudyResult study = study_of_seeds();
  study.seed_sweep.reset();
  for (RunResult& row : study.rows)
    if (row.subject == 1) row.status = "refused: a rail has no mass";
  const std::string terminal = terminal_table(study);
  EXPECT_TRUE(
      says(terminal, "refused  two at slope = 5 deg, seed = 1 and 7 more: a rail has no mass"))
      << terminal;
}

TEST(Pivot, ACellIsTheMeanOfItsRunsBesideTheirClosedForm) {
  const StudyResult study = synthetic_study();
  const Pivot pivot = pivot_of(study, by_slope());
  EXPECT_EQ(pivot.title, "creep speed [m/s]");
  EXPECT_EQ(pivot.across, "slope [deg]");
  EXPECT_EQ(pivot.columns, (std::vector<std::string>{"5", "10", "15", "20", "25", "30"}));
  ASSERT_EQ(pivot.rows.size(), 6u);
  // Three steps that all creep alike: their mean is each.
  const PivotCell& creeps = pivot.at(1, 2);
  EXPECT_EQ(creeps.rows, 3);
  EXPECT_NEAR(*creeps.mean, 1.002 * synthetic_creep(15.), 1e-15);
  EXPECT_NEAR(*creeps.predicted, synthetic_creep(15.), 1e-15);
  EXPECT_EQ(creeps.passed, 3);
  EXPECT_EQ(pivot.at(2, 5).failed, 3);
  // Uphill by -3.1e-7 times the step of 0.1, 1 and 10 ms.
  const PivotCell& uphill = pivot.at(3, 0);
  EXPECT_NEAR(*uphill.mean, -3.1e-7 * (0.1 + 1. + 10.) / 3., 1e-18);
  EXPECT_DOUBLE_EQ(uphill.least, -3.1e-6);
  EXPECT_DOUBLE_EQ(uphill.largest, -3.1e-8);
  EXPECT_FALSE(uphill.predicted);
  // One of three runs stopped: the mean is of the other two.
  EXPECT_EQ(pivot.at(4, 0).rows, 3);
  EXPECT_EQ(pivot.at(4, 0).values, 2);
  EXPECT_NEAR(*pivot.at(4, 0).mean, 6e-11 * std::sqrt(5.), 1e-24);
  EXPECT_FALSE(pivot.at(5, 0).mean);
  EXPECT_EQ(pivot.note, "mean over dt");
}

TEST(Pivot, SubjectsAndConditionsLeaveOtherRowsOutAndAreTold) {
  const StudyResult study = synthetic_study();
  TableSpec spec = by_slope();
  spec.rows = "slope";
  spec.columns = "dt";
  spec.subjects = {1, 3};
  spec.where = {{"slope", {10., 20.}}};
  const Pivot pivot = pivot_of(study, spec);
  EXPECT_EQ(pivot.rows, (std::vector<std::string>{"10", "20"}));
  EXPECT_EQ(pivot.note, "mean over subjects");
  EXPECT_NEAR(*pivot.at(1, 2).mean, (1.002 * synthetic_creep(20.) - 3.1e-6) / 2., 1e-15);
  // One of the two has no closed form, so the mean has none.
  EXPECT_FALSE(pivot.at(1, 2).predicted);
  spec = by_slope();
  spec.where = {{"dt", {1.}}};
  EXPECT_EQ(pivot_of(study, spec).note, "dt = 1 ms");
}

TEST(Pivot, PageAndTerminalShowMeanSpreadAndVerdict) {
  StudyResult study = synthetic_study();
  study.tables = {by_slope()};
  study.tables[0].title = "<who creeps?>";
  const std::string page = pivot_tables(study);
  EXPECT_TRUE(says(page, "&lt;who creeps?&gt; [m/s]"));
  EXPECT_FALSE(says(page, "<who"));
  EXPECT_TRUE(says(page, "✗ 0/3"));
  EXPECT_TRUE(says(page, "2 of 3 runs have a value"));
  const std::string shown = terminal_pivot(pivot_of(study, study.tables[0]), {true, 80});
  EXPECT_TRUE(says(shown, "-1.147e-06 (-3.1e-06 .. -3.1e-08)"));
  EXPECT_TRUE(says(shown, "\033[1;31m7.506e-05 / 5.774e-05\033[0m"));
}

std::string with_table(const std::string& table) {
  return "Study s { scene = \"scene.hook\"; duration = 1 s; settle = 0.2 s;\n"
         "  Subject ours { engine = dts; contact = hookpoint; }\n"
         "  Sweep slope { values = 10 deg, 20 deg; } Sweep mu { values = 0.8, 1; }\n"
         "  Measure creep_speed; Plot fig { x = slope; y = creep_speed; }\n" +
         table + "}";
}

TEST_F(StudyRunner, ATableLeavesItsCells) {
  const auto plan = this->plan(
      with_table("Table creep { rows = slope; columns = subject; value = creep_speed; }"));
  ASSERT_TRUE(plan) << first_error();
  const StudyRun run = this->run(*plan, "out");
  const auto table = output::parse_csv(read(run.folder / "creep.csv"));
  ASSERT_TRUE(table);
  EXPECT_EQ(table->header,
            (std::vector<std::string>{"slope [deg]", "subject", "creep_speed [m/s]", "least [m/s]",
                                      "largest [m/s]", "predicted [m/s]", "runs", "values",
                                      "passed", "failed"}));
  ASSERT_EQ(table->rows.size(), 2u);
  EXPECT_EQ(table->rows[1][0], "20");
  EXPECT_NEAR(std::stod(table->rows[1][2]), 2e-3 + 1e-3 * 0.3490658503988659, 1e-12);
  EXPECT_EQ(table->rows[1][6], "2");
}

TEST_F(StudyRunner, ATableOfWhatIsNotThereIsRefused) {
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"Table t { rows = slop; columns = subject; value = creep_speed; }", "did you mean `slope`"},
      {"Table t { rows = slope; columns = slope; value = creep_speed; }", "runs down the rows"},
      {"Table t { rows = slope; columns = mu; value = penetration_max; }", "Measure of this study"},
      {"Table fig { rows = slope; columns = mu; value = creep_speed; }", "give the Table another"},
      {"Table results { rows = slope; columns = mu; value = creep_speed; }", "another name"}};
  for (const auto& [table, message] : wrong) {
    EXPECT_FALSE(plan(with_table(table))) << table;
    EXPECT_TRUE(says(first_error(), message)) << first_error();
  }
}

}  // namespace
}  // namespace hookpoint::studies
