// The settings of a printed experiment by their trails, as `compare` tells of them.
#include "studies/run/setting_list.h"

#include <gtest/gtest.h>

namespace hookpoint::studies {
namespace {

TEST(SettingList, EveryObjectFieldAndWireGoesByItsTrail) {
  const auto settings = settings_of_text(R"(Plugin "/a {b}; c.so";
World world {
  deltat = 0.001 s;
  location = -1 m, 0 m, 2.5 m;
  title = "a = {b}; // c";
  Robot bot {
    Leg leg[2] {
      side = left;
    }
    Sensor.imu;
    Wire FROM world.time TO leg[2].x { rate = 100 s^-1; delay = 0.01 s; }
    Wire TO leg[2].x;
  }
}
)");
  const SettingList wanted{
      {"Plugin \"/a {b}; c.so\"", "there"},
      {"world", "World"},
      {"world.deltat", "0.001 s"},
      {"world.location", "-1 m, 0 m, 2.5 m"},
      {"world.title", "\"a = {b}; // c\""},
      {"world.bot", "Robot"},
      {"world.bot.leg[2]", "Leg"},
      {"world.bot.leg[2].side", "left"},
      {"world.bot.Sensor.imu", "Sensor.imu"},
      {"world.bot.Wire FROM world.time TO leg[2].x", "rate = 100 s^-1; delay = 0.01 s"},
      {"world.bot.Wire TO leg[2].x", "there"}};
  EXPECT_EQ(settings, wanted);
}

TEST(SettingList, SiblingsOfOneNameAreToldApart) {
  const auto settings =
      settings_of_text("Ground {\n  Patch { a = 1; }\n  Patch { a = 2; }\n}\nA x;\nB x;\n");
  const SettingList wanted{{"Ground", "Ground"},
                           {"Ground.Patch[0]", "Patch"},
                           {"Ground.Patch[0].a", "1"},
                           {"Ground.Patch[1]", "Patch"},
                           {"Ground.Patch[1].a", "2"},
                           {"x (A)", "A"},
                           {"x (B)", "B"}};
  EXPECT_EQ(settings, wanted);
}

TEST(SettingList, WhatIsNotOfTheLanguageHasNone) {
  EXPECT_FALSE(settings_of_text("World {"));
  EXPECT_FALSE(settings_of_text(""));
}

}  // namespace
}  // namespace hookpoint::studies
