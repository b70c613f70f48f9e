// What takes too long or too much memory ends with words and a status, never by a signal.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "tests/support/command.h"
#include "tests/support/folders.h"

namespace hookpoint {
namespace {

using testing::CommandResult;
using testing::Workplace;

/// The least address space in which the program starts [MB]: each library that it is linked with takes
/// some.
int start_megabytes() {
  for (int megabytes = 100; megabytes < 10'000; megabytes += 100) {
    // With too little some libraries do not end before main begins.
    const std::string command = "ulimit -v " + std::to_string(1000 * megabytes) + "; timeout 20 '" +
                                testing::build_folder() + "/hookpoint' --version >/dev/null 2>&1";
    if (std::system(command.c_str()) == 0) return megabytes;
  }
  ADD_FAILURE() << "the program does not start";
  return 0;
}

/// `hookpoint ARGUMENTS` with at most so much address space more than it starts with [MB].
CommandResult limited(const Workplace& place, int megabytes, const std::string& arguments) {
  const std::string command = "ulimit -v " +
                              std::to_string(1000 * (start_megabytes() + megabytes)) + "; cd '" +
                              place.folder().string() + "' && '" + testing::build_folder() +
                              "/hookpoint' " + arguments + " >.out 2>.err";
  const int raw = std::system(command.c_str());
  return {WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw), place.read(".out"),
          place.read(".err")};
}

/// A box on rough ground whose cells are that wide.
std::string on_rough_ground(const std::string& engine, const std::string& spacing) {
  return "World w { deltat = 1 ms; duration = 2 ms; engine = " + engine +
         "; Terrain.Rough g { amplitude = 0.01; wavelength = 0.5; seed = 1; spacing = " + spacing +
         "; } Robot r { Base.mobile { location = 0, 0, 0.05; Shape.Box { dimensions = 0.1, 0.1, "
         "0.1; mass = 1; } } } }";
}

TEST(WorkBounds, GroundThatALibraryCannotHoldIsWrongInput) {
  const Workplace place;
  const std::string file = place.file("fine.hook", on_rough_ground("ode", "0.003"));
  const CommandResult result = place.hookpoint("run '" + file + "' --out out");
  EXPECT_EQ(result.status, 2) << result.err;
  EXPECT_NE(result.err.find("raise its spacing"), std::string::npos) << result.err;
}

#ifndef __SANITIZE_ADDRESS__
TEST(WorkBounds, TooLittleMemoryIsStatusThreeInWords) {
  const Workplace place;
  const std::string file = place.file("fine.hook", on_rough_ground("ode", "0.0072"));
  const CommandResult result = limited(place, 700, "run '" + file + "' --out out");
  EXPECT_EQ(result.status, 3) << result.err;
  EXPECT_NE(result.err.find("not enough memory"), std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("bad_alloc"), std::string::npos) << result.err;
}

// 4900 points in the ground: SUNDIALS found no memory for the Jacobian and read where it was not.
TEST(WorkBounds, ManyPointsUnderAnImplicitIntegratorStopWithAdvice) {
  const Workplace place;
  const std::string file =
      place.file("points.hook",
                 "World w { deltat = 1 ms; integrator = cvode_bdf; duration = 1 ms; Terrain.Flat g "
                 "{ } Robot r "
                 "{ Base.mobile { location = 0, 0, 0.05; mass = 1; inertia = 1,1,1,0,0,0; For i in "
                 "1..70 { For "
                 "j in 1..70 { ContactPoint { location = i*1 cm, j*1 cm, -0.051; } } } } } }");
  const CommandResult result = limited(place, 1300, "run '" + file + "' --out out");
  EXPECT_EQ(result.status, 2) << result.err;
  EXPECT_NE(result.err.find("fewer boundary_points"), std::string::npos) << result.err;
}
#endif

// A box half in the ground, thrown out of it: each of its 728 points leaves at an instant of its
// own, and each time a Jacobian of more than a thousand unknowns is made.
TEST(WorkBounds, OneStepOfAnImplicitIntegratorEndsWithinSeconds) {
  const Workplace place;
  const std::string file = place.file("box.hook",
                                      "World w { deltat = 1 ms; integrator = arkode_imex; duration "
                                      "= 1 ms; Terrain.Flat g { } Robot "
                                      "r { Base.mobile { Shape.Box { dimensions = 0.04, 0.12, "
                                      "0.03; mass = 5; boundary_points = 12; "
                                      "} } } }");
  const CommandResult result = place.hookpoint("run '" + file + "' --out out");
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_NE(result.err.find("factorisations of a Jacobian"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("fewer boundary_points"), std::string::npos) << result.err;
}

TEST(WorkBounds, MatricesOfThousandsOfJointsAreNotWritten) {
  const Workplace place;
  const std::string file = place.file(
      "chains.hook",
      "World w { deltat = 1 ms; Robot r { Base.fixed { } For i in 1..1500 { Chain c[i] { Link l { "
      "mass = 0.1; inertia = 1e-4,1e-4,1e-4,0,0,0; } } } } }");
  const CommandResult result = place.hookpoint("dynamics --json '" + file + "'");
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("robot 'r' has 1500 joints"), std::string::npos) << result.err;
  EXPECT_EQ(place.hookpoint("dynamics '" + file + "'").status, 0);
}

}  // namespace
}  // namespace hookpoint
