// examples/controller_plugin as a newcomer meets it: hookpoint is installed, the example is copied
// out of the tree, and every command of its README is typed in.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "tests/support/command.h"
#include "tests/support/folders.h"
#include "tests/support/text.h"

namespace hookpoint {
namespace {

using testing::Workplace;
namespace fs = std::filesystem;

const fs::path source = testing::source_folder();

/// All ```sh blocks of a page, one after the other.
std::string commands(const std::string& page) {
  std::string script;
  const std::string open = "```sh\n", close = "```";
  for (std::size_t at = page.find(open); at != std::string::npos; at = page.find(open, at)) {
    at += open.size();
    script += page.substr(at, page.find(close, at) - at);
  }
  return script;
}

/// Runs a script from the source tree with the folder as HOME; its status, output in `log`.
int shell(const Workplace& place, const std::string& script) {
  place.file("script", "set -euxo pipefail\nunset HOOKPOINT_TRUSTED_PLUGINS\n" + script);
  const std::string folder = place.folder().string();
  const std::string command = "cd '" + source.string() + "' && HOME='" + folder + "' bash '" +
                              folder + "/script' >'" + folder + "/log' 2>&1";
  const int raw = std::system(command.c_str());
  return WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw);
}

/// The commands of the README with the build that is tested.
std::string readme() {
  std::string script =
      commands(testing::read_file(source / "examples/controller_plugin/README.md"));
  const std::string build = "build/release";
  const std::size_t at = script.find(build);
  EXPECT_NE(at, std::string::npos);
  return script.replace(at, build.size(), "'" + testing::build_folder() + "'");
}

/// angle(t) = goal + (angle(0) - goal)(1 + w t) exp(-w t), the critically damped joint of arm.hook.
double closed_form(double time) {
  const double goal = M_PI / 6., start = -M_PI / 3., w = 10.;
  return goal + (start - goal) * (1. + w * time) * std::exp(-w * time);
}

void expect_closed_form(const std::string& trace) {
  std::istringstream rows(trace.substr(trace.find('\n') + 1));
  double time = 0., angle = 0., worst = 0.;
  int count = 0;
  for (char comma = 0; rows >> time >> comma >> angle; ++count)
    worst = std::max(worst, std::abs(angle - closed_form(time)));
  EXPECT_EQ(count, 30001);
  // Torques are held for a step of 0.1 ms: late by w dt/2 = 0.05 % of the way of 90 deg.
  EXPECT_LT(worst, 1e-3 * M_PI / 2.);
  EXPECT_GT(worst, 0.);
  EXPECT_NEAR(angle, M_PI / 6., 1e-9) << "no sag at rest";
}

TEST(PluginExample, RunsAsItsReadmeSays) {
  const Workplace place;
  ASSERT_EQ(shell(place, readme()), 0) << place.read("log");
  const std::string log = place.read("log");
  EXPECT_NE(log.find("PD that carries the weight of its link"), std::string::npos) << log;
  EXPECT_NE(log.find("from the plugin: "), std::string::npos) << log;
  EXPECT_NE(log.find("arm.hook: fine"), std::string::npos) << log;
  expect_closed_form(place.read("my_controller/result/trace.csv"));

  const std::string installed = "export PATH=\"$HOME/hookpoint/bin:$PATH\"\ncd ~/my_controller\n";
  EXPECT_EQ(shell(place, installed + "hookpoint run arm.hook --out refused"), 2);
  EXPECT_NE(
      place.read("log").find("arm.hook:4:8: error: the plugin `build/libcompensated_pd.so` is "
                             "refused, since it would run with all of your rights: allow it "
                             "with --allow-plugins"),
      std::string::npos)
      << place.read("log");
  EXPECT_FALSE(fs::exists(place.folder() / "my_controller/refused"));

  // The installation moves; program, configs and package still find each other, and plugins put
  // into it are trusted and found by their name.
  const std::string moved = R"(mv ~/hookpoint ~/elsewhere
export PATH="$HOME/elsewhere/bin:$PATH"
cd ~/my_controller
echo 'World w { Include "materials/clay.hook"; }' >clay.hook
hookpoint print clay.hook
cp build/libcompensated_pd.so ~/elsewhere/lib/hookpoint/plugins/
rm -r build
sed 's|build/libcompensated|libcompensated|' arm.hook >plain.hook
hookpoint check plain.hook
cmake -S . -B again -G Ninja -DCMAKE_PREFIX_PATH="$HOME/elsewhere"
)";
  EXPECT_EQ(shell(place, moved), 0) << place.read("log");
}

}  // namespace
}  // namespace hookpoint
