// Tables as programs write them, by hand after the formats' own documentation: each holds 1 and 2,
// in SI, at 0 s and 10 ms, or is refused with the reason.
#include "text/series.h"

#include <gtest/gtest.h>

#include "text/units.h"

namespace hookpoint::text {
namespace {

struct Case {
  const char* kind;
  std::string text;
  std::string column;
  SeriesRequest more = {};
};

/// A request with some of its members.
SeriesRequest with(auto&& set) {
  SeriesRequest request;
  set(request);
  return request;
}

std::optional<SeriesTable> read(const Case& one, std::string& why) {
  Fault fault;
  const auto tables = read_foreign(one.text, fault);
  if (!tables) {
    why = fault.text();
    return std::nullopt;
  }
  SeriesRequest request = one.more;
  if (!one.column.empty()) request.columns = {one.column};
  SeriesFault wrong;
  auto series = read_series(*tables, request, wrong);
  if (!series) why = std::to_string(wrong.line) + ": " + wrong.text();
  return series;
}

const std::string mot =
    "walk_grf\nversion=1\nnRows=2\nnColumns=3\ninDegrees=no\nendheader\n"
    "time\tground_force_vx\tground_force_vy\n0.00\t0\t1\n0.01\t0\t2\n";
const std::string simm =
    "name walk.mot\ndatacolumns 2\ndatarows 2\nrange 0 0.01\nendheader\ntime force\n 0.00  1\n"
    " 0.01  2\n";
const std::string degrees =
    "Coordinates\nversion=1\nnRows=2\nnColumns=3\ninDegrees=yes\n\nUnits are S.I. units.\n"
    "endheader\ntime\tknee_angle_r\tpelvis_tx\n0.00\t57.29577951308232\t1\n"
    "0.01\t114.59155902616465\t2\n";
const std::string trc =
    "PathFileType\t4\t(X/Y/Z)\twalk.trc\n"
    "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\t"
    "OrigNumFrames\n100.00\t100.00\t2\t2\tmm\t100.00\t1\t2\n"
    "Frame#\tTime\tRASI\t\t\tLASI\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n\n"
    "1\t0.00\t0\t0\t0\t0\t1000\t0\n2\t0.01\t0\t0\t0\t0\t2000\t0\n";
const std::string nexus =
    "Devices\n1000\n,,Force Plate #1 - Force,,\nFrame,Sub Frame,Fx,Fy,Fz\n,,N,N,N\n"
    "231,0,0,0,1\n231,1,0,0,1\n232,0,0,0,2\n\n"
    "Trajectories\n100\n,,Bob:RASI,,,Bob:LASI,,\nFrame,Sub Frame,X,Y,Z,X,Y,Z\n"
    ",,mm,mm,mm,mm,mm,mm\n231,0,0,0,0,1000,0,0\n232,0,0,0,,2000,0,0\n";
const std::string motive =
    "Format Version,1.23,Take Name,take,Capture Frame Rate,100.000000,Length Units,Meters\n\n"
    ",Type,Rigid Body,Rigid Body,Rigid Body,Rigid Body\n,Name,Foot,Foot,Hand,Hand\n"
    ",ID,1,1,2,2\n,,Rotation,Position,Rotation,Position\nFrame,Time (Seconds),X,X,X,X\n"
    "0,0.000000,0,0,0,1\n1,0.010000,0,0,0,2\n";
const std::string qualisys =
    "NO_OF_FRAMES\t2\nNO_OF_CAMERAS\t8\nNO_OF_MARKERS\t2\nFREQUENCY\t100\nNO_OF_ANALOG\t0\n"
    "ANALOG_FREQUENCY\t0\nDESCRIPTION\t--\nDATA_INCLUDED\t3D\nMARKER_NAMES\tRASI\tLASI\n";
const std::string rostopic =
    "%time,field.header.seq,field.header.frame_id,field.force.z\n"
    "1609060336768428032,0,plate,1\n1609060336778428032,1,plate,2\n";

std::vector<Case> tables() {
  const auto ms = with([](SeriesRequest& r) { r.time_unit = "ms"; });
  const auto hundred = with([](SeriesRequest& r) { r.sample_rate = 100.; });
  const auto filled = with([](SeriesRequest& r) { r.gaps = Gaps::interpolate; });
  const auto held = with([](SeriesRequest& r) { r.gaps = Gaps::hold; });
  const auto from_five = with([](SeriesRequest& r) { r.offset = 5.; });
  const auto kilo = with([](SeriesRequest& r) { r.unit = "kN"; });
  return {
      {"plain", "time,F\n0,1\n0.01,2\n", "F"},
      {"units in brackets", "time [ms],F [kN]\n0,0.001\n10,0.002\n", "F"},
      {"units in parentheses", "Time (ms),F (mN)\n0,1000\n10,2000\n", "F"},
      {"units without a blank", "Time(s),F(N)\n0,1\n0.01,2\n", "F"},
      {"units after DIN 461", "t / ms;F / kN\n0;0,001\n10;0,002\n", "F"},
      {"words of units",
       "Time [Seconds],Angle [degrees]\n0,57.29577951308232\n"
       "0.01,114.59155902616465\n",
       "Angle"},
      {"Nm", "t [msec],M [Nmm]\n0,1000\n10,2000\n", "M"},
      {"a German spreadsheet", "Zeit [ms];Kraft [N]\n0,0;1,000\n10,0;2,000\n", "Kraft"},
      {"sep=", "sep=;\nt;F\n0;1\n0,01;2\n", "F"},
      {"a row of units", "Time\tFx\tFz\ns\tN\tkN\n0\t0\t0.001\n0.01\t0\t0.002\n", "Fz"},
      {"a row of units in brackets", "Time,Fz\n[ms],[kN]\n0,0.001\n10,0.002\n", "Fz"},
      {"a row with no unit", "Time,n,Fz\ns,-,N\n0,7,1\n0.01,7,2\n", "Fz"},
      {"title lines", "Force plate\nMonday morning\n\nTime,F\n0,1\n0.01,2\n", "F"},
      {"keys and values", "Subject,Bob\nRate,100\nGain,5\nTime,F\n0,1\n0.01,2\n", "F"},
      {"keys and values, tabs",
       "Operator:\tAda\nSampling rate (Hz):\t100\n\nabs time (s)\tFz\n"
       "0\t1\n0.01\t2\n",
       "Fz"},
      {"comments", "# logger 3\n// v2\n% x\ntime,F\n0,1\n# pause\n0.01,2\n", "F"},
      {"numpy.savetxt",
       "# t F\n0.000000000000000000e+00 1.000000000000000000e+00\n"
       "1.000000000000000021e-02 2.000000000000000000e+00\n",
       "F"},
      {"gnuplot", "#t\tF\n0\t1\n0.01\t2\n", "F"},
      {"pandas with an index", ",time,F\n0,0.0,1.0\n1,0.01,2.0\n", "F"},
      {"pandas, nothing but an index", ",F\n0,1.0\n1,2.0\n", "F", hundred},
      {"no titles", "0,1\n0.01,2\n", "2"},
      {"no titles, blanks", "  0.00   7 1\n  0.01   7 2\n", "3"},
      {"no titles, no times", "7 1\n7 2\n", "2", hundred},
      {"no times", "Fx,Fz\n7,1\n7,2\n", "Fz", hundred},
      {"one column", "F\n1\n2\n", "F", hundred},
      {"one column without a title", "1\n2\n", "1", hundred},
      {"a stated unit of time", "stamp,F\n0,1\n10,2\n", "F", ms},
      {"a unit of time in the name", "time_ms,F\n0,1\n10,2\n", "F"},
      {"a stated unit", "time,F\n0,0.001\n0.01,0.002\n", "F", kilo},
      {"OpenSim .mot", mot, "ground_force_vy"},
      {"SIMM", simm, "force"},
      {"OpenSim in degrees", degrees, "knee_angle_r"},
      {"OpenSim in degrees, metres", degrees, "pelvis_tx"},
      {"TRC", trc, "LASI Y2"},
      {"TRC by its own title", trc, "Y2"},
      {"Vicon Nexus, markers", nexus, "Bob:LASI X"},
      {"Motive", motive, "Hand Position X"},
      {"Qualisys without titles", qualisys + "0\t0\t0\t0\t1000\t0\n0\t0\t0\t0\t2000\t0\n",
       "LASI Y"},
      {"Qualisys with titles",
       qualisys + "Frame\tTime\tRASI X\tLASI Y\n1\t0.00000\t0\t1000\n"
                  "2\t0.01000\t0\t2000\n",
       "LASI Y"},
      {"rostopic echo -p", rostopic, "field.force.z"},
      {"bagpy", "Time,header.frame_id,z\n1609060336.25,plate,1\n1609060336.26,plate,2\n", "z"},
      {"PlotJuggler", "__time,z\n1609060336.25,1\n1609060336.26,2\n", "z"},
      {"a clock in milliseconds since 1970", "stamp [ms],F\n1609060336768,1\n1609060336778,2\n",
       "F"},
      {"a column of words", "time,state,F\n0,stance,1\n0.01,swing,2\n", "F"},
      {"a clock with an offset", "time,F\n5,1\n5.01,2\n", "F", from_five},
      {"an empty row", "time,F\n0,1\n,\n0.01,2\n", "F"},
      {"a field behind the last", "time,F,\n0,1,\n0.01,2,\n", "F"},
      {"an empty first field", "time,F\n-0.01,\n0,1\n0.01,2\n", "F",
       with([](SeriesRequest& r) { r.gaps = Gaps::leave_out; })},
      {"a stamp twice", "time,F\n0,7\n0,1\n0.01,2\n", "F"},
      {"signs", "time,F\n+0,+1\n+1e-2,+2.0\n", "F"},
      {"quotes", "\"time\",\"F\"\n\"0\",\"1\"\n\"0.01\",\"2\"\n", "F"},
      {"a middle gap interpolated", "time,F\n0,1\n0.005,NaN\n0.01,2\n", "F", filled},
      {"a middle gap held", "time,F\n0,1\n0.005,\n0.01,2\n", "F", held},
  };
}

TEST(Series, EachKindOfTableIsRead) {
  for (const Case& one : tables()) {
    std::string why;
    const auto series = read(one, why);
    ASSERT_TRUE(series) << one.kind << ": " << why;
    const Samples& samples = series->cases.begin()->second;
    ASSERT_GE(samples.time.size(), 2U) << one.kind;
    EXPECT_NEAR(samples.time.front(), 0., 1e-12) << one.kind;
    // Of decimal seconds since 1970 doubles lie 2.4e-7 s apart.
    const bool coarse = one.text.find("1609060336.2") != std::string::npos;
    EXPECT_NEAR(samples.time.back(), 0.01, coarse ? 2.4e-7 : 1e-12) << one.kind;
    EXPECT_NEAR(samples.columns[0].front(), 1., 1e-12) << one.kind;
    EXPECT_NEAR(samples.columns[0].back(), 2., 1e-12) << one.kind;
  }
}

TEST(Series, GapsAreFilledAsIsAsked) {
  Case one{"", "time,F\n0,\n1,1\n2,NaN\n4,null\n5,3\n6,N/A\n", "F", {}};
  std::string why;
  one.more.gaps = Gaps::interpolate;
  auto series = read(one, why);
  ASSERT_TRUE(series) << why;
  EXPECT_EQ(series->cases[""].columns[0], (std::vector<double>{1., 1., 1.5, 2.5, 3., 3.}));
  one.more.gaps = Gaps::hold;
  series = read(one, why);
  ASSERT_TRUE(series) << why;
  EXPECT_EQ(series->cases[""].columns[0], (std::vector<double>{1., 1., 1., 1., 3., 3.}));
  one.more.gaps = Gaps::leave_out;
  series = read(one, why);
  ASSERT_TRUE(series) << why;
  EXPECT_EQ(series->cases[""].time, (std::vector<double>{1., 5.}));
}

TEST(Series, FramesCountFromTheFirstWithTheirSubFrames) {
  std::string why;
  const auto forces = read({"", nexus, "Fz", {}}, why);
  ASSERT_TRUE(forces) << why;
  EXPECT_EQ(forces->cases.at("").time, (std::vector<double>{0., 0.001, 0.002}));
  EXPECT_EQ(forces->columns[0].unit, "N");
  ASSERT_EQ(forces->notices.size(), 1U);
  EXPECT_NE(forces->notices[0].find("1000 a second"), std::string::npos);
  // A frame that was dropped leaves its time.
  const auto dropped = read({"", "Rate: 100\nFrame,F\n7,1\n8,1\n10,2\n", "F", {}}, why);
  ASSERT_TRUE(dropped) << why;
  EXPECT_EQ(dropped->cases.at("").time.back(), 0.03);
  // A column whose name begins like a time's is none.
  const auto torque = read({"", "SampleRate=100\nFrame,t_knee,F\n7,5,1\n8,4,2\n", "F", {}}, why);
  ASSERT_TRUE(torque) << why;
  EXPECT_EQ(torque->cases.at("").time.back(), 0.01);
}

TEST(Series, WhatWasAssumedIsSaidOnce) {
  std::string why;
  const auto dated = read({"", rostopic, "field.force.z", {}}, why);
  ASSERT_TRUE(dated) << why;
  ASSERT_EQ(dated->notices.size(), 1U);
  EXPECT_NE(dated->notices[0].find("counts from a date"), std::string::npos);
  const auto twice = read({"", "t,F\n0,1\n0,2\n1,3\n1,4\n", "F", {}}, why);
  ASSERT_TRUE(twice) << why;
  EXPECT_EQ(twice->cases.at("").columns[0], (std::vector<double>{2., 4.}));
  ASSERT_EQ(twice->notices.size(), 1U);
  EXPECT_NE(twice->notices[0].find("2 rows have the time of the row before, the first in line 3"),
            std::string::npos)
      << twice->notices[0];
}

TEST(Series, RefusesWithTheReasonAndTheFieldThatHelps) {
  const auto unit = with([](SeriesRequest& r) { r.unit = "furlong"; });
  const std::pair<Case, const char*> refused[]{
      {{"", "time,F\n0,1\n0.01,\n", "F", {}},
       "3: `` in the column `F` is not a finite number but a"},
      {{"", "time,F\n0,1\n0.01,nan\n", "F", {}}, "`gaps = interpolate`"},
      {{"", "time,F\n0,1\n0.01,inf\n", "F", {}}, "3: `inf` in the column `F` is not a finite"},
      {{"", "time,F\n0,1\n0.01,1x\n", "F", {}}, "`1x`"},
      {{"", "time,F\n0,1\n-1,2\n", "F", {}}, "3: its time, -1 s, is not after"},
      {{"", "time,F\n0,1\n1,2\n", "G", {}}, "no column `G`; its columns are `time`, `F`"},
      {{"", "0,1\n1,2\n", "F", {}}, "has no titles: its 2 columns have the numbers"},
      {{"", "time,F [furlong]\n0,1\n1,2\n", "F", {}}, "`furlong` of the column `F` is no unit"},
      {{"", "time,F\n0,1\n1,2\n", "F", unit}, "`furlong`"},
      {{"", "time [m],F\n0,1\n1,2\n", "F", {}}, "is no time"},
      {{"", "time,F\n1609060336768,1\n1609060336778,2\n", "F", {}}, "`time_unit = \"ms\"`"},
      {{"", "time,F\n1609060336768428032,1\n1609060336778428032,2\n", "F", {}},
       "`time_unit = \"ns\"`"},
      {{"", "Frame,F\n1,1\n2,2\n", "F", {}}, "`sample_rate = 100 Hz`"},
      {{"", "time,F\n12:00:00.0,1\n12:00:00.1,2\n", "F", {}}, "`sample_rate`"},
      {{"", "time,F,F\n0,1,1\n1,2,2\n", "F", {}}, "more than one column `F`"},
      {{"", ",Left,Right\ntime,F,F\n0,1,1\n1,2,2\n", "F", {}}, "say its group, too"},
      {{"", mot, "ground_force", {}}, "of OpenSim are `time`, `ground_force_vx`"},
      {{"", "time,F\n", "F", {}}, "no row of numbers"},
      {{"", "time,F\n0,nan\n1,nan\n", "F", with([](SeriesRequest& r) { r.gaps = Gaps::hold; })},
       "holds no number"},
      {{"", "time,F\n0,1\n1,2,3\n", "F", {}}, "expected 2 fields, found 3"},
      {{"", "Generated 2026\nHeart rated 70\nFrame,F\n1,1\n2,2\n", "F", {}}, "`sample_rate"},
      {{"", "time,F\n0,1\n1,2\n", "F", with([](SeriesRequest& r) {
          r.time = "time";
          r.sample_rate = 100.;
        })},
       "not by both"},
      {{"", "time,F\n0,\"\x1b[2J\"\n1,2\n", "F", {}}, "`?[2J`"},
  };
  for (const auto& [one, reason] : refused) {
    std::string why;
    EXPECT_FALSE(read(one, why)) << one.text;
    EXPECT_NE(why.find(reason), std::string::npos) << one.text << why;
  }
}

}  // namespace
}  // namespace hookpoint::text
