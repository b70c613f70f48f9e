// Runs as they are kept: bit for bit, known by their hashes, beside others of the same run.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>

#include "studies/cluster/journal.h"
#include "studies/cluster/run_list.h"
#include "studies/cluster/slurm_script.h"
#include "studies/run/run_store.h"
#include "tests/support/command.h"
#include "tests/support/record_scene.h"
#include "tests/support/store_file.h"

namespace hookpoint::studies {
namespace {

using testing::Workplace;

const std::string first_identity = "00112233445566778899aabbccddeeff";
const std::string second_identity = "ffeeddccbbaa99887766554433221100";

RunRecord awkward_record() {
  RunRecord record;
  record.status = "ended at 1 s: \"no\", it's over; end -- 100 %";
  record.notices = {"one", "two, with 3 numbers", ""};
  record.regime = Regime::slides;
  record.values["creep_speed"] = {0.1, -0.};
  record.values["least"] = {std::numeric_limits<double>::denorm_min(), 1. / 3.};
  record.values["none"] = {};
  record.curves["path"] = {3, {-0., 1e300, 0.1}};
  record.curves["speed, logarithmic"] = {};
  return record;
}

void expect_equal(const RunRecord& one, const RunRecord& other) {
  EXPECT_EQ(numbers_text(one), numbers_text(other));
  EXPECT_EQ(samples_bytes(one), samples_bytes(other));
}

TEST(Record, IsReadBackToTheLastBit) {
  const RunRecord record = awkward_record();
  auto read = read_numbers(numbers_text(record));
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->curves.at("path").samples.empty());
  ASSERT_TRUE(read_samples(samples_bytes(record), *read));
  EXPECT_EQ(read->status, record.status);
  EXPECT_EQ(read->notices, record.notices);
  EXPECT_EQ(read->regime, record.regime);
  EXPECT_TRUE(std::signbit(*read->values.at("creep_speed").predicted));
  EXPECT_EQ(read->values.at("least").measured, record.values.at("least").measured);
  EXPECT_FALSE(read->values.at("none").measured);
  EXPECT_TRUE(std::signbit(read->curves.at("path").samples[0]));
  expect_equal(*read, record);
}

TEST(Record, KnowsEveryByteThatIsMissingOrChanged) {
  const RunRecord record = awkward_record();
  const std::string numbers = numbers_text(record), samples = samples_bytes(record);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::string damaged = numbers;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    EXPECT_FALSE(read_numbers(damaged)) << i;
    EXPECT_FALSE(read_numbers(numbers.substr(0, i))) << i;
  }
  for (std::size_t i = 0; i < samples.size(); ++i) {
    auto read = read_numbers(numbers);
    std::string damaged = samples;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    EXPECT_FALSE(read_samples(damaged, *read)) << i;
    EXPECT_FALSE(read_samples(samples.substr(0, i), *read)) << i;
  }
}

TEST(Store, KeepsWhatWasSavedAndWhoseItIs) {
  const Workplace work;
  {
    RunStore store(work.folder(), false);
    store.save("creep", 3, first_identity, awkward_record());
    store.save_timing(second_identity, awkward_record());
  }
  RunStore store(work.folder(), true);
  expect_equal(store.load(first_identity).value(), awkward_record());
  EXPECT_TRUE(store.numbers(first_identity)->curves.at("path").samples.empty());
  EXPECT_EQ(store.assigned("creep", 3), first_identity);
  EXPECT_FALSE(store.assigned("creep", 2));
  EXPECT_FALSE(store.assigned("other", 3));
  EXPECT_FALSE(store.load(second_identity));
  EXPECT_TRUE(store.timing(second_identity));
  EXPECT_FALSE(store.timing(first_identity));
}

TEST(Store, WithoutKeepBeginsAnew) {
  const Workplace work;
  RunStore(work.folder(), false).save("creep", 3, first_identity, awkward_record());
  EXPECT_FALSE(RunStore(work.folder(), false).load(first_identity));
}

TEST(Store, AddsToARunWhatAnotherStudyMeasuredOfIt) {
  const Workplace work;
  RunStore store(work.folder(), false);
  RunRecord one, other;
  one.values["a"] = {1., {}};
  one.curves["c"] = {1, {1.}};
  other.values["b"] = {2., {}};
  other.curves["d"] = {2, {2., 3.}};
  store.save("one", 0, first_identity, one);
  store.save("other", 0, first_identity, other);
  const RunRecord both = store.load(first_identity).value();
  EXPECT_EQ(both.values.size(), 2u);
  EXPECT_EQ(both.curves.at("c").samples, std::vector{1.});
  EXPECT_EQ(both.curves.at("d").samples, (std::vector{2., 3.}));
}

