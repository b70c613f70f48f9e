// Movies as a user meets them: a run again at any moment, a run that goes on, and what is said of
// files that are none. Records of killed runs.
// ctest: long, released
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <sstream>

#include "control/data/table.h"
#include "tests/support/child_process.h"
#include "tests/support/command.h"
#include "tests/support/folders.h"
#include "tests/support/read_record.h"

namespace hookpoint {
namespace {

using testing::CommandResult;
using testing::Workplace;

/// A block slides down a slope under a controller with delay and noise that reads a file.
constexpr const char* sliding = R"(World w {
  gravity = 9.81; deltat = 1 ms; duration = 1.5; seed = 11;
  Material surface { static_friction = 0.3; kinetic_friction = 0.2; normal_stiffness = 20 kN/m;
    normal_damping = 40; tangential_stiffness = 20 kN/m; tangential_damping = 40; }
  Terrain.Slope ground { angle = 20 deg; material = surface; }
  Robot block { Base.mobile { rest_on = ground; Shape.Box { dimensions = 0.2, 0.2, 0.1; mass = 1 kg; } } }
  Force brake { body = block.base; force = 0, 0, 0; }
  ENGINE
}
Data goal { file = "goal.csv"; column = "y"; }
Controller.PD pd { pconstant = 20; dconstant = 3; rate = 130 Hz;
  Wire FROM goal.output TO goal; Wire FROM w.block.base.location.y TO current { delay = 9 ms; noise = 1 mm; }
  Wire FROM output TO w.brake.force.y; }
MOVIE
)";

constexpr const char* trails =
    "block.base.location.y,block.base.linear_acceleration.z,block.base.contact.force.z,"
    "block.base.contact.count,block.kinetic_energy,pd.previous,pd.current,brake.force.y";

std::string scene(std::string text, const std::string& movie = "", const std::string& engine = "") {
  text.replace(text.find("ENGINE"), 6, engine);
  return text.replace(text.find("MOVIE"), 5, movie);
}

class MovieCommand : public ::testing::Test {
 protected:
  void write(const std::string& movie = "", const std::string& engine = "") {
    place.file("goal.csv", "time,y\n0,0\n0.3,0.1\n1.5,-0.1\n");
    place.file("scene.hook", scene(sliding, movie, engine));
  }
  CommandResult fine(const std::string& arguments) {
    CommandResult result = place.hookpoint(arguments);
    EXPECT_EQ(result.status, 0) << arguments << '\n' << result.err;
    return result;
  }
  /// The one that a wrong input gets.
  void expect_refused(const std::string& arguments, const std::string& said) {
    const CommandResult result = place.hookpoint(arguments);
    EXPECT_EQ(result.status, 2) << arguments << '\n' << result.err;
    EXPECT_NE(result.err.find(said), std::string::npos) << arguments << '\n' << result.err;
    EXPECT_EQ(result.out, "");
  }
  /// The line of a trace at `time`, without it.
  std::string row(const std::string& trace, const std::string& time) {
    std::istringstream lines(place.read(trace));
    for (std::string line; std::getline(lines, line);) {
      const std::size_t comma = line.find(',');
      if (line[0] != 't' && std::abs(std::stod(line) - std::stod(time)) < 1e-9)
        return line.substr(comma + 1);
    }
    return "no row at " + time;
  }
  /// The values that replay prints, joined as in a trace.
  std::string replayed(const std::string& movie, const std::string& time) {
    const CommandResult result = fine("replay " + movie + " --at " + time + " --record " + trails);
    std::istringstream lines(result.out);
    std::string joined, line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
      std::istringstream words(line);
      std::string trail, value;
      words >> trail >> value;
      joined += (joined.empty() ? "" : ",") + value;
    }
    return joined;
  }

  /// Runs the scene, for far too long, until `file` has that many bytes.
  void kill_when_larger(const std::string& file, int bytes) {
    const std::string script =
        "cd '" + place.folder().string() + "'; '" + testing::build_folder() +
        "/hookpoint' run scene.hook --for 5000s --out run >.out 2>.err & pid=$!; cd '" +
        place.folder().string() + "'; while [ $(stat -c %s " + file +
        " 2>/dev/null || echo 0) -lt " + std::to_string(bytes) +
        " ] && kill -0 $pid; do sleep 0.02; done; kill -KILL $pid; wait $pid";
    const int raw = std::system(("{ " + script + "; } 2>/dev/null").c_str());
    ASSERT_EQ(WEXITSTATUS(raw), 128 + SIGKILL) << place.read(".err");
  }

  Workplace place;
};

TEST_F(MovieCommand, ReplayGivesWhatTheTraceHas) {
  write();
  fine("run scene.hook --out run --movie --record " + std::string(trails));
  for (const char* time : {"0", "0.001", "0.008", "0.3", "0.777", "1.499", "1.5"})
    EXPECT_EQ(replayed("run/movie.h5", time), row("run/trace.csv", time)) << time;
}

