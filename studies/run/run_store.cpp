#include "studies/run/run_store.h"

#include <fmt/format.h>
#include <sqlite3.h>
#include <sys/resource.h>

#include <cstdint>
#include <initializer_list>
#include <map>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>

namespace hookpoint::studies {
namespace {

namespace fs = std::filesystem;

/// "hkpt", in the file's header: whose it is. The version counts changes of the tables.
constexpr int application_id = 0x686b7074;
constexpr int table_version = 1;
constexpr int wait_for_lock = 20'000;  ///< [ms]; a slow disk keeps others waiting for seconds
/// A run has a number for each metric and a thousand numbers for each curve; both are far less.
constexpr int most_row_bytes = 16 << 20;
/// A statement finds or writes one row by its key: some hundred operations of the library.
constexpr int work_per_call = 10'000, most_work = 100;

constexpr const char* tables = R"(
  CREATE TABLE run(identity BLOB PRIMARY KEY, numbers TEXT NOT NULL, samples BLOB NOT NULL);
  CREATE TABLE assignment(study TEXT NOT NULL, row INTEGER NOT NULL, identity BLOB NOT NULL,
                          PRIMARY KEY(study, row)) WITHOUT ROWID;
  CREATE TABLE timing(identity BLOB PRIMARY KEY, numbers TEXT NOT NULL);
)";

/// Bytes of hexadecimal digits.
std::string bytes_of(const std::string& digits) {
  const auto value = [](char digit) { return digit <= '9' ? digit - '0' : digit - 'a' + 10; };
  std::string bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
    bytes += static_cast<char>(16 * value(digits[i]) + value(digits[i + 1]));
  return bytes;
}

std::string digits_of(std::string_view bytes) {
  std::string digits;
  for (const char byte : bytes) digits += fmt::format("{:02x}", static_cast<unsigned char>(byte));
  return digits;
}

/// Whether a write may have failed for a limit of this process: the library says nothing of it.
bool may_be_limited(int answer) {
  rlimit limit{};
  const int kind = answer & 0xff;
  return (kind == SQLITE_FULL || kind == SQLITE_IOERR) && getrlimit(RLIMIT_FSIZE, &limit) == 0 &&
         limit.rlim_cur != RLIM_INFINITY;
}

/// What the user can do about an answer of the library.
const char* remedy(int answer) {
  switch (answer & 0xff) {
    case SQLITE_FULL:
    case SQLITE_IOERR:
      return "make room on its disk; what it holds stays";
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return "wait for the program that has it open, or name another folder with --out";
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      return "move it away, or name another folder with --out; `sqlite3 FILE .recover` reads what "
             "is left of it";
    case SQLITE_TOOBIG:
    case SQLITE_INTERRUPT:
      return "it holds what hookpoint does not write; move it away, or name another folder with "
             "--out";
    default:
      return "see whether it may be read and written, or name another folder with --out";
  }
}

}  // namespace

/// The open file with its prepared questions.
class RunStore::Connection {
 public:
  explicit Connection(fs::path file) : file_(std::move(file)) {
    const int flags =
        SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_PRIVATECACHE;
    const int answer = sqlite3_open_v2(file_.c_str(), &database_, flags, nullptr);
    try {
      if (answer != SQLITE_OK) fail("open", answer);
      sqlite3_busy_timeout(database_, wait_for_lock);
      // Somebody else may have written the file: what it makes the library do is bounded.
      sqlite3_limit(database_, SQLITE_LIMIT_LENGTH, most_row_bytes);
      sqlite3_db_config(database_, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
      sqlite3_progress_handler(database_, work_per_call, count_work, this);
      // Exclusive: no memory shared with other processes, which a network's file system lacks. It
      // must be chosen before the log is.
      execute("PRAGMA locking_mode = EXCLUSIVE");
      check_ours();
      execute("PRAGMA journal_mode = WAL");
      // What is written survives the process; only a machine that stops may lose the last runs.
      execute("PRAGMA synchronous = NORMAL");
      execute("BEGIN EXCLUSIVE");
      if (number_of("PRAGMA user_version") == 0) {
        execute(tables);
        execute(fmt::format("PRAGMA application_id = {}", application_id));
        execute(fmt::format("PRAGMA user_version = {}", table_version));
      }
      execute("COMMIT");
    } catch (...) {
      close();
      throw;
    }
  }
  ~Connection() { close(); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void execute(const std::string& command) {
    work_ = 0;
    const int answer = sqlite3_exec(database_, command.c_str(), nullptr, nullptr, nullptr);
    if (answer == SQLITE_OK) return;
    fail("write", answer);
  }

  struct Blob {
    std::string_view bytes;
  };
  using Value = std::variant<Blob, std::string_view, std::int64_t>;
  using Row = std::vector<std::string>;

  /// The first row that `question` has, its columns as bytes; nothing for none.
  std::optional<Row> ask(const char* question, std::initializer_list<Value> values) {
    work_ = 0;
    sqlite3_stmt* statement = prepared(question);
    bind(statement, values);
    const int answer = sqlite3_step(statement);
    std::optional<Row> row;
    if (answer == SQLITE_ROW) {
      row.emplace();
      for (int i = 0; i < sqlite3_column_count(statement); ++i) {
        const auto* bytes = static_cast<const char*>(sqlite3_column_blob(statement, i));
        const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement, i));
        row->emplace_back(bytes == nullptr ? "" : bytes, bytes == nullptr ? 0 : size);
      }
    }
    sqlite3_reset(statement);
    if (answer != SQLITE_ROW && answer != SQLITE_DONE) fail("use", answer);
    return row;
  }

