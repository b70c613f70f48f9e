#include "text/json.h"

#include <gtest/gtest.h>

#include <limits>

#include "text/json_reader.h"

namespace hookpoint::text {
namespace {

TEST(Json, NestsAndIndents) {
  JsonWriter json;
  json.begin_object().member("world", "SimpleWorld").member("time", 0.).member("found", true);
  json.key("base").begin_object().key("linear_acceleration").numbers({0., 0., -9.81}).end_object();
  json.key("engines").begin_array().value("dts").value("ode").end_array();
  json.key("none").begin_array().end_array().member("count", std::uint64_t{18}).end_object();
  EXPECT_EQ(json.text(), R"({
  "world": "SimpleWorld",
  "time": 0,
  "found": true,
  "base": {
    "linear_acceleration": [0, 0, -9.8100000000000005]
  },
  "engines": [
    "dts",
    "ode"
  ],
  "none": [],
  "count": 18
}
)");
}

TEST(Json, WhatIsNotFiniteIsNull) {
  JsonWriter json;
  const double infinite = std::numeric_limits<double>::infinity();
  json.numbers({infinite, -infinite, std::numeric_limits<double>::quiet_NaN(), 1e300});
  EXPECT_EQ(json.text(), "[null, null, null, 1.0000000000000001e+300]\n");
}

TEST(Json, LeavesReadBackByTheirPaths) {
  JsonWriter json;
  json.begin_object().member("name", "a \"b\"\n\x01 \u00b5").key("list").begin_array();
  json.value(1).begin_object().member("x", -2.5e-3).end_object().end_array();
  json.key("none").begin_array().end_array().member("yes", true).key("no").null().end_object();
  const auto leaves = json_leaves(json.text());
  ASSERT_TRUE(leaves.has_value());
  const std::vector<std::pair<std::string, std::string>> wanted{
      {"name", "a \"b\"\n\x01 \u00b5"},
      {"list[0]", "1"},
      {"list[1].x", "-0.0025000000000000001"},
      {"yes", "true"},
      {"no", "null"}};
  EXPECT_EQ(*leaves, wanted);
}

TEST(Json, EveryEscapeOfTheStandardIsRead) {
  // RFC 8259, section 7: any character may be escaped, one above U+FFFF as two surrogates.
  const auto leaves = json_leaves(
      R"({"caf\u00e9": "\u00e9\u4e16\ud83d\ude00\/\b\f\r", "n": -0, "f": 1E+2, "u": "\u0000x"})");
  ASSERT_TRUE(leaves.has_value());
  const std::vector<std::pair<std::string, std::string>> wanted{
      {"caf\u00e9", "\u00e9\u4e16\U0001f600/\b\f\r"},
      {"n", "0"},
      {"f", "1E+2"},
      {"u", std::string("\0x", 2)}};
  EXPECT_EQ(*leaves, wanted);
  for (const char* text : {R"("\ud83d")", R"("\ude00\ud83d")", R"("\u12")", "\"\xff\"", "01"})
    EXPECT_FALSE(json_leaves(text).has_value()) << text;
}

TEST(Json, BytesThatAreNoTextBecomeReadable) {
  const auto leaves = json_leaves("[" + json_string("a\xff/b") + "]");
  ASSERT_TRUE(leaves.has_value());
  EXPECT_EQ((*leaves)[0].second, "a\ufffd/b");
}

TEST(Json, WhatIsNoDocumentIsNotRead) {
  for (const char* text :
       {"", "{", "{\"a\" 1}", "{\"a\": 1", "[1,]", "inf", "tru", "1 2", "\"open", "\"\\x\""})
    EXPECT_FALSE(json_leaves(text).has_value()) << text;
  EXPECT_FALSE(json_leaves(std::string(100000, '[')).has_value()) << "deep";
}

// 64 leaves within names of 512 bytes may take 32 KiB, not the product of what is in the document.
TEST(Json, ALongNameIsALeafsOwnAndNotThatOfMany) {
  const auto nested = [](std::size_t length) {
    const std::string name(length / 2, 'n');
    return json_leaves("{\"" + name + "\": {\"" + name + "\": [0, 1]}, \"" +
                       std::string(2000, 'm') + "\": 2}");
  };
  const auto leaves = nested(510);
  ASSERT_TRUE(leaves);
  EXPECT_EQ((*leaves)[1].first.size(), 511 + std::string("[1]").size());
  EXPECT_EQ((*leaves)[2].first.size(), 2000U);
  EXPECT_FALSE(nested(512)) << "with the dot 513";
}

TEST(Json, AValueHasItsMembersAndItems) {
  const auto root = read_json(
      R"({"name": "a.b", "a.b": 2.5, "list": [1, "two", {"x": true}], "empty": {}, "name": "later"})");
  ASSERT_TRUE(root);
  EXPECT_TRUE(root->is_object());
  ASSERT_NE(root->member("name"), nullptr);
  EXPECT_EQ(root->member("name")->text(), "a.b") << "the first of that name";
  EXPECT_FALSE(root->member("name")->number());
  EXPECT_EQ(root->member("a.b")->number(), 2.5) << "a point in a name is no path";
  EXPECT_EQ(root->member("a"), nullptr);
  const auto items = root->member("list")->items();
  ASSERT_EQ(items.size(), 3U);
  EXPECT_EQ(items[0].number(), 1.);
  EXPECT_EQ(items[1].text(), "two");
  EXPECT_EQ(items[2].member("x")->text(), "true");
  EXPECT_EQ(items[2].text(), "");
  EXPECT_TRUE(root->member("empty")->is_object());
  EXPECT_TRUE(root->member("empty")->members().empty());
  EXPECT_EQ(root->members().size(), 5U);
  EXPECT_FALSE(read_json("[\"inf\"]")->items()[0].number()) << "a finite one or none";
  // The 64th level is read, the 65th is not.
  EXPECT_TRUE(read_json(std::string(64, '[') + std::string(64, ']')));
  EXPECT_FALSE(read_json(std::string(65, '[') + std::string(65, ']')));
}

TEST(Json, EscapesWhatItMust) {
  EXPECT_EQ(json_string("a\"b\\c\n\t\x01 \u00b5"), "\"a\\\"b\\\\c\\n\\t\\u0001 \u00b5\"");
}

}  // namespace
}  // namespace hookpoint::text