TEST_F(MovieCommand, BetweenRareInstantsNothingIsLost) {
  write("Movie rare { rate = 7 Hz; }");
  fine("run scene.hook --out run --record " + std::string(trails));
  const std::string summary = fine("replay run/rare.h5 --about").out;
  // 0, 1/7, ... 10/7 s and the end.
  EXPECT_NE(summary.find("instants     12,"), std::string::npos) << summary;
  for (const char* time : {"0", "0.142", "0.143", "0.144", "0.4", "1.43", "1.5"})
    EXPECT_EQ(replayed("run/rare.h5", time), row("run/trace.csv", time)) << time;
}

TEST_F(MovieCommand, AResumedRunIsTheRunThatWentOn) {
  write(
      "Movie film { rate = 50 Hz; } Record some { trails = w.block.base.location; rate = 90 Hz; }");
  const std::string recorded = " --record " + std::string(trails);
  fine("run scene.hook --out whole" + recorded);
  fine("run --resume whole/film.h5 --at \"613 ms\" --out rest" + recorded);
  for (const char* file : {"trace.csv", "some.csv"}) {
    const std::string whole = place.read(std::string("whole/") + file);
    const std::string rest = place.read(std::string("rest/") + file);
    const std::size_t header = rest.find('\n') + 1;
    EXPECT_EQ(rest.substr(0, header), whole.substr(0, header));
    EXPECT_GT(rest.size(), header + 1000);
    EXPECT_TRUE(whole.ends_with("\n" + rest.substr(header))) << file;
  }
  EXPECT_EQ(place.read("rest/trace.csv").find("0.613,"),
            place.read("rest/trace.csv").find('\n') + 1);
  // The movie of the rest is one of its own: it has what the whole run's has.
  EXPECT_EQ(replayed("rest/film.h5", "1.2"), row("whole/trace.csv", "1.2"));
  EXPECT_EQ(replayed("rest/film.h5", "0.613"), row("whole/trace.csv", "0.613"));
}

TEST_F(MovieCommand, GoesOnBeyondTheEnd) {
  write();
  fine("run scene.hook --for 1s --movie first.h5");
  fine("run scene.hook --out whole --record " + std::string(trails));
  fine("run --resume first.h5 --for 0.5s --out rest --record " + std::string(trails));
  const std::string rest = place.read("rest/trace.csv");
  EXPECT_TRUE(place.read("whole/trace.csv").ends_with(rest.substr(rest.find('\n'))));
  expect_refused("run --resume first.h5", "nothing is left to run from 1 s on");
  fine("run --resume first.h5 --for '1/4 * 2 s' --out half --record " + std::string(trails));
  EXPECT_EQ(place.read("half/trace.csv"), rest);
  expect_refused("run --resume first.h5 --for '1/2 s'", "--for takes a time such as");
}

TEST_F(MovieCommand, FilesOfTheExperimentAreInside) {
  write();
  fine("run scene.hook --out run --movie --record " + std::string(trails));
  for (const char* file : {"goal.csv", "scene.hook"})
    std::filesystem::remove(place.folder() / file);
  EXPECT_EQ(replayed("run/movie.h5", "0.9"), row("run/trace.csv", "0.9"));
}

TEST_F(MovieCommand, AllPortsAsJson) {
  write();
  fine("run scene.hook --for 0.1 --movie m.h5");
  const std::string json = fine("replay m.h5 --at 50ms --json").out;
  for (const char* has : {"\"world\": \"w\"", "\"time\": 0.050", "\"step\": 50",
                          "\"w.block.base.location.x\": ", "\"pd.output\": ", "\"w.impacts\": 0"})
    EXPECT_NE(json.find(has), std::string::npos) << has << '\n' << json;
}

// The one moment at which a kill may damage a movie is that in which HDF5 writes its tables, well
// under a millisecond a block: three kills do not all meet it.
TEST_F(MovieCommand, AKilledRunLeavesAMovie) {
  write("Movie film { rate = 100 Hz; }");
  CommandResult summary;
  for (int tries = 0; tries < 3 && summary.status != 0; ++tries) {
    kill_when_larger("run/film.h5.partial", 1'500'000);
    summary = place.hookpoint("replay run/film.h5.partial --about");
  }
  ASSERT_EQ(summary.status, 0) << summary.err;
  EXPECT_NE(summary.out.find("cut off"), std::string::npos);
  fine("run scene.hook --out whole --record " + std::string(trails));
  EXPECT_EQ(replayed("run/film.h5.partial", "1.234"), row("whole/trace.csv", "1.234"));
}

