// What a file says of windows, as a page is told it.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numbers>

#include "apps/view/widgets/panel.h"
#include "tests/support/folders.h"
#include "tests/support/page_blocks.h"
#include "tests/support/run_text.h"
#include "tests/support/shown_text.h"
#include "tests/support/text.h"
#include "text/json.h"
#include "text/json_reader.h"

namespace hookpoint {
namespace {

using view::Panel;
using view::Widget;

std::vector<const Widget*> all_of(const Panel& panel, const std::string& type) {
  std::vector<const Widget*> found;
  std::function<void(const std::vector<Widget>&)> visit = [&](const std::vector<Widget>& widgets) {
    for (const Widget& widget : widgets) {
      if (widget.type == type) found.push_back(&widget);
      if (const auto* frame = std::get_if<view::Frame>(&widget.content)) visit(frame->children);
    }
  };
  visit(panel.windows);
  return found;
}

Panel panel_of(Shown& shown) {
  return view::make_panel(shown.root(), shown.experiment(), shown.world().ports(),
                          shown.diagnostics());
}

std::string widgets_of(const Panel& panel) {
  text::JsonWriter json;
  view::write_panel(panel, json);
  return json.text();
}

const view::Valuator& valuator(const Widget& widget) {
  return std::get<view::Valuator>(widget.content);
}

class Figure7Panel : public ::testing::Test {
 protected:
  Figure7Panel()
      : shown_(std::filesystem::path(testing::source_folder()) /
               "configs/paper/fig7_two_joint_arm.hook"),
        panel_(panel_of(shown_)) {}
  const Widget& slider(std::size_t i) const { return *all_of(panel_, "Valuator.Slider").at(i); }