  /// `work` as a whole or not at all.
  template <class Work>
  void transaction(const Work& work) {
    execute("BEGIN IMMEDIATE");
    try {
      work();
      execute("COMMIT");
    } catch (...) {
      sqlite3_exec(database_, "ROLLBACK", nullptr, nullptr, nullptr);
      throw;
    }
  }

 private:
  [[noreturn]] void fail(const char* doing, int answer) const {
    const char* reason = database_ == nullptr ? sqlite3_errstr(answer) : sqlite3_errmsg(database_);
    throw StoreError(
        fmt::format("cannot {} {}: {}{}; {}", doing, file_.string(), reason,
                    may_be_limited(answer) ? " (or the limit of file sizes, `ulimit -f`)" : "",
                    remedy(answer)));
  }

  /// Ends a statement that takes more work than any of this program's.
  static int count_work(void* connection) {
    return ++static_cast<Connection*>(connection)->work_ > most_work ? 1 : 0;
  }

  int number_of(const char* question) {
    const auto row = ask(question, {});
    return row && !row->empty() ? std::stoi(row->front()) : 0;
  }

  void check_ours() {
    const int version = number_of("PRAGMA user_version");
    const bool empty = number_of("SELECT count(*) FROM sqlite_schema") == 0;
    if (empty && version == 0) return;
    if (number_of("PRAGMA application_id") != application_id)
      throw StoreError(file_.string() +
                       " is no store of hookpoint's runs; move it away, or name another folder "
                       "with --out");
    if (version != table_version)
      throw StoreError(fmt::format(
          "{} is a store of another version of hookpoint (tables {}, here {}): go on with that "
          "one, move the file away, or name another folder with --out",
          file_.string(), version, table_version));
    check_tables();
  }

  /// A view or a trigger under a table's name could do anything; each is refused before it is used.
  void check_tables() {
    const auto others =
        ask("SELECT count(*), group_concat(type || ' ' || name, ', ') FROM sqlite_schema "
            "WHERE sql IS NOT NULL AND instr(?, sql || ';') = 0",
            {std::string_view(tables)});
    if (others && others->front() != "0")
      throw StoreError(fmt::format(
          "{} is a store that something else has changed ({}); move it away, or name another "
          "folder with --out",
          file_.string(), others->back().substr(0, 100)));
  }

  sqlite3_stmt* prepared(const char* question) {
    sqlite3_stmt*& statement = statements_[question];
    if (statement != nullptr) return statement;
    const int answer =
        sqlite3_prepare_v3(database_, question, -1, SQLITE_PREPARE_PERSISTENT, &statement, nullptr);
    if (answer != SQLITE_OK) fail("use", answer);
    return statement;
  }

  void bind(sqlite3_stmt* statement, std::initializer_list<Value> values) {
    int index = 0;
    for (const Value& value : values) {
      ++index;
      int answer = SQLITE_OK;
      if (const auto* blob = std::get_if<Blob>(&value))
        answer = sqlite3_bind_blob64(statement, index, blob->bytes.data(), blob->bytes.size(),
                                     SQLITE_STATIC);
      else if (const auto* text = std::get_if<std::string_view>(&value))
        answer = sqlite3_bind_text64(statement, index, text->data(), text->size(), SQLITE_STATIC,
                                     SQLITE_UTF8);
      else
        answer = sqlite3_bind_int64(statement, index, std::get<std::int64_t>(value));
      if (answer != SQLITE_OK) fail("use", answer);
    }
  }

  void close() {
    for (const auto& [question, statement] : statements_) sqlite3_finalize(statement);
    statements_.clear();
    sqlite3_close(std::exchange(database_, nullptr));
  }