TEST_F(MovieCommand, WrongInputIsSaid) {
  write();
  fine("run scene.hook --for 0.2 --movie m.h5");
  expect_refused("replay nowhere.h5", "there is no file nowhere.h5");
  expect_refused("replay scene.hook", "scene.hook is no movie");
  expect_refused("replay m.h5 --at 0.3", "it goes from 0 s to 0.2 s");
  expect_refused("replay m.h5 --at -0.001", "there is no moment -0.001 s");
  expect_refused("replay m.h5 --at 0.0505", "there is no step at 0.0505 s: steps are 0.001 s long");
  expect_refused("replay m.h5 --at soon", "--at takes a time such as \"2.5 s\"");
  expect_refused("replay m.h5 --at \"3 m\"", "--at takes a time");
  expect_refused("replay m.h5 --json", "give it with --at");
  expect_refused("replay m.h5 --at 0.1 --record block.base.spin", "there is no port");
  expect_refused("run --resume m.h5 --set w.seed=3", "neither a FILE nor --set");
  expect_refused("run scene.hook --at 0.1", "it goes with --resume");
  expect_refused("run", "run takes a FILE, or --resume MOVIE");

  const std::string whole = place.read("m.h5");
  place.file("cut.h5", whole.substr(0, whole.size() / 2));
  expect_refused("replay cut.h5", "cut.h5 is cut short or damaged");
  place.file("record.hook", scene(sliding, "Record r { trails = w.time; format = hdf5; }"));
  fine("run record.hook --for 0.1 --out record");
  expect_refused("replay record/r.h5", "record/r.h5 is an HDF5 file, but no movie");
}

// The files that a movie holds lie in a temporary folder while it is replayed.
TEST_F(MovieCommand, AKilledReplayLeavesNothingForLong) {
  write();
  fine("run scene.hook --for 0.2 --movie m.h5");
  const std::filesystem::path temporary = place.folder() / "tmp";
  std::filesystem::create_directory(temporary);
  setenv("TMPDIR", temporary.c_str(), 1);
  const auto left = [&] {
    return std::distance(std::filesystem::directory_iterator(temporary),
                         std::filesystem::directory_iterator());
  };
  {
    testing::ChildProcess replay(place.folder(), {"replay", "m.h5", "--no-open"});
    ASSERT_TRUE(replay.wait_until([&] { return replay.out().find("http") != std::string::npos; }));
    EXPECT_EQ(left(), 1);
    fine("replay m.h5 --at 0.1");
    EXPECT_EQ(left(), 1) << "the one in use stays";
    replay.signal(SIGKILL);
    EXPECT_EQ(replay.wait(), 1000 + SIGKILL);
    EXPECT_EQ(left(), 1);
  }
  fine("replay m.h5 --at 0.1");
  EXPECT_EQ(left(), 0);
  {
    testing::ChildProcess replay(place.folder(), {"replay", "m.h5", "--no-open"});
    ASSERT_TRUE(replay.wait_until([&] { return replay.out().find("http") != std::string::npos; }));
    replay.signal(SIGHUP);
    EXPECT_EQ(replay.wait(), 0) << "as the interrupt key ends a window";
  }
  EXPECT_EQ(left(), 0);
  unsetenv("TMPDIR");
}

TEST_F(MovieCommand, MoviesOfOtherProgramsAreRefused) {
  ASSERT_EQ(testing::missing_h5py(), "");
  write();
  fine("run scene.hook --for 0.2 --movie m.h5");
  const auto replacing = [](const std::string& text, const std::string& old,
                            const std::string& by) {
    return "import numpy; t = f[\"" + text + "\"][()].replace(b\"" + old + "\", b\"" + by +
           "\"); del f[\"" + text + "\"]; f[\"" + text + "\"] = numpy.bytes_(t)";
  };
  const auto changed = [&](const char* name, const std::string& change) {
    std::filesystem::copy_file(place.folder() / "m.h5", place.folder() / name);
    EXPECT_TRUE(testing::runs("/usr/bin/python3 -c 'import h5py; f = h5py.File(\"" +
                              (place.folder() / name).string() + "\", \"r+\"); " + change + "'"));
  };
  changed("version.h5", "f.attrs[\"hookpoint_movie\"] = 2.");
  expect_refused("replay version.h5", "is a movie of layout 2; this program reads layout 1");
  changed("layout.h5", replacing("layout", "pconstant", "pconstent"));
  expect_refused("replay layout.h5 --at 0.1", "the movie's numbers are not those of this program");
  // One bit of one number of one instant.
  changed("bit.h5",
          "import numpy; s = f[\"state\"]; x = s[2, 100]; s[2, 100] = numpy.nextafter(x, 1)");
  expect_refused("replay bit.h5 --at 0.1", "the run does not repeat: at 0.1 s number 2 of `engine");
  changed("seed.h5", replacing("experiment", "seed = 11", "seed = 12"));
  expect_refused("run --resume seed.h5 --at 0.1 --for 1s", "the run does not repeat");
  changed("text.h5", replacing("experiment", "gravity", "gravty"));
  expect_refused("replay text.h5 --at 0.1", "the experiment inside the movie cannot be loaded");
  // Times that no run has.
  const char* times[] = {"f[\"time\"][2] = float(\"nan\")",
                         "f[\"time\"][-1] = float(\"inf\")",
                         "f[\"time\"][0] = -1.",
                         "f[\"time\"][2] = 0.1999",
                         "f.attrs[\"period\"] = float(\"nan\")",
                         "f.attrs[\"period\"] = 0."};
  for (std::size_t i = 0; i < std::size(times); ++i) {
    const std::string name = "times" + std::to_string(i) + ".h5";
    changed(name.c_str(), times[i]);
    for (const char* option : {" --about", " --at 0.1"})
      expect_refused("replay " + name + option, name + " is damaged: not all of it can be read");
  }
  changed("far.h5", "f[\"time\"][-1] = 1e300");
  expect_refused("replay far.h5 --at 0.1",
                 "the movie is damaged: no run with steps of 0.001 s reaches its time 1e+300 s");
  changed("none.h5", "f.attrs[\"hookpoint_movie\"] = float(\"nan\")");
  expect_refused("replay none.h5", "is a movie of layout nan");
}

