// What a study leaves for a paper, and what to cite.
// ctest: released
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/support/command.h"
#include "tests/support/text.h"
#include "text/json_reader.h"

namespace hookpoint {
namespace {

namespace fs = std::filesystem;
using testing::CommandResult;
using testing::has;
using testing::Workplace;

/// Two laws on two slopes; names and titles that TeX would obey.
constexpr const char* creep = R"(
Study creep {
  title = "Creep \\input{secret} of 100 % & more_";
  scene = "scenes/sloped_block.hook";
  duration = 0.5 s;
  settle = 0.3 s;
  Sweep slope { values = 5 deg, 10 deg; }
  Measure creep_speed;
  Measure penetration_mean;
  Subject hookpoint { contact = hookpoint; }
  Subject lugre { contact = lugre; }
  Truth none { metric = creep_speed; below = 1e-30 m/s; subjects = lugre; }
  Table by_slope { rows = subject; columns = slope; value = creep_speed; }
  Plot figure { x = slope; y = creep_speed; scale = log; }
}
)";

TEST(Publication, TablesAndFiguresAreThoseOfTheReport) {
  const Workplace place;
  place.file("creep.hook", creep);
  const CommandResult ran = place.hookpoint("study creep.hook --latex --out out");
  ASSERT_EQ(ran.status, 1) << ran.err;  // the Truth does not hold
  const std::string table = place.read("out/by_slope.tex");
  EXPECT_TRUE(has(table, "subject & 5 & 10 \\\\\n\\midrule\nhookpoint & ")) << table;
  EXPECT_TRUE(has(table, "$^{\\ast}$")) << table;
  EXPECT_TRUE(has(table, "hookpoint 0.1.0, experiment ")) << table;
  EXPECT_TRUE(has(place.read("out/summary.tex"),
                  "Creep \\textbackslash{}input\\{secret\\} of 100 \\% \\& more\\_"));
  EXPECT_TRUE(
      has(place.read("out/figure.tex"), "\\includegraphics[width=\\linewidth]{figure.pdf}"));
  EXPECT_EQ(place.read("out/figure.pdf").substr(0, 5), "%PDF-");
  const std::string document = place.read("out/tables_and_figures.tex");
  for (const std::string file : {"by_slope", "summary", "figure"})
    EXPECT_TRUE(has(document, "\\input{" + file + "}")) << document;
  const std::string list = place.read("out/files.json");
  for (const std::string file : {"by_slope.tex", "figure.pdf", "tables_and_figures.tex"})
    EXPECT_TRUE(has(list, file)) << list;
}

TEST(Publication, TheSameResultsGiveTheSameBytes) {
  const Workplace place;
  place.file("creep.hook", creep);
  place.hookpoint("study creep.hook --latex --out one");
  place.run("sleep 1.1");
  place.hookpoint("study creep.hook --latex --out other");
  for (const std::string file :
       {"by_slope.tex", "summary.tex", "figure.tex", "figure.pdf", "tables_and_figures.tex"}) {
    EXPECT_FALSE(place.read("one/" + file).empty()) << file;
    EXPECT_EQ(place.read("one/" + file), place.read("other/" + file)) << file;
  }
}

TEST(Publication, TheTimeZoneLeavesNoTrace) {
  const Workplace place;
  place.file("creep.hook", creep);
  const std::string program =
      "'" + testing::build_folder() + "/hookpoint' study creep.hook --pdf --out ";
  place.run("TZ=America/New_York " + program + "west");
  place.run("TZ=Asia/Tokyo " + program + "east");
  EXPECT_EQ(place.read("west/figure.pdf").substr(0, 5), "%PDF-");
  EXPECT_EQ(place.read("west/figure.pdf"), place.read("east/figure.pdf"));
}

TEST(Publication, TheDocumentCompiles) {
  const Workplace place;
  if (place.run("command -v pdflatex").status != 0) GTEST_SKIP() << "pdflatex is not installed";
  std::string odd = creep;
  odd.replace(odd.find("more_"), 5, "Größe Ω → ∞ 中 α ½ `a'' -- ?`");
  place.file("creep.hook", odd);
  place.hookpoint("study creep.hook --latex --out out");
  const CommandResult compiled = place.run(
      "sh -c 'cd out && pdflatex -halt-on-error -interaction=nonstopmode tables_and_figures.tex'");
  EXPECT_EQ(compiled.status, 0) << compiled.out;
}

TEST(Publication, NamesOfTheStudyItselfAreRefused) {
  const Workplace place;
  for (const std::string name : {"summary", "tables_and_figures"}) {
    std::string taken = creep;
    taken.replace(taken.find("Table by_slope"), 14, "Table " + name);
    place.file("taken.hook", taken);
    const CommandResult refused = place.hookpoint("study taken.hook --out " + name);
    EXPECT_EQ(refused.status, 2) << name;
    EXPECT_TRUE(has(refused.err, "the study itself leaves " + name + ".tex")) << refused.err;
  }
}

TEST(Publication, ResumingKeepsTheOptions) {
  const Workplace place;
  place.file("creep.hook", creep);
  place.hookpoint("study creep.hook --latex --out out");
  EXPECT_TRUE(has(place.read("out/report.html"), "hookpoint study creep.hook --latex"));
}

TEST(Publication, EachOptionLeavesItsOwnFiles) {
  const Workplace place;
  place.file("creep.hook", creep);
  place.hookpoint("study creep.hook --out plain");
  place.hookpoint("study creep.hook --pdf --out pdf");
  for (const std::string file : {"by_slope.tex", "figure.tex", "tables_and_figures.tex"}) {
    EXPECT_FALSE(fs::exists(place.folder() / "plain" / file)) << file;
    EXPECT_FALSE(fs::exists(place.folder() / "pdf" / file)) << file;
  }
  EXPECT_FALSE(fs::exists(place.folder() / "plain/figure.pdf"));
  EXPECT_TRUE(fs::exists(place.folder() / "pdf/figure.pdf"));
}

TEST(Citation, IsOfTheProgramAndOfWhatMadeTheResults) {
  const Workplace place;
  place.file("creep.hook", creep);
  const std::string plain = place.hookpoint("cite").out;
  EXPECT_TRUE(has(plain, "@software{hookpoint,")) << plain;
  EXPECT_TRUE(has(plain, "version = {0.1.0}")) << plain;
  EXPECT_TRUE(has(plain, "Reichler, James A.")) << plain;
  EXPECT_FALSE(has(plain, "lugre")) << plain;
  EXPECT_FALSE(has(plain, "keywords")) << plain;
  EXPECT_FALSE(has(plain, "NOTE")) << plain;
  place.hookpoint("study creep.hook --out out");
  const std::string of_results = place.hookpoint("cite out").out;
  EXPECT_TRUE(has(of_results, "canudas_de_wit_1995")) << of_results;
  EXPECT_TRUE(has(of_results, "note = {experiment ")) << of_results;
  EXPECT_FALSE(has(of_results, "todorov")) << of_results;
  place.hookpoint("run " + testing::config("scenes/sloped_block.hook") +
                  " --for 10ms --engine ode --out run");
  EXPECT_TRUE(has(place.hookpoint("cite run").out, "smith_ode"));
  place.hookpoint("run " + testing::config("scenes/sloped_block.hook") +
                  " --for 10ms --contact hunt_crossley --out law");
  EXPECT_TRUE(has(place.hookpoint("cite law").out, "hunt_crossley_1975"));
  place.run("mkdir several && mv out several/one");
  EXPECT_TRUE(has(place.hookpoint("cite several").out, "canudas_de_wit_1995"));
  place.run("mkdir broken && echo '{' >broken/files.json");
  EXPECT_EQ(place.hookpoint("cite broken").status, 2);
  place.run("mkdir empty");
  const CommandResult none = place.hookpoint("cite empty");
  EXPECT_EQ(none.status, 2);
  EXPECT_TRUE(has(none.err, "holds no results")) << none.err;
}

TEST(Citation, EveryEngineAndLawHasAnEntry) {
  const Workplace place;
  const std::string entries =
      testing::read_file(testing::source_folder() + "/configs/citations.bib");
  const auto list = text::read_json(place.hookpoint("engines --json").out);
  ASSERT_TRUE(list);
  int count = 0;
  for (const auto& [kinds, kind] : {std::pair{"engines", "engine "}, std::pair{"laws", "law "}})
    for (const text::JsonValue& each : list->member(kinds)->items()) {
      const std::string keyword = kind + each.member("name")->text();
      const bool listed = has(entries, "{" + keyword + "}") || has(entries, keyword + ",") ||
                          has(entries, ", " + keyword + "}");
      EXPECT_TRUE(listed) << keyword;
      ++count;
    }
  EXPECT_GE(count, 17);
}

TEST(Publication, AWallLeavesItsTruthsAndItsCard) {
  const Workplace place;
  const CommandResult ran =
      place.hookpoint("fixture run hookpoint impulse --latex --jobs 2 --out card");
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_TRUE(has(place.read("card/summary.tex"), "scene & truth & closed form & "));
  EXPECT_TRUE(has(place.read("card/scores.tex"), "truth & hookpoint & impulse \\\\"));
  EXPECT_EQ(place.read("card/score_card.pdf").substr(0, 5), "%PDF-");
}

}  // namespace
}  // namespace hookpoint
