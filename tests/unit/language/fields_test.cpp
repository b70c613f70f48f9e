// A field that a class declares with a member: its default is the member's initialiser, and what a
// file gives goes into the member.
#include "language/tree/fields.h"

#include <gtest/gtest.h>

namespace hookpoint::language {

namespace {

enum class Colour { red, green };

struct Spec {
  double length = 1e-6;
  std::optional<double> limit;
  int count = 3;
  Vector3d place{0., 0.5, -1.};
  Quaterniond turn;
  std::string word = "here";
  Colour colour = Colour::green;
};

const Fields<Spec>& fields() {
  static const Fields<Spec> all{
      positive(number_field("length", "m", &Spec::length, "")),
      number_field("limit", "m", &Spec::limit, ""),
      integer_field("count", &Spec::count, ""),
      vector_field("place", "m", &Spec::place, ""),
      orientation_field("turn", &Spec::turn, ""),
      choice_field("word", {"here", "there"}, &Spec::word, ""),
      choice_field("colour", {"red", "green"}, &Spec::colour, ""),
      without_default(number_field("open", "m", &Spec::length, "")),
      required(number_field("needed", "m", &Spec::length, "")),
  };
  return all;
}

/// An object that gives what `given` fills of these fields.
struct Given {
  language::ClassSchema schema;
  language::Object object;
  const std::vector<language::Field> defaults;

  Given() {
    schema.fields = schemas(fields());
    object.schema = &schema;
    object.defaults = &defaults;
  }
  language::Field& add(std::string_view name) {
    language::Field field;
    field.schema = schema.find(name);
    field.given = true;
    object.fields.push_back(field);
    return object.fields.back();
  }
};

TEST(Fields, ADefaultIsTheMembersInitialiser) {
  std::vector<std::string> defaults;
  for (const FieldSchema& field : schemas(fields())) defaults.push_back(field.default_text);
  EXPECT_EQ(defaults, (std::vector<std::string>{"1e-6", "", "3", "0,0.5,-1", "1,0,0,0", "here",
                                                "green", "", ""}));
  EXPECT_EQ(default_text(0.001), "0.001");
  EXPECT_EQ(default_text(100000.), "100000");
}

TEST(Fields, WhatIsGivenGoesIntoItsMember) {
  Given given;
  given.object.fields.reserve(8);
  given.add("length").numbers = {2.};
  given.add("limit").numbers = {4.};
  given.add("count").numbers = {7.};
  given.add("place").numbers = {1., 2., 3.};
  given.add("turn").numbers = {0., 0., 0., 1.};
  given.add("word").words = {"there"};
  given.add("colour").words = {"red"};
  const Spec spec = load_fields(given.object, fields());
  EXPECT_EQ(spec.length, 2.);
  EXPECT_EQ(spec.limit, 4.);
  EXPECT_EQ(spec.count, 7);
  EXPECT_EQ(spec.place, (Vector3d{1., 2., 3.}));
  EXPECT_EQ(spec.turn.z, 1.);
  EXPECT_EQ(spec.word, "there");
  EXPECT_EQ(spec.colour, Colour::red);
}

TEST(Fields, WhatIsNotGivenStaysAsItIs) {
  Given given;
  given.add("length").words = {"auto"};
  Spec spec;
  spec.length = 5.;
  spec.count = 6;
  store_fields(given.object, fields(), spec);
  EXPECT_EQ(spec.length, 5.);
  EXPECT_EQ(spec.count, 6);
  EXPECT_FALSE(spec.limit);
}

}  // namespace
}  // namespace hookpoint::language