  fs::path file_;
  sqlite3* database_ = nullptr;
  int work_ = 0;  ///< calls of count_work since the statement began
  std::map<std::string_view, sqlite3_stmt*> statements_;
};

namespace {

/// The files of the store at `file`: SQLite's own beside it.
void remove_store(const fs::path& file) {
  for (const char* suffix : {"", "-wal", "-shm", "-journal"}) {
    std::error_code error;
    fs::remove(file.string() + suffix, error);
    if (error)
      throw StoreError("cannot remove " + file.string() + suffix + ": " + error.message() +
                       "; name another folder with --out");
  }
}

}  // namespace

RunStore::RunStore(const fs::path& folder, bool keep) {
  std::error_code error, ignored;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder, ignored))
    throw StoreError("cannot make the folder " + folder.string() + ": " +
                     (error ? error.message() : "a file has its name") +
                     "; --out names another folder");
  const fs::path file = folder / file_name;
  connection_ = std::make_unique<Connection>(file);
  if (keep) return;
  // It is hookpoint's, and nobody else has it open.
  connection_.reset();
  remove_store(file);
  connection_ = std::make_unique<Connection>(file);
}

RunStore::~RunStore() = default;

namespace {

std::optional<RunRecord> whole_record(const std::vector<std::string>& row) {
  auto record = read_numbers(row[0]);
  if (!record || !read_samples(row[1], *record)) return std::nullopt;
  return record;
}

}  // namespace

std::optional<RunRecord> RunStore::numbers(const std::string& identity) const {
  const std::string key = bytes_of(identity);
  const std::lock_guard lock(mutex_);
  const auto row =
      connection_->ask("SELECT numbers FROM run WHERE identity = ?", {Connection::Blob{key}});
  return row ? read_numbers(row->front()) : std::nullopt;
}

std::optional<RunRecord> RunStore::load(const std::string& identity) const {
  const std::string key = bytes_of(identity);
  const std::lock_guard lock(mutex_);
  const auto row = connection_->ask("SELECT numbers, samples FROM run WHERE identity = ?",
                                    {Connection::Blob{key}});
  return row ? whole_record(*row) : std::nullopt;
}

void RunStore::save(const std::string& study, std::size_t row, const std::string& identity,
                    RunRecord record) {
  const std::string key = bytes_of(identity);
  const std::lock_guard lock(mutex_);
  connection_->transaction([&] {
    const auto there = connection_->ask("SELECT numbers, samples FROM run WHERE identity = ?",
                                        {Connection::Blob{key}});
    auto known = there ? whole_record(*there) : std::nullopt;
    if (known) record.merge(std::move(*known));
    const std::string numbers = numbers_text(record), samples = samples_bytes(record);
    connection_->ask("INSERT OR REPLACE INTO run VALUES(?, ?, ?)",
                     {Connection::Blob{key}, std::string_view(numbers), Connection::Blob{samples}});
    connection_->ask(
        "INSERT OR REPLACE INTO assignment VALUES(?, ?, ?)",
        {std::string_view(study), static_cast<std::int64_t>(row), Connection::Blob{key}});
  });
}

void RunStore::assign(const std::string& study, std::size_t row, const std::string& identity) {
  const std::string key = bytes_of(identity);
  const std::lock_guard lock(mutex_);
  connection_->ask(
      "INSERT OR REPLACE INTO assignment VALUES(?, ?, ?)",
      {std::string_view(study), static_cast<std::int64_t>(row), Connection::Blob{key}});
}

std::optional<std::string> RunStore::assigned(const std::string& study, std::size_t row) const {
  const std::lock_guard lock(mutex_);
  const auto found = connection_->ask("SELECT identity FROM assignment WHERE study = ? AND row = ?",
                                      {std::string_view(study), static_cast<std::int64_t>(row)});
  return found ? std::optional(digits_of(found->front())) : std::nullopt;
}

std::optional<RunRecord> RunStore::timing(const std::string& identity) const {
  const std::string key = bytes_of(identity);
  const std::lock_guard lock(mutex_);
  const auto row =
      connection_->ask("SELECT numbers FROM timing WHERE identity = ?", {Connection::Blob{key}});
  return row ? read_numbers(row->front()) : std::nullopt;
}

void RunStore::save_timing(const std::string& identity, const RunRecord& record) {
  const std::string key = bytes_of(identity), numbers = numbers_text(record);
  const std::lock_guard lock(mutex_);
  connection_->ask("INSERT OR REPLACE INTO timing VALUES(?, ?)",
                   {Connection::Blob{key}, std::string_view(numbers)});
}

}  // namespace hookpoint::studies