TEST(Store, TakesFromManyThreads) {
  const Workplace work;
  RunStore store(work.folder(), false);
  {
    std::vector<std::jthread> threads;
    for (int thread = 0; thread < 4; ++thread)
      threads.emplace_back([&store, thread] {
        for (int i = 0; i < 50; ++i) {
          RunRecord record;
          record.values["x"] = {50. * thread + i, {}};
          store.save("s", static_cast<std::size_t>(50 * thread + i),
                     first_identity.substr(0, 24) + std::to_string(10000000 + 50 * thread + i),
                     record);
        }
      });
  }
  for (std::size_t i = 0; i < 200; ++i)
    EXPECT_EQ(store.load(store.assigned("s", i).value())->values.at("x").measured,
              static_cast<double>(i));
}

/// What opening the store in the folder says.
std::string refusal(const Workplace& work, bool keep = true) {
  try {
    RunStore store(work.folder(), keep);
    return "";
  } catch (const StoreError& error) {
    return error.what();
  }
}

TEST(Store, RefusesWhatIsNotItsOwn) {
  const Workplace work;
  work.file("runs.sqlite",
            "not a database, but long enough to be read as one: " + std::string(1000, 'x'));
  for (const bool keep : {true, false})
    EXPECT_NE(refusal(work, keep).find("move it away, or name another folder"), std::string::npos)
        << refusal(work, keep);
  EXPECT_TRUE(work.read("runs.sqlite").starts_with("not a database"));
  std::filesystem::remove(work.folder() / "runs.sqlite");
  testing::alter_database(work.folder() / "runs.sqlite", "CREATE TABLE mine(x)");
  for (const bool keep : {true, false})
    EXPECT_NE(refusal(work, keep).find("is no store of hookpoint's runs"), std::string::npos);
  testing::alter_database(work.folder() / "runs.sqlite", "INSERT INTO mine VALUES(1)");
}

TEST(Store, RefusesTablesThatSomethingElseHasChanged) {
  constexpr const char* endless =
      "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT x'00' AS identity, "
      "'' AS numbers, x'' AS samples FROM n";
  const std::string changes[] = {
      std::string("DROP TABLE run; CREATE VIEW run AS ") + endless,
      std::string("CREATE TRIGGER t AFTER INSERT ON run BEGIN DELETE FROM timing WHERE EXISTS (") +
          endless + " WHERE i < 0); END",
      "DROP TABLE run; CREATE TABLE run(identity BLOB, numbers TEXT, samples BLOB)",
      "CREATE INDEX more ON run(numbers)"};
  for (const std::string& change : changes) {
    const Workplace work;
    RunStore(work.folder(), false).save("creep", 3, first_identity, awkward_record());
    EXPECT_EQ(refusal(work), "");
    testing::alter_database(work.folder() / "runs.sqlite", change);
    for (const bool keep : {true, false})
      EXPECT_NE(refusal(work, keep).find("is a store that something else has changed"),
                std::string::npos)
          << change << ": " << refusal(work, keep);
  }
}

TEST(Store, RefusesARowThatNoRunHas) {
  const Workplace work;
  RunStore(work.folder(), false).save("creep", 3, first_identity, awkward_record());
  testing::alter_database(work.folder() / "runs.sqlite",
                          "UPDATE run SET numbers = hex(zeroblob(20000000))");
  const RunStore store(work.folder(), true);
  try {
    store.load(first_identity);
    FAIL() << "40 MB of numbers";
  } catch (const StoreError& error) {
    EXPECT_NE(std::string(error.what()).find("it holds what hookpoint does not write; move it"),
              std::string::npos)
        << error.what();
  }
}

TEST(Store, LeavesOneOfAnotherVersionAlone) {
  const Workplace work;
  RunStore(work.folder(), false).save("creep", 3, first_identity, awkward_record());
  testing::alter_database(work.folder() / "runs.sqlite", "PRAGMA user_version = 99");
  for (const bool keep : {true, false})
    EXPECT_NE(refusal(work, keep).find("of another version of hookpoint (tables 99, here 1)"),
              std::string::npos)
        << refusal(work, keep);
  testing::alter_database(work.folder() / "runs.sqlite", "PRAGMA user_version = 1");
  EXPECT_TRUE(RunStore(work.folder(), true).load(first_identity));
}

