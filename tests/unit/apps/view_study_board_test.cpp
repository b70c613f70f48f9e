// What a page of studies is told and may ask: the messages of docs/view_protocol.md, read back leaf
// by leaf.
#include <gtest/gtest.h>

#include <map>

#include "apps/view/wire/study_board.h"
#include "text/json_reader.h"

namespace hookpoint::view {
namespace {

using Leaves = std::map<std::string, std::string>;

Leaves leaves_of(const std::string& message) {
  const auto leaves = text::json_leaves(message);
  EXPECT_TRUE(leaves) << message;
  return leaves ? Leaves(leaves->begin(), leaves->end()) : Leaves();
}

output::PanelPlot two_points() {
  output::Series series{
      "hook", 1 + 5 * output::style_colors, {{1., 2.}, {3., 4.}}, {{1.}, {3.5}}, {5.}};
  output::Plot plot{"by_slope",
                    "Creep",
                    "mu = 0.8",
                    {.label = "slope", .unit = "deg"},
                    {.label = "creep", .unit = "m/s", .logarithmic = true, .floor = 1e-9},
                    {series}};
  return {
      .name = "by_slope", .title = "Creep", .subtitle = "mu = 0.8", .across = 1, .panels = {plot}};
}

BoardStudy small_study() {
  BoardStudy study;
  study.name = "creep";
  study.title = "Does it \"creep\"?";
  study.question = "On a slope.";
  study.subjects = {{"hook", 3, "dts, hookpoint"}};
  study.columns = {{"slope", "deg", true, {}}, {"creep_speed", "m/s", false, {}}};
  study.rows = {{0, {10.}, "", "", {{}}}, {0, {20.}, "", "", {{}}}};
  study.figures = {{"What is drawn.", two_points()}};
  study.progress = {0, 2, 0.};
  return study;
}

StudyBoard board() { return {"creep.hook", "1.2.3", {small_study(), small_study()}}; }

TEST(StudyBoard, TheDescriptionSaysAllThatThereIs) {
  const Leaves leaves = leaves_of(board().description());
  const Leaves expected{{"tell", "description"},
                        {"protocol", "1"},
                        {"version", "1.2.3"},
                        {"kind", "study"},
                        {"title", "creep.hook"},
                        {"studies[1].title", "Does it \"creep\"?"},
                        {"studies[0].state", "waiting"},
                        {"studies[0].progress.total", "2"},
                        {"studies[0].subjects[0].colour", "#CC79A7"},
                        {"studies[0].subjects[0].marker", "3"},
                        {"studies[0].columns[0].varied", "true"},
                        {"studies[0].columns[1].unit", "m/s"},
                        {"studies[0].rows[1].varied[0]", "20"},
                        {"studies[0].rows[1].outcome", ""},
                        {"studies[0].rows[1].cells[0][0]", "null"},
                        {"studies[0].figures[0].kind", "curves"},
                        {"studies[0].figures[0].y.logarithmic", "true"},
                        {"studies[0].figures[0].x.unit", "deg"},
                        {"studies[0].figures[0].panels[0].series[0].measured.y[1]", "4"},
                        {"studies[0].figures[0].panels[0].series[0].predicted.y[0]", "3.5"},
                        {"studies[0].figures[0].panels[0].series[0].unfinished[0]", "5"},
                        // The second colour of the figures, and its first line that is not solid.
                        {"studies[0].figures[0].panels[0].series[0].colour", "#D55E00"},
                        {"studies[0].figures[0].panels[0].series[0].marker", "1"},
                        {"studies[0].figures[0].panels[0].series[0].dashes[0]", "2"},
                        {"studies[0].figures[0].panels[0].series[0].dashes[1]", "3"}};
  for (const auto& [path, value] : expected) {
    ASSERT_TRUE(leaves.contains(path)) << path;
    EXPECT_EQ(leaves.at(path), value) << path;
  }
}

TEST(StudyBoard, ARowIsToldOnceAndIsThenInTheDescription) {
  StudyBoard filled = board();
  const BoardRow row{0, {20.}, "finished", "ok", {{0.25, 0.5, false}}};
  const Leaves told = leaves_of(filled.set_row(1, 1, row));
  EXPECT_EQ(told.at("tell"), "row");
  EXPECT_EQ(told.at("study"), "1");
  EXPECT_EQ(told.at("row"), "1");
  EXPECT_EQ(told.at("cells[0][0]"), "0.25");
  EXPECT_EQ(told.at("cells[0][1]"), "0.5");
  EXPECT_EQ(told.at("cells[0][2]"), "false");
  EXPECT_EQ(filled.set_row(1, 1, row), "");
  const Leaves described = leaves_of(filled.description());
  EXPECT_EQ(described.at("studies[1].rows[1].outcome"), "finished");
  EXPECT_EQ(described.at("studies[0].rows[1].outcome"), "");
}

TEST(StudyBoard, AFigureIsToldWhereItIsAnother) {
  StudyBoard filled = board();
  output::PanelPlot plot = two_points();
  EXPECT_EQ(filled.set_figure(0, 0, {"What is drawn.", plot}), "");
  plot.panels[0].series[0].measured = {{1., 2., 3.}, {3., 4., 7.}};
  const Leaves told = leaves_of(filled.set_figure(0, 0, {"What is drawn.", plot}));
  EXPECT_EQ(told.at("tell"), "figure");
  EXPECT_EQ(told.at("panels[0].series[0].measured.y[2]"), "7");
  EXPECT_EQ(
      leaves_of(filled.description()).at("studies[0].figures[0].panels[0].series[0].measured.y[2]"),
      "7");
}

TEST(StudyBoard, AMapHasItsCellsRowAfterRow) {
  output::HeatMap map;
  map.name = "threshold";
  map.x_values = {1., 2.};
  map.y_values = {5.};
  map.panels = {{"hook", {{true, 0.5, 1.}, {true, {}, 0.}}}};
  StudyBoard filled = board();
  const Leaves told = leaves_of(filled.set_figure(0, 0, {"A map.", map}));
  EXPECT_EQ(told.at("kind"), "map");
  EXPECT_EQ(told.at("panels[0].values[0]"), "0.5");
  EXPECT_EQ(told.at("panels[0].values[1]"), "null");
  EXPECT_EQ(told.at("panels[0].predicted[1]"), "0");
}

TEST(StudyBoard, ProgressAndStateAreTold) {
  StudyBoard filled = board();
  const Leaves progress = leaves_of(filled.set_progress(1, {84, 208, 120.}));
  EXPECT_EQ(progress.at("tell"), "progress");
  EXPECT_EQ(progress.at("done") + "/" + progress.at("total"), "84/208");
  EXPECT_EQ(progress.at("seconds_left"), "120");
  const Leaves state = leaves_of(filled.set_state(1, BoardState::done, "out/report.html"));
  EXPECT_EQ(state.at("state"), "done");
  EXPECT_EQ(state.at("report"), "out/report.html");
  EXPECT_EQ(leaves_of(filled.description()).at("studies[1].progress.done"), "84");
}

TEST(StudyBoard, APageMayOpenARowThatIsThereAndQuit) {
  const StudyBoard there = board();
  const BoardRequest open =
      parse_board_request(R"({"id": 7, "do": "open", "study": 1, "row": 1})", there);
  ASSERT_TRUE(open.command);
  EXPECT_EQ(open.id, 7);
  EXPECT_EQ(std::get<OpenRow>(*open.command), (OpenRow{1, 1}));
  const BoardRequest quit = parse_board_request(R"({"id": 8, "do": "quit"})", there);
  ASSERT_TRUE(quit.command);
  EXPECT_TRUE(std::holds_alternative<QuitStudies>(*quit.command));
}

TEST(StudyBoard, AnythingElseIsRefusedWithItsReason) {
  const StudyBoard there = board();
  const std::map<std::string, std::string> refused{
      {"nonsense", "not JSON"},
      {R"({"do": "quit"})", "`id`"},
      {R"({"id": -1, "do": "quit"})", "`id`"},
      {R"({"id": 1})", "`do`"},
      {R"({"id": 1, "do": "set", "values": {"a": 1}})", "`open`"},
      {R"({"id": 1, "do": "open"})", "`study`"},
      {R"({"id": 1, "do": "open", "study": 2, "row": 0})", "`study`"},
      {R"({"id": 1, "do": "open", "study": 0, "row": 2})", "`row`"},
      {R"({"id": 1, "do": "open", "study": 0, "row": -1})", "`row`"},
      {R"({"id": 1, "do": "open", "study": 0, "row": 0.5})", "`row`"},
      {R"([1, 2])", "`id`"}};
  for (const auto& [message, reason] : refused) {
    const BoardRequest request = parse_board_request(message, there);
    EXPECT_FALSE(request.command) << message;
    EXPECT_NE(request.problem.find(reason), std::string::npos) << message << request.problem;
  }
}

TEST(StudyBoard, AnswersCarryTheRequestsNumber) {
  EXPECT_EQ(leaves_of(opened_answer(3, "http://h/?token=t")).at("url"), "http://h/?token=t");
  EXPECT_EQ(leaves_of(done_answer(4)).at("id"), "4");
  EXPECT_EQ(leaves_of(refused_answer(5, "no")).at("error"), "no");
  EXPECT_FALSE(leaves_of(refused_answer({}, "no")).contains("id"));
}

}  // namespace
}  // namespace hookpoint::view
