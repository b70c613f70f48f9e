// The store of a study's runs as SQLite's own command sees it.
#pragma once

#include <sqlite3.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace hookpoint::testing {

/// Does `command` in the SQLite file.
inline void alter_database(const std::filesystem::path& file, const std::string& command) {
  sqlite3* database = nullptr;
  const bool done = sqlite3_open(file.c_str(), &database) == SQLITE_OK &&
                    sqlite3_exec(database, command.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK;
  const std::string reason = sqlite3_errmsg(database);
  sqlite3_close(database);
  if (!done) throw std::runtime_error(reason);
}

/// What `question` has as its one answer.
inline int number_in_database(const std::filesystem::path& file, const std::string& question) {
  sqlite3* database = nullptr;
  sqlite3_stmt* statement = nullptr;
  const bool asked =
      sqlite3_open(file.c_str(), &database) == SQLITE_OK &&
      sqlite3_prepare_v2(database, question.c_str(), -1, &statement, nullptr) == SQLITE_OK &&
      sqlite3_step(statement) == SQLITE_ROW;
  const int number = asked ? sqlite3_column_int(statement, 0) : -1;
  const std::string reason = sqlite3_errmsg(database);
  sqlite3_finalize(statement);
  sqlite3_close(database);
  if (!asked) throw std::runtime_error(reason);
  return number;
}

/// Takes the run of row `row` out of the store in `folder`.
inline void remove_run(const std::filesystem::path& folder, int row) {
  alter_database(folder / "runs.sqlite",
                 "DELETE FROM run WHERE identity = (SELECT identity FROM assignment WHERE row = " +
                     std::to_string(row) + ")");
}

/// Holds the write lock of an SQLite file for as long as it lives.
class HeldDatabase {
 public:
  explicit HeldDatabase(const std::filesystem::path& file) {
    if (sqlite3_open(file.c_str(), &database_) != SQLITE_OK ||
        sqlite3_exec(database_, "BEGIN EXCLUSIVE", nullptr, nullptr, nullptr) != SQLITE_OK)
      throw std::runtime_error(sqlite3_errmsg(database_));
  }
  ~HeldDatabase() { sqlite3_close(database_); }
  HeldDatabase(const HeldDatabase&) = delete;
  HeldDatabase& operator=(const HeldDatabase&) = delete;

 private:
  sqlite3* database_ = nullptr;
};

}  // namespace hookpoint::testing