TEST(Store, HasOneWriter) {
  const Workplace work;
  RunStore store(work.folder(), false);
  store.save("creep", 3, first_identity, awkward_record());
  EXPECT_NE(refusal(work).find("wait for the program that has it open"), std::string::npos);
  EXPECT_TRUE(store.load(first_identity));
}

TEST(Store, OfAFullDiskKeepsWhatItHas) {
  const Workplace work;
  std::size_t saved = 0;
  {
    RunStore store(work.folder(), false);
    const testing::FileSizeLimit full(200'000);
    RunRecord record;
    record.curves["c"] = {1000, std::vector<double>(1000, 0.5)};
    const auto identity = [](std::size_t i) {
      return first_identity.substr(0, 24) + std::to_string(10000000 + i);
    };
    try {
      for (;; ++saved) store.save("s", saved, identity(saved), record);
    } catch (const StoreError& error) {
      EXPECT_NE(std::string(error.what()).find("make room on its disk; what it holds stays"),
                std::string::npos)
          << error.what();
    }
    EXPECT_GT(saved, 5u);
    EXPECT_TRUE(store.load(store.assigned("s", saved - 1).value()));
  }
  RunStore store(work.folder(), true);
  for (std::size_t i = 0; i < saved; ++i)
    EXPECT_TRUE(store.load(store.assigned("s", i).value())) << i;
  EXPECT_FALSE(store.assigned("s", saved));
}

TEST(Journal, IsReadAsItGrowsAndKnowsWhatIsTorn) {
  const Workplace work;
  const std::filesystem::path file = work.folder() / "runs.journal";
  JournalReader reader(file);
  EXPECT_FALSE(reader.next()) << "there is none yet";
  {
    Journal journal(file);
    EXPECT_THROW(Journal{file}, output::FileError) << "one writer";
    journal.add(first_identity, awkward_record());
    const auto read = reader.next();
    ASSERT_TRUE(read);
    EXPECT_EQ(read->first, first_identity);
    expect_equal(read->second, awkward_record());
    EXPECT_FALSE(reader.next());
  }
  const std::string whole = work.read("runs.journal");
  const std::string entry = journal_entry(second_identity, awkward_record());
  for (std::size_t length = 0; length < entry.size(); ++length) {
    work.file("runs.journal", whole + entry.substr(0, length));
    JournalReader again(file);
    EXPECT_TRUE(again.next());
    ASSERT_FALSE(again.next()) << length;
  }
  {
    Journal journal(file);
    EXPECT_TRUE(journal.has(first_identity));
    EXPECT_FALSE(journal.has(second_identity));
    journal.add(second_identity, awkward_record());
  }
  EXPECT_EQ(work.read("runs.journal"), whole + entry) << "what was torn is gone";
  const auto second = reader.next();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->first, second_identity);
}

TEST(Journal, OnAFullDiskEndsWithAWholeRecord) {
  const Workplace work;
  const std::filesystem::path file = work.folder() / "runs.journal";
  const std::string entry = journal_entry(first_identity, awkward_record());
  const testing::FileSizeLimit full(static_cast<rlim_t>(entry.size() + entry.size() / 2));
  Journal journal(file);
  journal.add(first_identity, awkward_record());
  EXPECT_THROW(journal.add(second_identity, awkward_record()), output::FileError);
  EXPECT_EQ(work.read("runs.journal"), entry);
}

