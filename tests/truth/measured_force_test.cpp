// A force that was measured, 700 N + 100 N/s t for 1 s, as programs write it, drives a body of
// 71.36 kg from rest against its weight: the impulse is 50 N s, the speed 50/(700/9.81) = 0.7007 m/s.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/support/command.h"

namespace hookpoint {
namespace {

class MeasuredForce : public ::testing::Test {
 protected:
  /// Rows every 10 ms, made by `row` of the time [s] and the force [N].
  template <class Row>
  static std::string rows(Row row) {
    std::string text;
    for (int i = 0; i <= 100; ++i) text += row(i * 0.01, 700. + i);
    return text;
  }

  /// The run's speed against the closed form: the status of its Expect.
  testing::CommandResult run(const std::string& name, const std::string& table,
                             const std::string& fields) {
    place_.file(name, table);
    place_.file("push.hook", R"(
World lab { gravity = 9.81; deltat = 1 ms; duration = 1 s;
  Robot man { Base.mobile { location = 0, 0, 1; mass = 700/9.81; inertia = 1, 1, 1, 0, 0, 0; } }
  Force plate { body = man.base; }
  Data measured { file = ")" + name +
                                 "\"; " + fields + R"( Wire TO plate.force.z; }
  Record pushed { trails = lab.measured.output; }
}
Expect speed { of = lab.man.velocity.z; take = last; equals = 50/(700/9.81) * 1 m/s; tolerance = 0.15 %; }
)");
    return place_.hookpoint("run push.hook --out out");
  }
  void holds(const std::string& name, const std::string& table, const std::string& fields) {
    const testing::CommandResult result = run(name, table, fields);
    EXPECT_EQ(result.status, 0) << name << result.out << result.err;
  }

  testing::Workplace place_;
};

std::string line(double a, double b, const char* separator = ",", const char* before = "") {
  return before + std::to_string(a) + separator + std::to_string(b) + "\n";
}

TEST_F(MeasuredForce, IsObeyedInTheUnitsOfItsTable) {
  holds("ms_kn.csv",
        "time [ms],Fz [kN]\n" + rows([](double t, double f) { return line(1e3 * t, 1e-3 * f); }),
        "column = \"Fz\";");
  const std::string pushed = place_.read("out/pushed.csv");
  EXPECT_EQ(pushed.substr(0, pushed.find('\n')), "time [s],lab.measured.output [N]");
  holds("units.tsv", "Time\tFx\tFz\ns\tN\tkN\n" + rows([](double t, double f) {
                       return line(0., 1e-3 * f, "\t", (std::to_string(t) + "\t").c_str());
                     }),
        "column = \"Fz\";");
  holds("walk.mot",
        "walk\nversion=1\nnRows=101\nnColumns=2\ninDegrees=no\nendheader\ntime\tground_force_vy\n" +
            rows([](double t, double f) { return line(t, f, "\t"); }),
        "column = \"ground_force_vy\";");
  holds("bare.txt", rows([](double t, double f) { return line(t, f, " "); }), "column = \"2\";");
}

TEST_F(MeasuredForce, IsReadFromLoggersThatCountFromADateAndLoseSamples) {
  const std::string ros =
      "%time,field.header.frame_id,field.wrench.force.z\n" + rows([](double t, double f) {
        const long long stamp = 1609060336768428032LL + std::llround(t * 1e9);
        return std::to_string(stamp) + ",plate," + std::to_string(f) + "\n";
      });
  holds("plate.csv", ros, "column = \"field.wrench.force.z\";");
  EXPECT_NE(run("plate.csv", ros, "column = \"field.wrench.force.z\";").err.find("from a date"),
            std::string::npos);
  const std::string lost =
      "Time,Fz\n" + rows([](double t, double f) {
        const bool is_lost = t > 0.395 && t < 0.425;
        return std::to_string(t) + "," + (is_lost ? "" : std::to_string(f)) + "\n";
      });
  holds("lost.csv", lost, "column = \"Fz\"; gaps = interpolate;");
  const testing::CommandResult refused = run("lost.csv", lost, "column = \"Fz\";");
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("lost.csv:42: `` in the column `Fz`"), std::string::npos)
      << refused.err;
}

TEST_F(MeasuredForce, OfAnotherDimensionIsRefused) {
  const testing::CommandResult result =
      run("knee.csv", "time [s],knee [deg]\n0,0\n1,90\n", "column = \"knee\";");
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("in deg (rad)"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace hookpoint