  Shown shown_;
  Panel panel_;
};

TEST_F(Figure7Panel, HasTenSlidersALightButtonAndAButton) {
  EXPECT_EQ(all_of(panel_, "Valuator.Slider").size(), 10u);
  EXPECT_EQ(all_of(panel_, "Button.Light").size(), 1u);
  EXPECT_EQ(all_of(panel_, "Button").size(), 1u);
  EXPECT_EQ(all_of(panel_, "Window.grob").size(), 1u);
  EXPECT_EQ(all_of(panel_, "Window").size(), 5u);
  EXPECT_EQ(shown_.told(), "");
}

TEST_F(Figure7Panel, NamesItsSlidersAsTheRunDoes) {
  EXPECT_EQ(slider(4).trail, "controllers.goal_angle");
  EXPECT_EQ(slider(7).trail, "controllers.goal_angle#2");
  EXPECT_EQ(valuator(slider(7)).port.trail, "controllers.goal_angle#2.value");
  const auto ports = shown_.world().ports();
  for (const std::string& trail : view::ports_of(panel_))
    EXPECT_TRUE(std::ranges::any_of(ports, [&](const auto& port) { return port.trail == trail; }))
        << trail;
}

TEST_F(Figure7Panel, HasTheRangesOfTheFile) {
  EXPECT_EQ(valuator(slider(4)).range, (view::Range{-3.2, 3.2}));
  EXPECT_EQ(valuator(slider(5)).range, (view::Range{100., 5000.}));
  EXPECT_EQ(valuator(slider(9)).range, (view::Range{4., 40.}));
}

// The goals at one end each, the constants of all controllers at either end of their sliders.
TEST(ArmsOfThePaper, AreTouchedAnywhereAndContinue) {
  for (const char* file : {"fig7_two_joint_arm.hook", "fig1b.hook"}) {
    const std::filesystem::path path =
        std::filesystem::path(testing::source_folder()) / "configs/paper" / file;
    Shown shown(path);
    const Panel panel = panel_of(shown);
    std::vector<view::Valuator> goals, constants;
    for (const Widget* slider : all_of(panel, "Valuator.Slider")) {
      const std::string& trail = slider->trail;
      if (trail.find("goal") != std::string::npos) goals.push_back(valuator(*slider));
      if (trail.find("constant") != std::string::npos) constants.push_back(valuator(*slider));
    }
    ASSERT_EQ(constants.size(), 2 * goals.size());
    for (unsigned corner = 0; corner < 1U << constants.size(); ++corner) {
      Running run(load_file(path));
      for (std::size_t i = 0; i < constants.size(); ++i) {
        const auto [least, greatest] = *constants[i].range;
        *run.port(constants[i].port.trail).writable = (corner >> i & 1U) != 0 ? greatest : least;
      }
      for (std::size_t i = 0; i < goals.size(); ++i) {
        const auto [least, greatest] = *goals[i].range;
        *run.port(goals[i].port.trail).writable = i % 2 == 0 ? greatest : least;
      }
      const double seconds = 1.;
      EXPECT_NO_THROW(run.step(static_cast<int>(seconds / shown.experiment().deltat)))
          << file << ", corner " << corner;
    }
  }
}

TEST_F(Figure7Panel, TakesTheRangesOfTheCamera) {
  constexpr double pi = std::numbers::pi;
  EXPECT_EQ(valuator(slider(0)).range, (view::Range{0.1, 10.}));
  EXPECT_EQ(valuator(slider(1)).range, (view::Range{0.2, 20.}));
  EXPECT_EQ(valuator(slider(1)).port.unit, "m");
  EXPECT_EQ(valuator(slider(2)).range, (view::Range{-pi, pi}));
  EXPECT_EQ(valuator(slider(3)).range, (view::Range{-pi / 2., pi / 2.}));
}

TEST_F(Figure7Panel, HasItsFrames) {
  const Widget& camera = *all_of(panel_, "Window.grob")[0];
  EXPECT_EQ(camera.width, 330.);
  EXPECT_EQ(camera.height, 330.);
  EXPECT_EQ(std::get<view::Camera>(camera.content).drawer, "SimpleWorld");
  const Widget& controllers = panel_.windows.at(1);
  EXPECT_EQ(controllers.width, 300.);
  EXPECT_EQ(controllers.height, std::nullopt);
  EXPECT_EQ(std::get<view::Frame>(controllers.content).children.at(0).label,
            "PD Controller for Joint 1");
  EXPECT_EQ(std::ranges::count(camera.ports,
                               std::pair<std::string, std::string>{"zoom", "videocam.zoom"}),
            1);
}

TEST_F(Figure7Panel, IsTheWidgetsOfTheProtocol) {
  const auto leaves = text::json_leaves(widgets_of(panel_));
  ASSERT_TRUE(leaves);
  const auto value = [&](const std::string& path) {
    const auto found =
        std::ranges::find(*leaves, path, &std::pair<std::string, std::string>::first);
    return found == leaves->end() ? "none at " + path : found->second;
  };
  EXPECT_EQ(value("[0].type"), "Window");
  EXPECT_EQ(value("[0].height"), "null");
  EXPECT_EQ(value("[0].children[0].type"), "Window.grob");
  EXPECT_EQ(value("[0].children[0].drawer"), "SimpleWorld");
  EXPECT_EQ(value("[0].children[0].follow"), "null");
  EXPECT_EQ(value("[0].children[0].ports.euler1"), "videocam.euler1");
  EXPECT_EQ(value("[0].children[0].show.shapes"), "true");
  EXPECT_EQ(value("[0].children[0].show.hooks"), "false");
  EXPECT_EQ(value("[0].children[1].children[4].port"), "pause.value");
  EXPECT_EQ(value("[1].children[1].children[0].trail"), "controllers.goal_angle#2");
  EXPECT_EQ(value("[1].children[1].children[0].range[1]"), "3.2000000000000002");
}

// What is not given is the input's: its value 3 reaches from -6 to 6 where the class says nothing.
TEST(Panel, WorksOutARangeFromTheValue) {
  ShownText shown(R"(
World w { }
Gain g { gain = 3; }
Controller.PD p { Wire FROM g.output TO current; }
Valuator.Dial open Wire TO g.gain;
Valuator.Dial zero Wire TO p.goal;
Valuator.Dial turned { range = -90 deg, 90 deg; Wire TO p.rate_in; }
Valuator.Counter stated { range = 1,2; increment = 0.25; Wire TO p.pconstant; }
)");
  const Panel panel = panel_of(*shown);
  EXPECT_EQ(shown->told(), "");
  ASSERT_EQ(panel.windows.size(), 4u);
  EXPECT_EQ(valuator(panel.windows[0]).range, (view::Range{-6., 6.}));
  EXPECT_EQ(valuator(panel.windows[1]).range, (view::Range{-1., 1.}));
  EXPECT_EQ(valuator(panel.windows[2]).port.unit, "rad");
  EXPECT_DOUBLE_EQ(valuator(panel.windows[2]).range->at(1), std::numbers::pi / 2.);
  EXPECT_EQ(valuator(panel.windows[3]).range, (view::Range{1., 2.}));
  EXPECT_EQ(valuator(panel.windows[3]).increment, 0.25);
}

constexpr const char* block_world = R"(
World w {
  Material clay { }
  Terrain.Flat ground { material = clay; }
  Robot block {
    Base.mobile { mass = 1; Shape.Cube dimensions = 0.1,0.1,0.1; location = 0,0,0.05; }
  }
}
)";

TEST(Panel, PlotsOverTimeAndOverEachOther) {
  ShownText shown(std::string(block_world) + R"(
Plot heights { show = w.block.position, w.block.velocity.z; range = 0,1; window = 5 s; }
Plot phase {
  Trace { x = w.block.position.x; y = w.block.velocity.x; label = "phase"; }
  x_range = -1,1; overlay = heights;
}
Plot.3D path {
  Trace { x = w.block.position.x; y = w.block.position.y; z = w.block.position.z; }
  Surface { x = w.block.position.x; y = w.block.position.y; z = w.block.velocity.z; }
}
)");
  const Panel panel = panel_of(*shown);
  EXPECT_EQ(shown->told(), "");
  const auto& heights = std::get<view::PlotShown>(panel.windows.at(0).content);
  ASSERT_EQ(heights.traces.size(), 4u);
  EXPECT_EQ(heights.traces[2].y.trail, "w.block.position.z");
  EXPECT_EQ(heights.traces[2].y.unit, "m");
  EXPECT_EQ(heights.traces[3].y.trail, "w.block.velocity.z");
  EXPECT_EQ(heights.traces[3].label, "w.block.velocity.z");
  EXPECT_FALSE(heights.traces[3].x);
  EXPECT_EQ(heights.range, (view::Range{0., 1.}));
  EXPECT_EQ(heights.window, 5.);
  const auto& phase = std::get<view::PlotShown>(panel.windows.at(1).content);
  EXPECT_EQ(phase.traces.at(0).x->trail, "w.block.position.x");
  EXPECT_EQ(phase.traces.at(0).label, "phase");
  EXPECT_EQ(phase.x_range, (view::Range{-1., 1.}));
  EXPECT_EQ(phase.overlay, "heights");
  EXPECT_EQ(phase.window, std::nullopt);
  const auto& path = std::get<view::Plot3dShown>(panel.windows.at(2).content);
  EXPECT_EQ(path.traces.at(0).z->trail, "w.block.position.z");
  EXPECT_EQ(path.surface->z->unit, "m/s");
  const auto watched = view::ports_of(panel);
  EXPECT_EQ(std::ranges::count(watched, "w.block.position.z"), 1);
  EXPECT_EQ(std::ranges::count(watched, "phase.range.y"), 1);
}

TEST(Panel, ShowsTextTablesAndChoices) {
  ShownText shown(std::string(block_world) + R"(
Text at { text = "at {0}, {1}"; values = w.block.position.x, w.time; digits = 6; }
Table all { rows = w.block.position, "block.**.velocity.x", w.step; }
Gain g { }
Button.Choice gait { choices = "hold", "walk"; Wire TO g.input; }
)");
  const Panel panel = panel_of(*shown);
  EXPECT_EQ(shown->told(), "");
  const auto& text = std::get<view::TextShown>(panel.windows.at(0).content);
  EXPECT_EQ(text.values.at(1).trail, "w.time");
  EXPECT_EQ(text.values.at(1).unit, "s");
  EXPECT_EQ(text.digits, 6);
  const auto& table = std::get<view::TableShown>(panel.windows.at(1).content);
  ASSERT_EQ(table.rows.size(), 5u);
  EXPECT_EQ(table.rows[0].label, "w.block.position.x");
  EXPECT_EQ(table.rows[3].trail, "w.block.base.velocity.x");
  EXPECT_EQ(table.rows[4].trail, "w.step");
  const auto& choice = std::get<view::Pressed>(panel.windows.at(2).content);
  EXPECT_EQ(choice.choices, (std::vector<std::string>{"hold", "walk"}));
  EXPECT_EQ(choice.port.trail, "gait.value");
}

// A camera goes with what snapshots have a pose of: a free obstacle is the base of a robot.
TEST(Panel, CamerasFollowObstacles) {
  ShownText shown(
      "World w { Obstacle.Box gate { dimensions = 1, 1, 1; } Obstacle.Sphere ball { radius = 0.1; mass = 1; "
      "free = true; } } Window.grob a { drawer = w; follow = w.gate; } Window.grob b { drawer = w; follow "
      "= w.ball; }");
  std::vector<std::string> followed;
  const Panel panel = panel_of(*shown);
  for (const Widget* camera : all_of(panel, "Window.grob"))
    followed.push_back(std::get<view::Camera>(camera->content).follow.value_or("nothing"));
  EXPECT_EQ(followed, (std::vector<std::string>{"w.gate", "w.ball.base"}));
}

TEST(Panel, SaysWhereATrailLeadsNowhere) {
  ShownText shown(std::string(block_world) + R"(Plot a { show = w.block.positoin; }
Plot b { Trace { y = w.block.position; } range = 2,1; }
Plot.3D c { Trace { y = w.block.position.x; } }
Text d { text = "{1}"; values = w.time; }
)");
  panel_of(*shown);
  const std::string told = shown->told();
  EXPECT_NE(told.find("9:17 `w.block.positoin`"), std::string::npos) << told;
  EXPECT_NE(told.find("10:22 `w.block.position` has 3 components; name one, such as "
                      "`w.block.position.x`"),
            std::string::npos)
      << told;
  EXPECT_NE(told.find("10:50 `range` takes the least value first: 1,2"), std::string::npos) << told;
  EXPECT_NE(told.find("11:13 a Trace of a Plot.3D needs `x`"), std::string::npos) << told;
  EXPECT_NE(told.find("12:17 `{1}` stands for none of the 1 `values`"), std::string::npos) << told;
}

// The file of docs/view.md as it stands there.
TEST(Panel, ReadsThePageOfTheManual) {
  const auto blocks = testing::blocks_of(
      testing::read_file(std::filesystem::path(testing::source_folder()) / "docs/view.md"));
  const auto block = std::ranges::find(blocks, "hook", &testing::PageBlock::language);
  ASSERT_NE(block, blocks.end());
  ShownText shown(block->text);
  const Panel panel = panel_of(*shown);
  EXPECT_EQ(shown->told(), "");
  for (const char* type : {"Window.grob", "Valuator.Slider", "Valuator.Dial", "Button.Light",
                           "Text", "Plot.3D", "Table"})
    EXPECT_EQ(all_of(panel, type).size(), 1u) << type;
  EXPECT_EQ(all_of(panel, "Plot").size(), 2u);
  EXPECT_EQ(valuator(*all_of(panel, "Valuator.Slider")[0]).port.unit, "N");
  const auto& table = std::get<view::TableShown>(all_of(panel, "Table")[0]->content);
  EXPECT_EQ(table.rows.back().trail, "lab.time");
  EXPECT_GT(table.rows.size(), 3u);
  // It is printed as a file that says the same.
  ShownText printed(language::print(shown->root()));
  EXPECT_EQ(widgets_of(panel_of(*printed)), widgets_of(panel));
}

TEST(Panel, PrintsFigure7AsItWas) {
  Shown shown(std::filesystem::path(testing::source_folder()) /
              "configs/paper/fig7_two_joint_arm.hook");
  ShownText printed(language::print(shown.root()));
  EXPECT_EQ(widgets_of(panel_of(*printed)), widgets_of(panel_of(shown)));
}

}  // namespace
}  // namespace hookpoint