TEST(RunList, IsReadBackAsItWasWritten) {
  const Workplace work;
  RunRequest run{"creep (ours, slope = 5 deg)",
                 first_identity,
                 {work.folder() / "a \"scene\".hook",
                  {{{"slope", "5 deg"}, {"a.b", "\"x\""}}, {{"world.engine", "dts"}}}},
                 {0.1,
                  1. / 3.,
                  {find_metric("creep_speed"), find_metric("fell")},
                  {{find_signal("speed"), true}, {find_signal("drift"), false}},
                  true}};
  work.file("list.json", run_list_text({{true, true, {"/engines/mine.hook"}}, {run, run}}));
  const RunList read = read_run_list(work.folder() / "list.json");
  EXPECT_TRUE(read.code.allow_plugins);
  EXPECT_TRUE(read.code.allow_engines);
  EXPECT_EQ(read.code.engine_files, std::vector<std::string>{"/engines/mine.hook"});
  ASSERT_EQ(read.runs.size(), 2u);
  for (const RunRequest& other : read.runs) {
    EXPECT_EQ(other.name, run.name);
    EXPECT_EQ(other.identity, run.identity);
    EXPECT_EQ(other.scene.file, run.scene.file);
    EXPECT_EQ(other.scene.options.parameters, run.scene.options.parameters);
    ASSERT_EQ(other.scene.options.overrides.size(), 1u);
    EXPECT_EQ(other.scene.options.overrides[0].trail, "world.engine");
    EXPECT_EQ(other.scene.options.overrides[0].value, "dts");
    EXPECT_EQ(other.measurement.settle, 0.1);
    EXPECT_EQ(other.measurement.duration, 1. / 3.);
    EXPECT_EQ(other.measurement.metrics, run.measurement.metrics);
    ASSERT_EQ(other.measurement.signals.size(), 2u);
    EXPECT_EQ(other.measurement.signals[0].name(), "speed, logarithmic");
    EXPECT_EQ(other.measurement.signals[1].name(), "drift");
    EXPECT_TRUE(other.measurement.path);
  }
  for (const char* text : {"", "[]", "{\"runs\": 3}", "{\"runs\": [{\"metrics\": [\"no\"]}]}",
                           "{\"runs\": [{\"signals\": [[\"no\", \"log\"]]}]}"}) {
    work.file("list.json", text);
    const bool refused = [&] {
      try {
        return read_run_list(work.folder() / "list.json").runs.empty();
      } catch (const RunListError&) {
        return true;
      }
    }();
    EXPECT_TRUE(refused) << text;
  }
}

TEST(SlurmScript, GivesEachMachineSomethingToDoAndSlurmNotTooMuch) {
  const SlurmSettings usual;
  EXPECT_EQ(runs_of_a_task(1, usual), 1u);
  EXPECT_EQ(runs_of_a_task(80, usual), 10u);
  EXPECT_EQ(runs_of_a_task(10'000, usual), 100u);
  EXPECT_EQ(runs_of_a_task(1'000'000, usual), 1000u);
  SlurmSettings chosen;
  chosen.chunk = 7;
  EXPECT_EQ(runs_of_a_task(1'000'000, chosen), 7u);
}

// The program of the script is echo here: what bash makes of the words is what it would be told.
// The formats of sbatch's manual: "minutes", "minutes:seconds", "hours:minutes:seconds",
// "days-hours", "days-hours:minutes" and "days-hours:minutes:seconds".
TEST(SlurmScript, TakesTimesAsSbatchDoes) {
  SlurmSettings settings;
  EXPECT_FALSE(problem_of(settings));
  for (const char* time : {"90", "0", "90:30", "2:00:00", "1-0", "1-12", "1-12:30", "1-12:30:15"}) {
    settings.time = time;
    EXPECT_FALSE(problem_of(settings)) << time;
  }
  for (const char* time : {"x", "1:2:3:4", "1-", "-1", "-", ":", "1:", ":30", "1::2", "1-2-3",
                           "1.5", "2h", "1-2:3:4:5", " 5", "5 ", "+5", "1e3", "123456789"}) {
    settings.time = time;
    ASSERT_TRUE(problem_of(settings)) << time;
    EXPECT_NE(problem_of(settings)->find("--time takes minutes, minutes:seconds"),
              std::string::npos);
  }
}

TEST(SlurmScript, HandsPathsOnAsTheyAre) {
  const Workplace work;
  const std::filesystem::path folder = work.folder() / "it's \"$(touch pwned)\" `id` \\ %j\n;&";
  std::filesystem::create_directories(folder);
  const SlurmPlace place{job_name("a;b c", folder), "/bin/echo", folder, "$HOME:a'b"};
  EXPECT_TRUE(place.name.starts_with("hookpoint-a_b_c-"));
  work.file("job.sh", slurm_script({}, place, folder, 3) + "");
  EXPECT_EQ(
      std::system(
          ("cd '" + work.folder().string() + "' && SLURM_ARRAY_TASK_ID=2 bash job.sh").c_str()),
      0);
  EXPECT_EQ(testing::read_file(log_of(folder, 2)),
            "runs " + list_of(folder, 2).string() + " --journal " + journal_of(folder, 2).string() +
                " --jobs 1\n");
  EXPECT_FALSE(std::filesystem::exists(work.folder() / "pwned"));
  EXPECT_FALSE(std::filesystem::exists(folder / "pwned"));
}

}  // namespace
}  // namespace hookpoint::studies
