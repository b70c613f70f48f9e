// A movie inside the page that shows it: its instants are the movie's, what its file says stays data, and
// wrong arguments leave nothing.
#include <gtest/gtest.h>

#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "apps/view/wire/base64.h"
#include "tests/support/command.h"
#include "tests/support/pendulum_movie.h"
#include "text/json_reader.h"

namespace hookpoint {
namespace {

using testing::CommandResult;
using testing::Workplace;

constexpr std::size_t time_at = 4, count_at = 10, values_at = 11;

/// The five parts of the recording in a page.
std::vector<std::string> parts_of(const std::string& page) {
  const std::string begin = "<script type=\"text/plain\" id=\"recording\">\n";
  const std::size_t from = page.find(begin) + begin.size();
  std::istringstream lines(page.substr(from, page.find("</script>", from) - from));
  std::vector<std::string> parts;
  for (std::string line; std::getline(lines, line);)
    parts.push_back(view::from_base64(line).value());
  return parts;
}

std::vector<std::vector<double>> instants_of(const std::vector<std::string>& parts) {
  std::vector<std::vector<double>> instants;
  std::size_t at = 0;
  std::istringstream sizes(parts[3].substr(1));
  for (std::size_t size = 0; sizes >> size; sizes.ignore(1)) {
    std::vector<double>& instant = instants.emplace_back(size / sizeof(double));
    std::memcpy(instant.data(), parts[4].data() + at, size);
    at += size;
  }
  EXPECT_EQ(at, parts[4].size());
  return instants;
}

class PageOfAMovie : public testing::PendulumMovie {};

TEST_F(PageOfAMovie, HasTheMoviesInstants) {
  const CommandResult made = place.hookpoint(
      "replay m.h5 --html pages/m.html --fps 100 --from '50 ms' --to '150 ms' --record '**.angle'");
  ASSERT_EQ(made.status, 0) << made.err;
  const std::vector<std::string> parts = parts_of(place.read("pages/m.html"));
  ASSERT_EQ(parts.size(), 5u);
  EXPECT_NE(parts[0].find("\"kind\": \"movie\""), std::string::npos) << parts[0].substr(0, 300);
  const std::size_t list = parts[1].find("\"values\"");
  const std::size_t place_of_angle = std::count(
      parts[1].begin() + static_cast<std::ptrdiff_t>(list),
      parts[1].begin() + static_cast<std::ptrdiff_t>(parts[1].find(".angle\"", list)), ',');
  const auto instants = instants_of(parts);
  ASSERT_EQ(instants.size(), 11u);
  for (std::size_t i = 0; i < instants.size(); ++i) {
    const double time = 0.05 + 0.01 * static_cast<double>(i);
    EXPECT_NEAR(instants[i].at(time_at), time, 1e-12);
    ASSERT_GT(instants[i].at(count_at), static_cast<double>(place_of_angle));
    const CommandResult at = place.hookpoint("replay m.h5 --at '" + std::to_string(time) +
                                             " s' --json --record '**.angle'");
    const std::size_t value = at.out.find("angle\": ") + 8;
    EXPECT_EQ(instants[i].at(values_at + place_of_angle), std::stod(at.out.substr(value))) << time;
  }
}

TEST_F(PageOfAMovie, IsTheSameEachTime) {
  for (const char* name : {"one.html", "two.html"})
    ASSERT_EQ(place.hookpoint(std::string("replay m.h5 --html ") + name).status, 0);
  EXPECT_EQ(place.read("one.html"), place.read("two.html"));
}

/// A file's words stand in the page as base64: they end no script.
TEST(PageOfAFile, TakesItsWordsAsData) {
  const Workplace place;
  const std::string evil = "</script><script>alert(1)</script>";
  place.file("evil.hook",
             std::string("World w { deltat = 1 ms; Robot r { Base.mobile { mass = 1 kg; "
                         "inertia = 1, 1, 1, 0, 0, 0; } } } Window { Text t { text = \"") +
                 evil + "\"; } }");
  ASSERT_EQ(place.hookpoint("run evil.hook --for '10 ms' --movie m.h5").status, 0);
  ASSERT_EQ(place.hookpoint("replay m.h5 --html m.html").status, 0);
  const std::string page = place.read("m.html");
  EXPECT_EQ(page.find(evil), std::string::npos);
  EXPECT_NE(parts_of(page)[0].find("alert(1)"), std::string::npos);
}

TEST_F(PageOfAMovie, RefusesWhatItCannotDo) {
  for (const auto& [arguments, said] : {
           std::pair("--html m.html --at '1 s'", "--html takes neither --at nor --about"),
           std::pair("--html m.html --film m.webm", "--film and --html are two calls"),
           std::pair("--html m.html --fps 0", "--fps takes a number"),
           std::pair("--html m.html --from '9 s'", "no moment of the movie"),
           std::pair("--html m.html --record nothing.here", "nothing.here"),
           std::pair("--fps 20", "give --film or --html"),
       }) {
    expect_refused(arguments, said);
    EXPECT_FALSE(std::filesystem::exists(place.folder() / "m.html")) << arguments;
  }
}

}  // namespace
}  // namespace hookpoint
