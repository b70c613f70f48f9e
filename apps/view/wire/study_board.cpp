#include "apps/view/wire/study_board.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "text/json.h"
#include "text/json_reader.h"

namespace hookpoint::view {
namespace {

using text::JsonWriter;

constexpr int protocol = 1;

void write(JsonWriter& json, const std::optional<double>& value) {
  if (value)
    json.value(*value);
  else
    json.null();
}

template <class Items, class Write>
void write_list(JsonWriter& json, std::string_view name, const Items& items, Write write_item) {
  json.key(name).begin_array();
  for (const auto& item : items) write_item(item);
  json.end_array();
}

void write_texts(JsonWriter& json, std::string_view name, const std::vector<std::string>& texts) {
  write_list(json, name, texts, [&](const std::string& text) { json.value(text); });
}

void write_column(JsonWriter& json, const BoardColumn& column) {
  json.begin_object().member("name", column.name).member("unit", column.unit);
  json.member("varied", column.varied);
  write_texts(json, "names", column.names);
  json.end_object();
}

void write_subject(JsonWriter& json, const BoardSubject& subject) {
  const output::SeriesStyle style = output::series_style(subject.style);
  json.begin_object().member("name", subject.name).member("colour", style.color);
  json.member("marker", style.shape).member("composition", subject.composition).end_object();
}

void write_cell(JsonWriter& json, const BoardCell& cell) {
  json.begin_array();
  write(json, cell.measured);
  write(json, cell.predicted);
  if (cell.ok)
    json.value(*cell.ok);
  else
    json.null();
  json.end_array();
}

/// The members of a row.
void write_row(JsonWriter& json, const BoardRow& row) {
  json.member("subject", row.subject).key("varied").numbers(row.varied);
  json.member("outcome", row.outcome).member("status", row.status);
  write_list(json, "cells", row.cells, [&](const BoardCell& cell) { write_cell(json, cell); });
}

void write_axis(JsonWriter& json, std::string_view name, const output::Axis& axis) {
  json.key(name).begin_object().member("label", axis.label).member("unit", axis.unit);
  json.member("logarithmic", axis.logarithmic).member("floor", axis.floor).end_object();
}

void write_curve(JsonWriter& json, std::string_view name, const output::Curve& curve) {
  json.key(name).begin_object().key("x").numbers(curve.x).key("y").numbers(curve.y).end_object();
}

void write_series(JsonWriter& json, const output::Series& series) {
  json.begin_object().member("label", series.label);
  const output::SeriesStyle style = output::series_style(series.style);
  json.member("colour", style.color).member("marker", style.shape);
  json.member("reference", series.reference).key("dashes").begin_array();
  for (const int length : series.reference ? output::reference_dashes(series.style) : style.dashes)
    json.value(length);
  json.end_array();
  write_curve(json, "measured", series.measured);
  write_curve(json, "predicted", series.predicted);
  json.key("unfinished").numbers(series.unfinished).end_object();
}

void write_panel(JsonWriter& json, const output::Plot& panel, bool titled) {
  json.begin_object().member("title", titled ? panel.title : std::string());
  write_list(json, "series", panel.series,
             [&](const output::Series& series) { write_series(json, series); });
  json.end_object();
}

void write_drawing(JsonWriter& json, const output::PanelPlot& plot) {
  json.member("kind", "curves").member("name", plot.name).member("title", plot.title);
  json.member("subtitle", plot.subtitle).member("across", plot.across);
  json.member("own_axes", plot.own_axes);
  // All panels have the same.
  const output::Plot axes = plot.panels.empty() ? output::Plot{} : plot.panels.front();
  write_axis(json, "x", axes.x);
  write_axis(json, "y", axes.y);
  write_list(json, "panels", plot.panels,
             [&](const output::Plot& panel) { write_panel(json, panel, plot.panels.size() > 1); });
}

void write_panel(JsonWriter& json, const output::HeatMapPanel& panel) {
  json.begin_object().member("title", panel.title);
  const auto write_cells = [&](std::string_view name, auto member) {
    write_list(json, name, panel.cells,
               [&](const output::HeatMapCell& cell) { write(json, cell.*member); });
  };
  write_cells("values", &output::HeatMapCell::value);
  write_cells("predicted", &output::HeatMapCell::predicted);
  json.end_object();
}

void write_drawing(JsonWriter& json, const output::HeatMap& map) {
  json.member("kind", "map").member("name", map.name).member("title", map.title);
  json.member("subtitle", map.subtitle);
  write_axis(json, "x", map.x);
  write_axis(json, "y", map.y);
  write_axis(json, "colour", map.color);
  json.key("x_values").numbers(map.x_values).key("y_values").numbers(map.y_values);
  write_list(json, "panels", map.panels,
             [&](const output::HeatMapPanel& panel) { write_panel(json, panel); });
}

/// The members of a figure.
void write_figure(JsonWriter& json, const BoardFigure& figure) {
  std::visit([&](const auto& drawing) { write_drawing(json, drawing); }, figure.drawing);
  json.member("caption", figure.caption);
}

/// The members of a progress.
void write_progress(JsonWriter& json, const BoardProgress& progress) {
  json.member("done", progress.done).member("total", progress.total);
  json.member("seconds_left", progress.seconds_left);
}

std::string_view word_of(BoardState state) {
  switch (state) {
    case BoardState::waiting:
      return "waiting";
    case BoardState::running:
      return "running";
    case BoardState::done:
      return "done";
    case BoardState::interrupted:
      return "interrupted";
  }
  return "";
}

/// The members of a state.
void write_state(JsonWriter& json, const BoardStudy& study) {
  json.member("state", word_of(study.state)).member("report", study.report);
}

void write_study(JsonWriter& json, const BoardStudy& study) {
  json.begin_object().member("name", study.name).member("title", study.title);
  json.member("question", study.question);
  write_state(json, study);
  json.key("progress").begin_object();
  write_progress(json, study.progress);
  json.end_object();
  write_list(json, "subjects", study.subjects,
             [&](const BoardSubject& subject) { write_subject(json, subject); });
  write_list(json, "columns", study.columns,
             [&](const BoardColumn& column) { write_column(json, column); });
  const auto write_object = [&](const auto& write_members) {
    json.begin_object();
    write_members();
    json.end_object();
  };
  write_list(json, "rows", study.rows,
             [&](const BoardRow& row) { write_object([&] { write_row(json, row); }); });
  write_list(json, "figures", study.figures,
             [&](const BoardFigure& figure) { write_object([&] { write_figure(json, figure); }); });
  json.end_object();
}

template <class Write>
std::string message(std::string_view tell, std::size_t study, Write write_members) {
  JsonWriter json;
  json.begin_object().member("tell", tell).member("study", study);
  write_members(json);
  return json.end_object().text();
}

std::optional<std::int64_t> whole_number(const text::JsonValue& message, std::string_view name) {
  const text::JsonValue* found = message.member(name);
  if (found == nullptr) return std::nullopt;
  const std::string& text = found->text();
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < 0) return std::nullopt;
  return value;
}

}  // namespace

