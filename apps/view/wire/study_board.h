// What a page shows of studies: tables and figures that fill while they run. Pure data, and the
// messages that tell it (docs/view_protocol.md, "Studies").
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "output/figures/heat_map.h"
#include "output/figures/plot.h"

namespace hookpoint::text {
class JsonWriter;
}

namespace hookpoint::view {

struct BoardColumn {
  std::string name;                  ///< "creep_speed"
  std::string unit;                  ///< "m/s"; "" for none
  bool varied = false;               ///< by the study; else measured
  std::vector<std::string> names{};  ///< of the values 0, 1, ..., where these stand for something
};

struct BoardSubject {
  std::string name;         ///< "dts_hookpoint"
  int style = 0;            ///< its look in figures (output::series_style)
  std::string composition;  ///< "dts, hookpoint, semi_implicit_euler"
};

struct BoardCell {
  std::optional<double> measured, predicted;
  std::optional<bool> ok;  ///< verdict of the Truths that cover it, if any
  bool operator==(const BoardCell&) const = default;
};

struct BoardRow {
  std::size_t subject = 0;
  std::vector<double> varied;    ///< one a column that is varied, in its unit
  std::string outcome;           ///< "finished", "stopped", "skipped"...; "" while it is to come
  std::string status;            ///< "ok", or what stopped the run
  std::vector<BoardCell> cells;  ///< one a column that is measured
  bool operator==(const BoardRow&) const = default;
};

struct BoardFigure {
  std::string caption;
  /// A figure without panels is one panel without a title.
  std::variant<output::PanelPlot, output::HeatMap> drawing;
};

struct BoardProgress {
  std::size_t done = 0, total = 0;
  double seconds_left = 0.;
};

enum class BoardState { waiting, running, done, interrupted };

struct BoardStudy {
  std::string name, title, question;
  std::vector<BoardSubject> subjects;
  std::vector<BoardColumn> columns;  ///< varied ones first
  std::vector<BoardRow> rows;
  std::vector<BoardFigure> figures;
  BoardProgress progress;
  BoardState state = BoardState::waiting;
  std::string report{};  ///< path of its report, once there is one
};

/// Studies that run one after the other. What changes one gives the message that tells it, empty
/// where nothing is different.
class StudyBoard {
 public:
  /// `title`: the file's name. `version`: the program's.
  StudyBoard(std::string title, std::string version, std::vector<BoardStudy> studies);

  const std::vector<BoardStudy>& studies() const { return studies_; }
  /// All there is so far.
  std::string description() const;

  std::string set_row(std::size_t study, std::size_t row, BoardRow value);
  std::string set_figure(std::size_t study, std::size_t figure, BoardFigure value);
  std::string set_progress(std::size_t study, BoardProgress value);
  std::string set_state(std::size_t study, BoardState state, std::string report = {});

 private:
  std::string title_, version_;
  std::vector<BoardStudy> studies_;
};

/// What a page of studies asks: the run of a row in a window of its own, or the end of it all.
struct OpenRow {
  std::size_t study = 0, row = 0;
  bool operator==(const OpenRow&) const = default;
};
struct QuitStudies {};

struct BoardRequest {
  std::optional<std::int64_t> id;  ///< the page's own number; none where it was not read that far
  std::optional<std::variant<OpenRow, QuitStudies>> command;
  std::string problem;  ///< for the page, where there is no command
};
/// Checks that the row is there. Never throws.
BoardRequest parse_board_request(std::string_view message, const StudyBoard& board);

std::string opened_answer(std::int64_t id, const std::string& url);
std::string done_answer(std::int64_t id);
std::string refused_answer(std::optional<std::int64_t> id, const std::string& problem);

}  // namespace hookpoint::view
