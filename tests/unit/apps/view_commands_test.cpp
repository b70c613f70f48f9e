// What a page may ask: the messages of docs/view_protocol.md, and those that are none.
#include <gtest/gtest.h>

#include <string>

#include "apps/view/wire/commands.h"

namespace hookpoint::view {
namespace {

template <class Kind>
Kind parsed(const std::string& message) {
  const Request request = parse_request(message);
  EXPECT_EQ(request.problem, "") << message;
  if (!request.command || !std::holds_alternative<Kind>(*request.command)) {
    ADD_FAILURE() << message;
    return {};
  }
  return std::get<Kind>(*request.command);
}

std::string problem_of(const std::string& message) {
  const Request request = parse_request(message);
  EXPECT_FALSE(request.command.has_value()) << message;
  return request.problem;
}

TEST(ViewCommands, SetsPortsWhoseTrailsHoldPointsAndBrackets) {
  const auto set =
      parsed<SetPorts>(R"({"id":7,"do":"set","values":{"pd1.goal":0.5,"gait.goal[3]":-1e-3}})");
  ASSERT_EQ(set.values.size(), 2U);
  EXPECT_EQ(set.values[0].first, "pd1.goal");
  EXPECT_EQ(set.values[0].second, 0.5);
  EXPECT_EQ(set.values[1].first, "gait.goal[3]");
  EXPECT_EQ(set.values[1].second, -1e-3);
  EXPECT_EQ(parse_request(R"({"id":7,"do":"pause"})").id, 7);
}

TEST(ViewCommands, TakesWhatTheProtocolLists) {
  EXPECT_EQ(parsed<ReadPorts>(R"({"id":1,"do":"read","trails":["a.b","c"]})").trails,
            (std::vector<std::string>{"a.b", "c"}));
  EXPECT_EQ(parsed<ListPorts>(R"({"id":1,"do":"trails"})").pattern, "**");
  EXPECT_EQ(parsed<ListPorts>(R"({"id":1,"do":"trails","pattern":"pd1.*"})").pattern, "pd1.*");
  EXPECT_TRUE(parsed<WatchPorts>(R"({"id":1,"do":"watch","trails":[]})").trails.empty());
  const auto trace =
      parsed<AskTrace>(R"({"id":1,"do":"trace","trails":["a"],"from":1,"to":2.5,"points":100})");
  EXPECT_EQ(trace.from, 1.);
  EXPECT_EQ(trace.to, 2.5);
  EXPECT_EQ(trace.points, 100U);
  parsed<Pause>(R"({"id":1,"do":"pause"})");
  parsed<view::Run>(R"({"id":1,"do":"run"})");
  EXPECT_EQ(parsed<StepOn>(R"({"id":1,"do":"step"})").count, 1);
  EXPECT_EQ(parsed<StepOn>(R"({"id":1,"do":"step","count":20})").count, 20);
  EXPECT_EQ(parsed<SetSpeed>(R"({"id":1,"do":"speed","factor":0.001})").factor, 0.001);
  EXPECT_EQ(parsed<SetSpeed>(R"({"id":1,"do":"speed","factor":0})").factor, 0.);
  EXPECT_EQ(parsed<Seek>(R"({"id":1,"do":"seek","time":1.5})").time, 1.5);
  parsed<Reset>(R"({"id":1,"do":"reset"})");
  const auto edit = parsed<EditField>(
      R"({"id":1,"do":"edit","trail":"w.clay.normal_stiffness","value":"30 kN/m"})");
  EXPECT_EQ(edit.trail, "w.clay.normal_stiffness");
  EXPECT_EQ(edit.value, "30 kN/m");
  parsed<ListFields>(R"({"id":1,"do":"fields"})");
  parsed<ListChanges>(R"({"id":1,"do":"changes"})");
  parsed<AskPatch>(R"({"id":1,"do":"patch"})");
  parsed<Quit>(R"({"id":1,"do":"quit"})");
}

TEST(ViewCommands, SaysWhatIsWrong) {
  EXPECT_EQ(problem_of("{"), "the message is not JSON");
  EXPECT_EQ(problem_of(""), "the message is not JSON");
  EXPECT_EQ(problem_of(R"({"do":"pause"})"), "`id` is missing");
  EXPECT_EQ(problem_of(R"({"id":1})"), "`do` is missing");
  EXPECT_NE(problem_of(R"({"id":1,"do":"explode"})").find("there is no `do` of that name"),
            std::string::npos);
  EXPECT_NE(problem_of(R"({"id":1.5,"do":"pause"})").find("whole number"), std::string::npos);
  EXPECT_NE(problem_of(R"({"id":1,"do":"set","values":{}})").find("names no port"),
            std::string::npos);
  EXPECT_EQ(problem_of(R"({"id":1,"do":"set","values":{"a.b":"fast"}})"),
            "`a.b` takes a finite number, not `fast`");
  EXPECT_NE(problem_of(R"({"id":1,"do":"set","values":{"a":1e999}})").find("JSON"),
            std::string::npos);
  EXPECT_NE(problem_of(R"({"id":1,"do":"speed","factor":-1})").find("0.001 to 1000"),
            std::string::npos);
  EXPECT_NE(problem_of(R"({"id":1,"do":"step","count":0})").find("whole number"),
            std::string::npos);
  EXPECT_EQ(problem_of(R"({"id":1,"do":"seek"})"), "`time` is missing");
}

/// The vectors of RFC 4648, section 10, behind the eight bytes that begin every PNG file.
TEST(ViewCommands, ReadsPictures) {
  const std::string signature = "\x89PNG\r\n\x1a\n";
  const auto picture = [](const std::string& name, const std::string& text) {
    return R"({"id":1,"do":"picture","name":")" + name + R"(","png":")" + text + "\"}";
  };
  EXPECT_EQ(parsed<KeepPicture>(picture("view-1.png", "iVBORw0KGgo=")).png, signature);
  EXPECT_EQ(parsed<KeepPicture>(picture("a.png", "iVBORw0KGgpmb29iYXI=")).png,
            signature + "foobar");
  EXPECT_EQ(problem_of(picture("a.png", "Zm9vYmFy")), "`png` is no PNG file");
  EXPECT_EQ(problem_of(picture("a.png", "iVBO*w0KGgo=")), "`png` is not base64");
  for (const char* name : {"../a.png", "/a.png", ".png", "a.html", "a/b.png", ""})
    EXPECT_NE(problem_of(picture(name, "iVBORw0KGgo=")).find("file's name"), std::string::npos);
}

}  // namespace
}  // namespace hookpoint::view