StudyBoard::StudyBoard(std::string title, std::string version, std::vector<BoardStudy> studies)
    : title_(std::move(title)), version_(std::move(version)), studies_(std::move(studies)) {}

std::string StudyBoard::description() const {
  JsonWriter json;
  json.begin_object().member("tell", "description").member("protocol", protocol);
  json.member("version", version_).member("title", title_).member("kind", "study");
  write_list(json, "studies", studies_, [&](const BoardStudy& study) { write_study(json, study); });
  return json.end_object().text();
}

std::string StudyBoard::set_row(std::size_t study, std::size_t row, BoardRow value) {
  BoardRow& known = studies_[study].rows[row];
  if (known == value) return "";
  known = std::move(value);
  return message("row", study, [&](JsonWriter& json) {
    json.member("row", row);
    write_row(json, known);
  });
}

std::string StudyBoard::set_figure(std::size_t study, std::size_t figure, BoardFigure value) {
  BoardFigure& known = studies_[study].figures[figure];
  const auto told = [&] {
    return message("figure", study, [&](JsonWriter& json) {
      json.member("figure", figure);
      write_figure(json, known);
    });
  };
  const std::string before = told();
  known = std::move(value);
  std::string now = told();
  return now == before ? "" : now;
}

std::string StudyBoard::set_progress(std::size_t study, BoardProgress value) {
  studies_[study].progress = value;
  return message("progress", study, [&](JsonWriter& json) { write_progress(json, value); });
}

std::string StudyBoard::set_state(std::size_t study, BoardState state, std::string report) {
  studies_[study].state = state;
  studies_[study].report = std::move(report);
  return message("state", study, [&](JsonWriter& json) { write_state(json, studies_[study]); });
}

BoardRequest parse_board_request(std::string_view text, const StudyBoard& board) {
  BoardRequest request;
  const auto root = text::read_json(text);
  if (!root) {
    request.problem = "the message is not JSON";
    return request;
  }
  request.id = whole_number(*root, "id");
  const text::JsonValue* name = root->member("do");
  if (!request.id) {
    request.problem = "`id` takes a whole number";
  } else if (name == nullptr || !name->is_leaf()) {
    request.problem = "`do` is missing";
  } else if (name->text() == "quit") {
    request.command = QuitStudies{};
  } else if (name->text() == "open") {
    const auto study = whole_number(*root, "study"), row = whole_number(*root, "row");
    const auto& studies = board.studies();
    if (study && row && static_cast<std::size_t>(*study) < studies.size() &&
        static_cast<std::size_t>(*row) < studies[static_cast<std::size_t>(*study)].rows.size())
      request.command = OpenRow{static_cast<std::size_t>(*study), static_cast<std::size_t>(*row)};
    else
      request.problem = "`open` takes a `study` and a `row` of the description, counted from 0";
  } else {
    request.problem = "a page of studies may `open` a row and `quit`";
  }
  return request;
}

std::string opened_answer(std::int64_t id, const std::string& url) {
  JsonWriter json;
  return json.begin_object()
      .member("id", id)
      .member("ok", true)
      .member("url", url)
      .end_object()
      .text();
}

std::string done_answer(std::int64_t id) {
  JsonWriter json;
  return json.begin_object().member("id", id).member("ok", true).end_object().text();
}

std::string refused_answer(std::optional<std::int64_t> id, const std::string& problem) {
  JsonWriter json;
  json.begin_object();
  if (id) json.member("id", *id);
  return json.member("error", problem).end_object().text();
}

}  // namespace hookpoint::view
