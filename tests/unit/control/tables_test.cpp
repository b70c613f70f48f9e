// Data and Controller.Trajectory: values of a file at a time, and what is said of a file that is
// wrong.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "control/data/table.h"
#include "output/records/recorder.h"
#include "tests/support/component_bench.h"

namespace hookpoint {
namespace {

using testing::ComponentBench;
using testing::TemporaryFile;

const std::string forces =
    "# pushes\n"
    "time [s],force [N],\"a, b\"\n"
    "0.1,1,5\n"
    "\n"
    "0.2,3,6\r\n"
    "0.3,-1,7\n";

double data_at(const std::string& file, const std::string& column, const std::string& interpolate,
               int tick, double period = 0.05) {
  ComponentBench data("Data", period);
  data.text("file", file);
  data.text("column", column);
  data.text("interpolate", interpolate);
  data.start();
  data.set_count(tick);
  data.tick();
  return data["output"];
}

TEST(Data, HoldsASampleUntilTheNext) {
  const TemporaryFile file("hold.csv", forces);
  const double expected[] = {1., 1., 1., 1., 3., 3., -1., -1., -1.};
  for (int k = 0; k < 9; ++k) EXPECT_EQ(data_at(file.path(), "force", "hold", k), expected[k]) << k;
  EXPECT_EQ(data_at(file.path(), "a, b", "hold", 4), 6.);
}

TEST(Data, HoldsFromTheVeryTickOfASample) {
  // On steps of 1/3000 s, k times the step is less than k/3000 for 431 of the first 2000 k.
  std::ostringstream text;
  text.precision(17);
  text << "time,x\n";
  for (int k = 0; k < 1000; ++k) text << k / 3000. << ',' << k << '\n';
  const TemporaryFile file("ticks.csv", text.str());
  ComponentBench data("Data", 1. / 3000.);
  data.text("file", file.path());
  data.text("column", "x");
  data.text("interpolate", "hold");
  data.start();
  for (int k = 0; k < 1000; ++k) {
    data.tick();
    EXPECT_EQ(data["output"], k);
  }
}

TEST(Data, IsStraightBetweenSamples) {
  const TemporaryFile file("linear.csv", forces);
  const double expected[] = {1., 1., 1., 2., 3., 1., -1., -1., -1.};
  for (int k = 0; k < 9; ++k) {
    EXPECT_NEAR(data_at(file.path(), "force", "linear", k), expected[k], 1e-14) << k;
  }
}

std::string data_error(const std::string& file, const std::string& column = "force") {
  ComponentBench data("Data");
  data.text("file", file);
  data.text("column", column);
  return testing::start_error(data);
}

TEST(Data, SaysWhatIsWrongWithAFileAndWhere) {
  const auto error = [](const char* content) {
    const TemporaryFile file("wrong.csv", content);
    const std::string text = data_error(file.path());
    return text.rfind(file.path(), 0) == 0 ? text.substr(file.path().size()) : text;
  };
  EXPECT_EQ(error("time,force\n0,1\n1,x\n"),
            ":3: `x` in the column `force` is not a finite number");
  EXPECT_EQ(error("time,force\n0,1\n1,\n"),
            ":3: `` in the column `force` is not a finite number but a missing value: `gaps = "
            "interpolate` or `gaps = hold` says what stands for it");
  EXPECT_EQ(error("time,force\n0,1\n1,inf\n"),
            ":3: `inf` in the column `force` is not a finite number");
  EXPECT_EQ(error("time,force\n1,1\n\n0,2\n"),
            ":4: its time, 0 s, is not after that of the row before: times rise");
  EXPECT_EQ(error("time,force\n0,1,2\n"),
            ":2: expected 2 fields, found 3, separated by commas; where commas stand in numbers, "
            "separate the fields by semicolons");
  EXPECT_EQ(
      error("0,1\n1,2\n"),
      ": has no column `force`; the table has no titles: its 2 columns have the numbers from 1 "
      "on");
  EXPECT_EQ(error("time\n0\n"),
            ": has no column `force`; its one column is `time`: fields are separated by commas, "
            "semicolons, tabs or blanks");
  EXPECT_EQ(error("time,force\n"), ": holds no row of numbers");
  EXPECT_EQ(error(""), ": holds no row of numbers");
  EXPECT_EQ(
      error("time [s],forc [N],b\n0,1,2\n"),
      ": has no column `force`; its columns are `time [s]`, `forc [N]`, `b`, separated by commas");
  EXPECT_EQ(data_error("nowhere.csv"), "nowhere.csv: cannot be read");
  EXPECT_EQ(data_error("nowhere.mat"), "nowhere.mat: cannot be read as a MAT file");
  EXPECT_EQ(data_error(""), "file is not given");
  EXPECT_EQ(data_error("x.csv", ""), "column is not given");
}

TEST(Data, ObeysTheUnitsOfItsTableAndItsFields) {
  const TemporaryFile file("units.csv",
                           "clock [ms],F [kN],knee [deg]\n5000,1,90\n5100,,180\n5200,3,0\n");
  ComponentBench data("Data", 0.05);
  data.text("file", file.path());
  data.text("column", "F");
  data.text("gaps", "interpolate");
  data["offset"] = 5.;
  data["start"] = 0.1;
  data.start();
  const double expected[] = {1000., 1000., 1000., 1500., 2000., 2500., 3000., 3000.};
  for (const double value : expected) {
    data.tick();
    EXPECT_NEAR(data["output"], value, 1e-9);
  }
  const auto& report = dynamic_cast<control::ReadsTable&>(data.component()).report();
  ASSERT_EQ(report.units.size(), 1U);
  EXPECT_EQ(report.units[0].written, "kN");
  EXPECT_NEAR(report.last, 0.3, 1e-12);

  ComponentBench goals("Controller.Trajectory", 0.1);
  goals.text("file", file.path());
  goals.text("columns", "knee");
  goals.text("interpolate", "linear");
  goals["offset"] = 5.;
  goals.start();
  goals.tick(2);
  EXPECT_NEAR(goals["goal[0]"], std::numbers::pi, 1e-12);
  EXPECT_NEAR(goals["goal_rate[0]"], -10. * std::numbers::pi, 1e-12);
}

/// The bytes of numbers as they are in memory (little-endian, as the header says).
template <class Number>
std::string bytes(std::initializer_list<Number> numbers) {
  std::string result;
  for (const Number number : numbers) {
    char raw[sizeof number];
    std::memcpy(raw, &number, sizeof number);
    result.append(raw, sizeof number);
  }
  return result;
}

/// A data element of a MAT file, padded to 8 bytes. Source: MathWorks, MAT-File Format, level 5.
std::string element(std::uint32_t type, std::string content) {
  const auto size = static_cast<std::uint32_t>(content.size());
  content.resize((content.size() + 7) / 8 * 8, '\0');
  return bytes({type, size}) + content;
}

/// A double row vector: miMATRIX (14) of flags (miUINT32, mxDOUBLE_CLASS 6), dimensions (miINT32),
/// name (miINT8), miDOUBLE.
std::string mat_vector(const std::string& name, std::initializer_list<double> values) {
  const auto columns = static_cast<std::int32_t>(values.size());
  return element(14, element(6, bytes<std::uint32_t>({6, 0})) +
                         element(5, bytes<std::int32_t>({1, columns})) + element(1, name) +
                         element(9, bytes(values)));
}

std::string mat_file(const std::string& elements) {
  std::string header = "MATLAB 5.0 MAT-file";
  header.resize(124, ' ');
  return header + bytes<std::uint16_t>({0x0100, 0x4d49}) + elements;
}

TEST(Data, ReadsMatlabVectors) {
  const TemporaryFile file("series.mat", mat_file(mat_vector("time", {0.1, 0.2, 0.3}) +
                                                  mat_vector("force", {1., 3., -1.})));
  const double expected[] = {1., 1., 1., 2., 3., 1., -1., -1., -1.};
  for (int k = 0; k < 9; ++k) {
    EXPECT_NEAR(data_at(file.path(), "force", "linear", k), expected[k], 1e-14) << k;
  }
}

TEST(Data, TimesOfAMatFileAreThoseThatItsFieldsName) {
  const TemporaryFile file("clock.mat", mat_file(mat_vector("stamp", {1609060336e3, 1609060337e3}) +
                                                 mat_vector("force", {1., 3.})));
  ComponentBench by_name("Data", 0.5);
  by_name.text("file", file.path());
  by_name.text("column", "force");
  by_name.text("time", "stamp");
  by_name.text("time_unit", "ms");
  by_name.start();
  by_name.tick(2);
  EXPECT_NEAR(by_name["output"], 2., 1e-12);
  ComponentBench by_rate("Data", 0.25);
  by_rate.text("file", file.path());
  by_rate.text("column", "force");
  by_rate["sample_rate"] = 2.;
  by_rate.start();
  by_rate.tick(2);
  EXPECT_NEAR(by_rate["output"], 2., 1e-12);
  by_rate.text("time", "stamp");
  EXPECT_NE(testing::start_error(by_rate).find("not by both"), std::string::npos);
}

TEST(Data, ReadsTheRecordsThatRunsLeave) {
  for (const char* format : {"mat5", "mat73"}) {
    const std::string path = ::testing::TempDir() + "control_tables_" + format + ".mat";
    output::RecordHeader header;
    header.channels.resize(2);
    header.channels[0].path = "bot.leg[0].angle";
    header.channels[0].unit = "deg";
    header.channels[1].path = "other";
    const auto writer = output::make_record_writer(format, path, header);
    for (int k = 0; k < 5; ++k) writer->row(0.05 * k, std::vector<double>{1. * k * k, -1.});
    writer->close();
    for (int k = 0; k < 5; ++k) {
      const double angle = k * k * std::numbers::pi / 180.;
      EXPECT_NEAR(data_at(path, "bot_leg_0_angle", "hold", k), angle, 1e-15) << format;
      EXPECT_NEAR(data_at(path, "bot_leg_0_angle.data", "hold", k), angle, 1e-15) << format;
      EXPECT_EQ(data_at(path, "other", "hold", k), -1.) << format;
    }
    std::filesystem::remove(path);
  }
}

TEST(Data, SaysWhatIsWrongWithAMatFile) {
  const auto error = [](const std::string& elements, const std::string& column = "force") {
    const TemporaryFile file("wrong.mat", mat_file(elements));
    const std::string text = data_error(file.path(), column);
    return text.rfind(file.path(), 0) == 0 ? text.substr(file.path().size()) : text;
  };
  const std::string time = mat_vector("time", {0., 1.});
  EXPECT_EQ(error(time), ": no variable 'force'; there are 'time'");
  EXPECT_EQ(error(time, "time.force"), ": no variable 'time.force'; there are 'time'");
  EXPECT_EQ(error(mat_vector("force", {1., 2.})), ": no variable 'time'; there are 'force'");
  EXPECT_EQ(error(time + mat_vector("force", {1., 2., 3.})), ": 'force' has 3 elements, 'time' 2");
  EXPECT_EQ(error(time + mat_vector("force", {1., NAN})),
            ": element 2 of 'force' is not finite: `gaps = interpolate` says what stands for it");
  EXPECT_EQ(error(mat_vector("time", {1., 1.}) + mat_vector("force", {1., 2.})),
            ": 'time': element 2 is not after the one before");
  const TemporaryFile text("text.mat", "this is no such file");
  EXPECT_EQ(data_error(text.path()), text.path() + ": cannot be read as a MAT file");
}

struct Goals {
  double value, rate;
};

Goals trajectory_at(const std::string& file, const std::string& interpolate,
                    const std::string& outside, double time, double start = 0.) {
  ComponentBench bench("Controller.Trajectory", 1. / 64.);
  bench.text("file", file);
  bench.text("interpolate", interpolate);
  bench.text("outside", outside);
  bench["start"] = start;
  bench.start();
  bench.component().update({time, 1. / 64., 1});
  return {bench["goal[0]"], bench["goal_rate[0]"]};
}

/// On uneven points, values of `function`.
template <class Function>
std::string table_of(Function function, std::initializer_list<double> times) {
  std::ostringstream text;
  text.precision(17);
  text << "time [s],q1 [rad],q2 [rad]\n";
  for (const double t : times) text << t << ',' << function(t) << ',' << -t << '\n';
  return text.str();
}

TEST(Trajectory, ReproducesACubicAndItsRate) {
  const auto cubic = [](double t) { return 1. - 2. * t + 3. * t * t - 0.5 * t * t * t; };
  const auto rate = [](double t) { return -2. + 6. * t - 1.5 * t * t; };
  for (const auto& times : {std::initializer_list<double>{0., 0.5, 0.75, 2., 2.25, 3., 4.},
                            std::initializer_list<double>{0., 1., 3., 4.}}) {
    const TemporaryFile file("cubic.csv", table_of(cubic, times));
    for (double t = 0.; t < 4.; t += 0.0625) {
      const Goals goals = trajectory_at(file.path(), "cubic", "hold", t);
      EXPECT_NEAR(goals.value, cubic(t), 1e-12) << t;
      EXPECT_NEAR(goals.rate, rate(t), 1e-11) << t;
    }
  }
}

TEST(Trajectory, IsStraightBetweenRowsIfLinear) {
  const TemporaryFile file("lines.csv", "time,q\n0,1\n2,5\n3,4\n");
  const auto at = [&file](double t) { return trajectory_at(file.path(), "linear", "hold", t); };
  EXPECT_EQ(at(0.5).value, 2.);
  EXPECT_EQ(at(0.5).rate, 2.);
  EXPECT_EQ(at(2.).value, 5.);
  EXPECT_EQ(at(2.).rate, -1.);
  EXPECT_EQ(at(2.5).value, 4.5);
}

TEST(Trajectory, HoldsOutsideOfTheTable) {
  const TemporaryFile file("hold.csv", "time,q\n0,1\n2,5\n3,4\n");
  for (const char* shape : {"linear", "cubic"}) {
    const auto at = [&](double t) { return trajectory_at(file.path(), shape, "hold", t, 10.); };
    EXPECT_EQ(at(9.).value, 1.);
    EXPECT_EQ(at(9.).rate, 0.);
    EXPECT_EQ(at(12.).value, 5.);
    EXPECT_EQ(at(14.).value, 4.);
    EXPECT_EQ(at(14.).rate, 0.);
  }
}

/// A sine on 24 points a round: the Hermite cubic's error is h^4/384 max|f''''| + h/4 max|slope
/// error|, the slope's h^4/30.
TEST(Trajectory, RepeatsWithoutASeam) {
  std::ostringstream text;
  text.precision(17);
  text << "time,q\n";
  for (int i = 0; i <= 24; ++i) {
    text << 0.5 + i / 24. << ',' << (i % 24 == 0 ? 0. : std::sin(2. * std::numbers::pi * i / 24.))
         << '\n';
  }
  const TemporaryFile file("sine.csv", text.str());
  const double h = 2. * std::numbers::pi / 24.;
  const double bound = std::pow(h, 4) / 384. + h / 4. * std::pow(h, 4) / 30.;
  for (double t = -2.; t < 4.; t += 1. / 64.) {
    const double phase = 2. * std::numbers::pi * (t - 0.5);
    const Goals goals = trajectory_at(file.path(), "cubic", "repeat", t);
    EXPECT_NEAR(goals.value, std::sin(phase), bound) << t;
    EXPECT_NEAR(goals.rate, 2. * std::numbers::pi * std::cos(phase), 0.01) << t;
  }
}

TEST(Trajectory, GivesEveryColumn) {
  const TemporaryFile file("columns.csv", "time,a,b,c\n0,1,2,3\n1,2,4,6\n");
  ComponentBench bench("Controller.Trajectory", 0.5);
  bench.text("file", file.path());
  bench.start();
  bench.tick(2);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(bench["goal[" + std::to_string(i) + "]"], 1.5 * (i + 1));
    EXPECT_EQ(bench["goal_rate[" + std::to_string(i) + "]"], i + 1.);
  }
  EXPECT_EQ(bench["goal[3]"], 0.);
}

TEST(Trajectory, RefusesWhatItCannotFollow) {
  ComponentBench bench("Controller.Trajectory");
  EXPECT_EQ(testing::start_error(bench), "file is not given");
  const TemporaryFile one("one.csv", "time,q\n0,1\n");
  bench.text("file", one.path());
  EXPECT_EQ(testing::start_error(bench), "");
  bench.text("outside", "repeat");
  EXPECT_EQ(testing::start_error(bench), one.path() + ": outside = repeat needs two rows or more");
  std::string wide = "time", row = "0";
  for (int i = 0; i < 25; ++i) wide += ",q", row += ",0";
  const TemporaryFile many("many.csv", wide + "\n" + row + "\n");
  bench.text("file", many.path());
  EXPECT_EQ(testing::start_error(bench),
            many.path() + ": 25 goals, at most 24 are possible: `columns` says which");
}

}  // namespace
}  // namespace hookpoint