// An engine that hides its state runs again to each moment, and every instant is compared on the way.
TEST_F(MovieCommand, EnginesThatHideTheirStateRunAgain) {
  for (const std::string engine : {"ode", "bullet"}) {
    write("Movie rare { rate = 7 Hz; }", "engine = " + engine + ";");
    const std::string run = "run_" + engine, movie = run + "/rare.h5";
    fine("run scene.hook --out " + run + " --record " + trails);
    for (const char* time : {"0", "0.142", "0.144", "1.499", "1.5"})
      EXPECT_EQ(replayed(movie, time), row(run + "/trace.csv", time)) << engine << time;
    fine("run --resume " + movie + " --at 0.7 --out rest_" + engine + " --record " + trails);
    EXPECT_EQ(row("rest_" + engine + "/trace.csv", "1.4"), row(run + "/trace.csv", "1.4"))
        << engine;
  }
}

// A run that is another one is not shown as the movie's.
TEST_F(MovieCommand, ARunThatDoesNotRepeatIsSaid) {
  ASSERT_EQ(testing::missing_h5py(), "");
  write("Movie rare { rate = 7 Hz; }", "engine = ode;");
  fine("run scene.hook --out run");
  const std::string change =
      "cd '" + place.folder().string() +
      "' && /usr/bin/python3 -c 'import h5py; f = h5py.File(\"run/rare.h5\", \"r+\"); "
      "f[\"state\"][0, 3] += 1e-9; f.close()'";
  ASSERT_EQ(std::system(change.c_str()), 0);
  expect_refused("replay run/rare.h5 --at 0.4", "the run does not repeat");
}

TEST_F(MovieCommand, MistakesInTheFileAreSaid) {
  write("Movie a { rate = 0 Hz; }");
  expect_refused("run scene.hook --out run", "`rate` must be greater than 0 Hz");
  write("Movie b { file = \"x/y.h5\"; }");
  expect_refused("run scene.hook --out run", "`x/y.h5` is no name of a file in the run's folder");
  write("Movie a; Movie c { file = \"a.h5\"; }");
  expect_refused("run scene.hook --out run", "another Movie writes `a.h5`");
  write("Movie a { file = \"movie.h5\"; }");
  expect_refused("run scene.hook --out run --movie", "give the movie that is added another name");
}

// The independent reader is our reader of other people's MAT files.
TEST_F(MovieCommand, AKilledMatlabRecordIsRecovered) {
  write("Record fall { trails = w.block.base.location; format = mat5; }");
  kill_when_larger("run/fall.mat.spool", 60'000);
  const std::string said = fine("recover run/fall.mat.spool").out;
  EXPECT_FALSE(std::filesystem::exists(place.folder() / "run/fall.mat.spool"));
  text::SeriesRequest request;
  request.columns = {"w_block_base_location_x.data"};
  const control::Table series = control::read_mat_table(place.folder() / "run/fall.mat", request);
  EXPECT_EQ(said, "run/fall.mat: " + std::to_string(series.time.size()) + " rows\n");
  EXPECT_GT(series.time.size(), 1000U);
  fine("run scene.hook --out whole --record block.base.location.x");
  EXPECT_EQ(series.columns[0][900], std::stod(row("whole/trace.csv", "0.9")));

  expect_refused("recover scene.hook", "it is no spool of a record");
  expect_refused("recover nowhere.spool", "cannot recover nowhere.spool");
}

}  // namespace
}  // namespace hookpoint
