// A movie as a film, made by a Chromium without a display and read back without what made it.
// ctest: clock
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

#include "tests/support/child_process.h"
#include "tests/support/chromium.h"
#include "tests/support/command.h"
#include "tests/support/folders.h"
#include "tests/support/pendulum_movie.h"

namespace hookpoint {
namespace {

using testing::CommandResult;
using testing::Workplace;

class FilmCommand : public testing::PendulumMovie {
 protected:
  void film(const std::string& arguments) {
    const CommandResult result = place.hookpoint("replay m.h5 " + arguments);
    ASSERT_EQ(result.status, 0) << arguments << '\n' << result.err;
    EXPECT_EQ(result.out, "");
  }
};

/// Width and height in a PNG's header (RFC 2083, 11.2.1).
std::pair<unsigned, unsigned> size_of_png(const std::string& bytes) {
  const auto number = [&](std::size_t at) {
    unsigned value = 0;
    for (std::size_t i = at; i < at + 4; ++i)
      value = value << 8 | static_cast<unsigned char>(bytes.at(i));
    return value;
  };
  return {number(16), number(20)};
}

TEST_F(FilmCommand, PicturesAreTheSameEachTime) {
  NEEDS_CHROMIUM;
  for (const char* folder : {"one", "two"})
    film(std::string("--film ") + folder + "/%05d.png --camera look.eye --size 321x200 --fps 50");
  EXPECT_FALSE(std::filesystem::exists(place.folder() / "one/00011.png"));
  for (int i = 0; i <= 10; ++i) {
    const std::string name = (i < 10 ? "/0000" : "/000") + std::to_string(i) + ".png";
    const std::string picture = place.read("one" + name);
    ASSERT_TRUE(picture.starts_with("\x89PNG\r\n\x1a\n")) << name;
    EXPECT_EQ(size_of_png(picture), std::pair(321U, 200U));
    EXPECT_EQ(picture, place.read("two" + name)) << name;
  }
  EXPECT_NE(place.read("one/00000.png"), place.read("one/00010.png")) << "nothing moves";
  // Another camera, and a part of the movie.
  film("--film far/%d.png --camera look.far --size 321x200 --fps 50 --from '100 ms' --to 0.14");
  EXPECT_NE(place.read("far/0.png"), place.read("one/00005.png"));
  EXPECT_EQ(place.read("far/2.png").substr(0, 4), "\x89PNG");
  EXPECT_FALSE(std::filesystem::exists(place.folder() / "far/3.png"));
}

/// What a <video> of another browser says of `file`: "WIDTH HEIGHT DURATION".
std::string seen_by_video(const Workplace& place, const std::string& file) {
  place.file("see.html",
             "<!doctype html><body>nothing</body><script>const v = document.createElement('video');"
             "v.onerror = () => document.body.textContent = 'error ' + v.error.message;"
             "v.ondurationchange = () => document.body.textContent = `seen ${v.videoWidth} "
             "${v.videoHeight} ${v.duration.toFixed(3)}`; v.src = '" +
                 file + "';</script>");
  const std::string folder = place.folder().string();
  const std::string command =
      "chromium --headless --no-sandbox --disable-gpu --no-first-run "
      "--allow-file-access-from-files "
      "--disable-background-networking --virtual-time-budget=10000 --user-data-dir='" +
      folder + "/profile' --dump-dom 'file://" + folder + "/see.html' >'" + folder +
      "/seen' 2>/dev/null";
  // On a busy machine the page's time can run out before the film is read: it says nothing then.
  std::string seen = "nothing";
  for (int i = 0; i < 3 && seen == "nothing"; ++i) {
    if (std::system(command.c_str()) != 0) return "chromium failed";
    const std::string page = place.read("seen");
    const std::size_t begin = page.find("<body>") + 6;
    seen = page.substr(begin, page.find('<', begin) - begin);
  }
  return seen;
}

TEST_F(FilmCommand, VideosLastAsLongAsTheirPictures) {
  NEEDS_CHROMIUM;
  for (const char* file : {"film.webm", "film.mp4"}) {
    film(std::string("--film ") + file + " --camera look.eye --size 320x200 --fps 25");
    // 0, 40, ... 200 ms: six pictures of 40 ms.
    EXPECT_EQ(seen_by_video(place, file).substr(0, 18), "seen 320 200 0.240") << file;
    EXPECT_FALSE(std::filesystem::exists(place.folder() / (std::string(file) + ".partial")));
  }
  EXPECT_EQ(place.read("film.webm").substr(0, 4), "\x1a\x45\xdf\xa3");  // EBML
  EXPECT_EQ(place.read("film.mp4").substr(4, 4), "ftyp");
}

/// A little-endian number of `count` bytes.
std::size_t number_at(const std::string& bytes, std::size_t at, std::size_t count) {
  std::size_t number = 0;
  while (count-- > 0) number = number << 8 | static_cast<unsigned char>(bytes.at(at + count));
  return number;
}

TEST_F(FilmCommand, AnAnimatedPictureHasItsFrames) {
  NEEDS_CHROMIUM;
  film("--film film.webp --camera look.eye --size 321x200 --fps 30");
  const std::string file = place.read("film.webp");
  ASSERT_EQ(number_at(file, 4, 4), file.size() - 8);
  int frames = 0;
  std::size_t lasts = 0;
  for (std::size_t at = 12; at < file.size();) {
    const std::size_t size = number_at(file, at + 4, 4);
    if (file.substr(at, 4) == "ANMF") {
      ++frames;
      EXPECT_EQ(number_at(file, at + 14, 3), 320U);
      EXPECT_EQ(number_at(file, at + 17, 3), 199U);
      EXPECT_TRUE(file.substr(at + 24, 3) == "VP8") << file.substr(at + 24, 4);
      lasts += number_at(file, at + 20, 3);
    }
    at += 8 + size + size % 2;
  }
  EXPECT_EQ(frames, 7);  // 0, 33 ... 200 ms
  EXPECT_EQ(lasts, 233U);
}

/// The time, the caption and the quality each make another picture.
TEST_F(FilmCommand, ACaptionIsInEachPicture) {
  NEEDS_CHROMIUM;
  film("--film plain/%d.png --camera look.eye --size 320x200 --fps 5 --bare");
  film("--film timed/%d.png --camera look.eye --size 320x200 --fps 5");
  film("--film named/%d.png --camera look.eye --size 320x200 --fps 5 --caption 'a pendulum'");
  film("--film rough/%d.png --camera look.eye --size 320x200 --fps 5 --bare --quality low");
  for (const char* picture : {"/0.png", "/1.png"}) {
    EXPECT_NE(place.read(std::string("plain") + picture),
              place.read(std::string("timed") + picture));
    EXPECT_NE(place.read(std::string("timed") + picture),
              place.read(std::string("named") + picture));
    EXPECT_NE(place.read(std::string("plain") + picture),
              place.read(std::string("rough") + picture));
  }
}

TEST_F(FilmCommand, WrongInputIsSaid) {
  expect_refused("--film film.avi", "--film takes FILE.webm, FILE.mp4, FILE.webp, or DIR/%05d.png");
  expect_refused("--film film.png", "--film takes FILE.webm, FILE.mp4, FILE.webp, or DIR/%05d.png");
  expect_refused("--film f%05d%d.png", "--film takes");
  expect_refused("--film f.webm --size 320", "--size takes WIDTHxHEIGHT");
  expect_refused("--film f.webm --size 320x99999", "--size takes WIDTHxHEIGHT");
  expect_refused("--film f.webm --size 321x200", "even numbers");
  expect_refused("--film f.webm --fps 0", "--fps takes a number");
  expect_refused("--film f.webm --fps many", "--fps takes a number");
  expect_refused("--film f.webm --camera look.nose",
                 "there is no camera `look.nose`; there are look.eye, look.far");
  expect_refused("--film f.webm --from 3",
                 "--from is no moment of the movie: it goes from 0 s to 0.2 s");
  expect_refused("--film f.webm --from 0.2 --to 0.1", "lies before --from");
  expect_refused("--film f.webm --at 0.1", "--film takes neither --at nor --about");
  expect_refused("--film f.webm --quality best", "--quality");
  expect_refused("--camera look.eye", "--film");
  expect_refused("--caption x", "--film");
  EXPECT_EQ(place.entries(), 2U) << "only the scene and its movie";
}

TEST_F(FilmCommand, WithoutABrowserThePackageIsNamed) {
  setenv("HOOKPOINT_BROWSER", "/nowhere/chromium", 1);
  CommandResult result = place.hookpoint("replay m.h5 --film f.webm");
  unsetenv("HOOKPOINT_BROWSER");
  EXPECT_EQ(result.status, 3) << result.err;
  EXPECT_NE(result.err.find("HOOKPOINT_BROWSER"), std::string::npos);
  const std::string command = "cd '" + place.folder().string() + "' && PATH=/nowhere '" +
                              testing::build_folder() +
                              "/hookpoint' replay m.h5 --film f.webm 2>.err";
  const int raw = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(raw), 3);
  const std::string said = place.read(".err");
  EXPECT_NE(said.find("apt-get install chromium"), std::string::npos) << said;
}

TEST_F(FilmCommand, ABrowserThatEndsIsNoFaultOfTheInput) {
  const std::filesystem::path browser =
      place.file("browser", "#!/bin/sh\necho no screen >&2\nexit 1\n");
  std::filesystem::permissions(browser, std::filesystem::perms::owner_all);
  setenv("HOOKPOINT_BROWSER", browser.c_str(), 1);
  const CommandResult result = place.hookpoint("replay m.h5 --film f.webm");
  unsetenv("HOOKPOINT_BROWSER");
  EXPECT_EQ(result.status, 3) << result.err;
  EXPECT_NE(result.err.find("the browser has ended by itself; it said: no screen"),
            std::string::npos)
      << result.err;
  EXPECT_FALSE(std::filesystem::exists(place.folder() / "f.webm"));
}

TEST_F(FilmCommand, AnInterruptLeavesNothingHalfWritten) {
  NEEDS_CHROMIUM;
  testing::ChildProcess program(
      place.folder(), {"replay", "m.h5", "--film", "f.webm", "--fps", "1000", "--size", "320x200"});
  ASSERT_TRUE(program.wait_until([&] { return program.err().find('%') != std::string::npos; }))
      << program.err();
  program.signal(SIGINT);
  EXPECT_EQ(program.wait(), 130);
  EXPECT_FALSE(std::filesystem::exists(place.folder() / "f.webm"));
  EXPECT_FALSE(std::filesystem::exists(place.folder() / "f.webm.partial"));
}

}  // namespace
}  // namespace hookpoint
