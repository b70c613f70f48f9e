// The folder of results: hashes, one writer at a time, what is cleared and what is refused.
#include "output/files/result_folder.h"

#include <gtest/gtest.h>

#include "output/files/hash.h"
#include "tests/support/command.h"

namespace hookpoint::output {
namespace {

namespace fs = std::filesystem;

class Results : public ::testing::Test {
 protected:
  /// A run that leaves `files`, each with its own name as its text.
  void run(const std::string& experiment, const std::vector<std::string>& files) {
    ResultFolder folder(place_.folder(), {experiment, {}, {}, {}}, files);
    for (const std::string& file : files)
      if (!file.ends_with('/')) write_file(place_.folder() / file, file);
    folder.finish();
  }
  /// What keeps a run that may write `names` out of the folder.
  std::string refusal(const std::vector<std::string>& names,
                      const std::vector<InputFile>& inputs = {}) {
    try {
      const ResultFolder folder(place_.folder(), {"other", {}, inputs, {}}, names);
    } catch (const FolderError& error) {
      return error.what();
    }
    return "";
  }
  bool has(const std::string& name) const { return fs::exists(place_.folder() / name); }

  testing::Workplace place_;
};

// The published values of XXH3's 128 bits, of nothing and of "abc".
TEST_F(Results, HashesAreXxh3) {
  EXPECT_EQ(hash_of_file(place_.file("empty", "")), "99aa06d3014798d86001c324468d497f");
  EXPECT_EQ(hash_of_file(place_.file("abc", "abc")), "06b05ab6733a618578af5f94892f3950");
  const std::string once = Hash().add("ab").add("c").text();
  EXPECT_EQ(once, Hash().add("ab").add("c").text());
  EXPECT_NE(once, Hash().add("a").add("bc").text());
  EXPECT_EQ(hash_of_program(), hash_of_file("/proc/self/exe"));
}

TEST_F(Results, AreListedWithTheirExperimentAndHashes) {
  run("first", {"a.csv", "sub/b.csv"});
  const auto manifest = read_manifest(place_.folder());
  ASSERT_TRUE(manifest);
  EXPECT_EQ(manifest->experiment, "first");
  EXPECT_EQ(manifest->files.at("sub/b.csv"), hash_of_file(place_.folder() / "sub/b.csv"));
  EXPECT_EQ(manifest->files.size(), 2u);
  EXPECT_FALSE(has(".lock"));
}

TEST_F(Results, AreWrittenAsOneListHasThem) {
  const std::vector<ResultFile> files{{"b.csv", [] { return "of b"; }},
                                      {"none.csv", [] { return ""; }},
                                      {"sub/a.csv", [] { return "of a"; }}};
  ResultFolder folder(place_.folder(), {"first", {}, {}, {}}, names_of(files));
  folder.write(files);
  EXPECT_EQ(folder.written(), (std::vector<std::string>{"b.csv", "sub/a.csv"}));
  EXPECT_EQ(place_.read("sub/a.csv"), "of a");
  EXPECT_FALSE(has("none.csv"));
  // Its place was not checked before the run.
  EXPECT_THROW(folder.write("c.csv", "of c"), std::logic_error);
  EXPECT_FALSE(has("c.csv"));
  folder.finish();
  EXPECT_EQ(read_manifest(place_.folder())->files.size(), 2u);
}

TEST_F(Results, OfAnEarlierRunAreCleared) {
  run("first", {"a.csv", "sub/b.csv"});
  place_.file("notes.txt", "mine");
  run("second", {"c.csv"});
  EXPECT_FALSE(has("a.csv"));
  EXPECT_FALSE(has("sub"));
  EXPECT_TRUE(has("c.csv"));
  EXPECT_EQ(place_.read("notes.txt"), "mine");
}

TEST_F(Results, OfAKilledRunAreCleared) {
  {
    const ResultFolder killed(place_.folder(), {"first", {}, {}, {}}, {"a.csv", "m.mat"});
    place_.file("a.csv.partial", "0");
    place_.file("m.mat.spool", "0");
  }
  EXPECT_EQ(read_manifest(place_.folder())->files.at("a.csv"), "");
  run("second", {"c.csv"});
  EXPECT_FALSE(has("a.csv.partial"));
  EXPECT_FALSE(has("m.mat.spool"));
}

TEST_F(Results, NeverTakeTheUsersFiles) {
  place_.file("a.csv", "mine");
  EXPECT_EQ(refusal({"a.csv"}),
            (place_.folder() / "a.csv").string() +
                " stands in the way, and hookpoint did not write it; move it away, or name another "
                "folder with --out");
  EXPECT_EQ(place_.read("a.csv"), "mine");
  EXPECT_FALSE(has("files.json"));
  EXPECT_EQ(refusal({"b.csv"}), "");
  fs::create_directory(place_.folder() / "rows");
  EXPECT_EQ(refusal({"rows/"}), "") << "an empty folder is in nobody's way";
  fs::create_directory(place_.folder() / "kept");
  place_.file("kept/mine", "mine");
  EXPECT_NE(refusal({"kept/"}), "");
}

TEST_F(Results, ThatWereChangedAreTheUsers) {
  run("first", {"a.csv", "b.csv"});
  place_.file("b.csv", "edited");
  EXPECT_NE(refusal({"a.csv"}).find("b.csv was changed since hookpoint wrote it"),
            std::string::npos);
  EXPECT_TRUE(has("a.csv")) << "nothing is cleared before all is known";
  EXPECT_EQ(read_manifest(place_.folder())->experiment, "first");
}

TEST_F(Results, AListThatIsNoneIsRefused) {
  for (const char* text : {"", "{}", "[1, 2]", "{\"files\": {}}", "no"}) {
    place_.file("files.json", text);
    EXPECT_NE(refusal({"a.csv"}).find("is not a list of files that hookpoint wrote"),
              std::string::npos)
        << text;
  }
}

TEST_F(Results, AListThatNamesWhatLiesOutsideRemovesNothing) {
  const testing::Workplace outside;
  const std::string precious = outside.file("precious.txt", "mine");
  const fs::path beside = fs::path("..") / outside.folder().filename() / "precious.txt";
  for (const std::string& name : {precious, beside.string(), "rows/../" + beside.string(),
                                  outside.folder().string() + "/", std::string()}) {
    place_.file("files.json", R"({"experiment": "first", "files": {")" + name + R"(": ""}})");
    EXPECT_NE(refusal({"a.csv"}).find("is not a list of files that hookpoint wrote"),
              std::string::npos)
        << name;
    EXPECT_EQ(outside.read("precious.txt"), "mine") << name;
  }
  place_.file("files.json", R"({"experiment": "first", "files": {"a..csv": ""}})");
  EXPECT_EQ(refusal({"b.csv"}), "");
}

TEST_F(Results, AFolderThatIsKeptStaysHookpoints) {
  run("first", {"rows/", "a.csv"});
  fs::create_directory(place_.folder() / "rows");
  place_.file("rows/00000.row", "0");
  run("second", {"b.csv"});
  EXPECT_TRUE(has("rows/00000.row"));
  EXPECT_EQ(refusal({"rows/"}), "");
}

TEST_F(Results, WhatARunReadsIsNotCleared) {
  run("first", {"movie.h5", "experiment.hook"});
  const std::string movie = (place_.folder() / "movie.h5").string();
  EXPECT_NE(refusal({"a.csv"}, {{movie, ""}}).find("is what this run reads"), std::string::npos);
  EXPECT_TRUE(has("movie.h5"));
  const std::string text = (place_.folder() / "experiment.hook").string();
  EXPECT_EQ(refusal({"experiment.hook"}, {{text, ""}}), "") << "text is read before";
}

TEST_F(Results, HaveOneWriterAtATime) {
  const ResultFolder first(place_.folder(), {"first", {}, {}, {}}, {"a.csv"});
  EXPECT_EQ(refusal({"b.csv"}), "another hookpoint (process " + std::to_string(getpid()) +
                                    ") writes into " + place_.folder().string() +
                                    "; wait for it, or name another folder with --out");
}

TEST_F(Results, AFolderThatCannotBeMadeIsTold) {
  const std::string file = place_.file("file", "");
  try {
    const ResultFolder folder(file, {"first", {}, {}, {}}, {"a.csv"});
    FAIL();
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("cannot make the folder " + file), std::string::npos);
  }
  EXPECT_THROW(ResultFolder(fs::path(file) / "sub", {"first", {}, {}, {}}, {"a.csv"}), FileError);
}

}  // namespace
}  // namespace hookpoint::output
