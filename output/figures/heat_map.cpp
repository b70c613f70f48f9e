#include "output/figures/heat_map.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <locale>
#include <sstream>

#include "output/figures/terminal_lines.h"
#include "output/files/csv.h"
#include "text/number.h"

namespace hookpoint::output {
namespace {

constexpr double least_width = 46., numbered_height = 40.;  // of a cell [px]
constexpr double air = 10.;                                 // between numbers side by side [px]
constexpr double number_font = 11., tick_font = 13.;        // [px]
constexpr double left_margin = 100., panel_gap = 40., right_margin = 120.;
constexpr double top_margin = 92., bottom_margin = 84., band_gap = 108.;
constexpr double colorbox_width = 22.;     // [px]
constexpr double widest = 1800.;           // of a drawing whose panels stand side by side
constexpr std::size_t most_numbered = 60;  // columns or rows of cells with numbers
constexpr double crowded_panel = 720., tick_room = 64.;  // without numbers [px]

struct Color {
  int red, green, blue;
};
/// Light everywhere, so that a cell's number can be read: from an orange for the least to a blue
/// for the greatest, told apart by colour-blind readers too.
constexpr Color least_color{246, 178, 107}, middle_color{247, 243, 232},
    greatest_color{127, 184, 230};

std::string hexadecimal(const Color& color) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", static_cast<unsigned>(color.red) & 0xff,
                static_cast<unsigned>(color.green) & 0xff,
                static_cast<unsigned>(color.blue) & 0xff);
  return text.data();
}

/// gnuplot's expression for one channel of a cell's colour, its value in column 4.
std::string mixed(int Color::*channel) {
  return "(mix(of(strcol(4)), " + std::to_string(least_color.*channel) + ", " +
         std::to_string(middle_color.*channel) + ", " + std::to_string(greatest_color.*channel) +
         "))";
}

/// About how wide a number is drawn, from the letters of a common sans serif font [px].
double width_of(const std::string& number, double font) {
  double width = 0.;
  for (const char c : number) width += c == '.' || c == '-' ? 0.36 : c == '+' ? 0.84 : 0.64;
  return font * width;
}

/// As gnuplot writes it with `number_format`.
std::string number_text(const HeatMap& map, double value) {
  std::array<char, 32> text{};
  const bool scientific = map.color.logarithmic;
  const auto format = scientific ? std::chars_format::scientific : std::chars_format::general;
  const auto end = std::to_chars(text.begin(), text.end(), value, format, scientific ? 0 : 3).ptr;
  return {text.begin(), end};
}
const char* number_format(const HeatMap& map) { return map.color.logarithmic ? "%.0e" : "%.3g"; }

/// What stands under a value of an axis: its name, or its first digits.
std::string tick_text(const Axis& axis, double value) {
  return axis.names.empty() ? text::rounded(value, 4)
                            : axis.names.at(static_cast<std::size_t>(std::lround(value)));
}

double widest_tick(const Axis& axis, const std::vector<double>& values) {
  double width = 0.;
  for (const double tick : values)
    width = std::max(width, width_of(tick_text(axis, tick), tick_font));
  return width;
}

/// Whether the names below the columns stand upright: side by side they would make the drawing too
/// wide.
bool upright_ticks(const HeatMap& map) {
  const double width = std::max(least_width, widest_tick(map.x, map.x_values) + air);
  return !crowded(map) && width * static_cast<double>(map.x_values.size()) > widest;
}

/// Of all cells: so that each number and each tick has room.
double cell_width(const HeatMap& map) {
  if (crowded(map)) return crowded_panel / static_cast<double>(map.x_values.size());
  double width = least_width - air;
  for (const HeatMapPanel& panel : map.panels)
    for (const HeatMapCell& cell : panel.cells)
      if (cell.value) width = std::max(width, width_of(number_text(map, *cell.value), number_font));
  if (!upright_ticks(map)) width = std::max(width, widest_tick(map.x, map.x_values));
  return std::ceil(width + air);
}

double cell_height(const HeatMap& map) {
  return crowded(map) ? crowded_panel / static_cast<double>(map.y_values.size()) : numbered_height;
}

class HeatMapScript {
 public:
  explicit HeatMapScript(const HeatMap& map)
      : map_(map),
        columns_(map.x_values.size()),
        rows_(map.y_values.size()),
        panel_width_(cell_width(map) * static_cast<double>(columns_)),
        panel_height_(cell_height(map) * static_cast<double>(rows_)) {
    if (upright_ticks(map)) bottom_ += widest_tick(map.x, map.x_values);
    if (!map.y.names.empty())
      left_ = std::max(left_, widest_tick(map.y, map.y_values) + 2. * tick_font);
    const std::size_t panels = std::max<std::size_t>(1, map.panels.size());
    const double room = widest - left_ - right_margin + panel_gap;
    const double fit = std::max(1., std::floor(room / (panel_width_ + panel_gap)));
    across_ = std::min(panels, static_cast<std::size_t>(fit));
    bands_ = (panels + across_ - 1) / across_;
    const auto across = static_cast<double>(across_), bands = static_cast<double>(bands_);
    width_ = left_ + across * (panel_width_ + panel_gap) - panel_gap + right_margin;
    height_ = top_margin + bands * (panel_height_ + band_gap) - band_gap + bottom_;
    out_.imbue(std::locale::classic());
  }

  std::string text() {
    set_page();
    set_colors();
    std::size_t row = 0;
    for (std::size_t i = 0; i < map_.panels.size(); ++i) row = draw_panel(i, row);
    out_ << "unset multiplot\n";
    return out_.str();
  }

 private:
  void set_page() {
    const std::string shown = one_line(map_.name);
    out_ << "# Draws " << shown << ".svg from " << shown << ".csv: gnuplot " << shown
         << ".gp\nset encoding utf8\n"
         << svg_terminal(map_.name, width_, height_)
         << "set datafile separator ','\nunset key\nset multiplot\n";
    page_label("{/:Bold " + gnuplot_escaped(typeset(map_.title)) + "}", height_ - 22., "15", "");
    if (!map_.subtitle.empty())
      page_label(gnuplot_escaped(typeset(map_.subtitle)), height_ - 43., "12", " tc rgb '#777777'");
    std::string key;
    if (has_cross())
      key += std::string(crowded(map_) ? "White" : "×") +
             ": no value, the robot fell or the run stopped.  ";
    if (has_line()) key += "Dashed: closed form.";
    if (!key.empty()) page_label(key, 16., "12", " tc rgb '#777777'");
  }

  void page_label(const std::string& text, double height, const char* size,
                  const std::string& color) {
    out_ << "set label " << gnuplot_quoted(text) << " at screen "
         << text::rounded(left_ / width_, 5) << ", screen " << text::rounded(height / height_, 5)
         << " left font 'Helvetica," << size << "'" << color << "\n";
  }

  void set_colors() {
    double least = 0., greatest = 0.;
    bool first = true;
    for (const HeatMapPanel& panel : map_.panels) {
      for (const HeatMapCell& cell : panel.cells) {
        if (!cell.value) continue;
        least = first ? *cell.value : std::min(least, *cell.value);
        greatest = first ? *cell.value : std::max(greatest, *cell.value);
        first = false;
      }
    }
    if (map_.color.logarithmic) least = std::max(least, map_.color.floor);
    if (greatest <= least) greatest = map_.color.logarithmic ? 10. * least : least + 1.;
    if (map_.color.logarithmic) out_ << "set logscale cb\nset format cb '10^{%T}'\n";
    least_ = least;
    greatest_ = greatest;
    const Color& low = map_.less_is_better ? greatest_color : least_color;
    const Color& high = map_.less_is_better ? least_color : greatest_color;
    out_ << "set palette defined (0 '" << hexadecimal(low) << "', 0.5 '"
         << hexadecimal(middle_color) << "', 1 '" << hexadecimal(high) << "')\nset cbrange ["
         << text::shortest(least) << ":" << text::shortest(greatest)
         << "]\nset border 0\nset xrange [-0.5:"
         << text::shortest(static_cast<double>(columns_) - 0.5)
         << "]\nset yrange [-0.5:" << text::shortest(static_cast<double>(rows_) - 0.5)
         << "]\nset tics scale 0\nset xtics nomirror" << (upright_ticks(map_) ? " rotate" : "")
         << " (" << ticks(map_.x, map_.x_values, panel_width_) << ")\nset xlabel "
         << gnuplot_quoted(axis_title(map_.x)) << " noenhanced\nset cblabel "
         << gnuplot_quoted(axis_title(map_.color)) << " noenhanced\n";
  }

  /// Of each value; along a crowded axis as many as have room.
  std::string ticks(const Axis& axis, const std::vector<double>& values, double length) const {
    const double room = std::floor(length / tick_room);
    const auto each = static_cast<std::size_t>(
        crowded(map_) ? std::ceil(static_cast<double>(values.size()) / room) : 1.);
    std::string text;
    for (std::size_t i = 0; i < values.size(); i += each)
      text += (i > 0 ? ", " : "") +
              gnuplot_quoted(axis.names.empty() ? tick_text(axis, values[i])
                                                : gnuplot_escaped(tick_text(axis, values[i]))) +
              " " + std::to_string(i);
    return text;
  }

  /// From row `first` of the data on; returns the row after the panel's last.
  std::size_t draw_panel(std::size_t index, std::size_t first) {
    const HeatMapPanel& panel = map_.panels[index];
    assert(panel.cells.size() == columns_ * rows_);
    const std::size_t column = index % across_, bands_below = bands_ - 1 - index / across_;
    const double left = left_ + static_cast<double>(column) * (panel_width_ + panel_gap);
    const double bottom = bottom_ + static_cast<double>(bands_below) * (panel_height_ + band_gap);
    const auto screen = [](double pixels, double whole) {
      return text::rounded(pixels / whole, 5);
    };
    out_ << "set lmargin at screen " << screen(left, width_) << "\nset rmargin at screen "
         << screen(left + panel_width_, width_) << "\nset bmargin at screen "
         << screen(bottom, height_) << "\nset tmargin at screen "
         << screen(bottom + panel_height_, height_) << "\nset title " << gnuplot_quoted(panel.title)
         << " noenhanced offset 0,-0.4\n";
    if (column == 0)
      out_ << "set ytics scale 0 nomirror (" << ticks(map_.y, map_.y_values, panel_height_)
           << ")\nset ylabel " << gnuplot_quoted(axis_title(map_.y)) << " noenhanced\n";
    else
      out_ << "unset ylabel\nunset ytics\n";
    if (index + 1 < map_.panels.size())
      out_ << "unset colorbox\n";
    else if (upright_ticks(map_))  // gnuplot's own is as broad as the drawing is wide
      out_ << "set colorbox user origin screen "
           << screen(left + panel_width_ + 0.5 * panel_gap, width_) << ", screen "
           << screen(bottom, height_) << " size screen " << screen(colorbox_width, width_)
           << ", screen " << screen(panel_height_, height_) << "\n";
    else
      out_ << "set colorbox\n";
    set_line(panel);
    const std::size_t count = static_cast<std::size_t>(
        std::count_if(panel.cells.begin(), panel.cells.end(),
                      [&](const HeatMapCell& cell) { return cell.run || crowded(map_); }));
    if (crowded(map_))
      plot_picture(first, count);
    else
      plot_cells(first, count);
    out_ << "unset label\nunset arrow\n";
    return first + count;
  }

  std::string data_from(std::size_t first, std::size_t count) const {
    return gnuplot_quoted(map_.name + ".csv") + " skip 1 every ::" + std::to_string(first) +
           "::" + std::to_string(first + count - 1);
  }

  /// One picture of coloured points in the palette's colours: a rectangle each of ten thousand
  /// cells would make a drawing that no reader opens.
  void plot_picture(std::size_t first, std::size_t count) {
    const std::string least = text::shortest(least_), greatest = text::shortest(greatest_);
    out_ << "given(v) = strlen(v) > 0\nshare(v) = "
         << (map_.color.logarithmic ? "log(v < " + least + " ? 1. : v/" + least + ")/log(" +
                                          greatest + "/" + least + ")"
                                    : "(v - (" + least + "))/(" + greatest + " - (" + least + "))")
         << "\nmix(s, low, middle, high) = s < 0.5 ? low + 2*s*(middle - low) : middle + (2*s - "
            "1)*(high - middle)\nof(v) = given(v) ? share(real(v)) : 0.\nplot "
         << data_from(first, count) << " using 5:6:" << mixed(&Color::red) << ":"
         << mixed(&Color::green) << ":" << mixed(&Color::blue)
         << ":(given(strcol(4)) ? 255 : 0) with rgbalpha, NaN with points lc palette\n";
  }

  void plot_cells(std::size_t first, std::size_t count) {
    if (count == 0) return;
    const std::string from = data_from(first, count);
    const bool logarithmic = map_.color.logarithmic;
    out_ << "given(v) = strlen(v) > 0\nshade(v) = "
         << (logarithmic ? "v < " + text::shortest(map_.color.floor) + " ? " +
                               text::shortest(map_.color.floor) + " : v"
                         : "v")
         << "\nplot " << from
         << " using 5:6:($5-0.48):($5+0.48):($6-0.48):($6+0.48):(given(strcol(4)) ? shade($4) : "
            "NaN) with boxxyerror fs solid noborder lc palette, \\\n  "
         << from << " using 5:6:(given(strcol(4)) ? sprintf('" << number_format(map_)
         << "', $4) : '') with labels tc rgb '#222222' font 'Helvetica,11', \\\n  " << from
         << " using 5:(given(strcol(4)) ? NaN : $6) with points pt 2 ps 1 lw 2 lc rgb '#D55E00'\n";
  }

  /// Between neighbours whose predictions differ.
  void set_line(const HeatMapPanel& panel) {
    const auto differ = [&](std::size_t a, std::size_t b) {
      const auto &one = panel.cells[a].predicted, &other = panel.cells[b].predicted;
      return one && other && *one != *other;
    };
    const auto segment = [&](double x0, double y0, double x1, double y1) {
      out_ << "set arrow from " << text::shortest(x0) << "," << text::shortest(y0) << " to "
           << text::shortest(x1) << "," << text::shortest(y1)
           << " nohead front lw 2.4 dt (5,3) lc rgb '#0072B2'\n";
    };
    for (std::size_t row = 0; row < rows_; ++row) {
      for (std::size_t column = 0; column < columns_; ++column) {
        const std::size_t cell = row * columns_ + column;
        const double x = static_cast<double>(column), y = static_cast<double>(row);
        if (column + 1 < columns_ && differ(cell, cell + 1))
          segment(x + 0.5, y - 0.5, x + 0.5, y + 0.5);
        if (row + 1 < rows_ && differ(cell, cell + columns_))
          segment(x - 0.5, y + 0.5, x + 0.5, y + 0.5);
      }
    }
  }

  template <class Holds>
  bool any_cell(Holds holds) const {
    return std::any_of(map_.panels.begin(), map_.panels.end(), [&](const HeatMapPanel& panel) {
      return std::any_of(panel.cells.begin(), panel.cells.end(), holds);
    });
  }
  bool has_cross() const {
    return any_cell([](const HeatMapCell& cell) { return cell.run && !cell.value; });
  }
  bool has_line() const {
    return any_cell([](const HeatMapCell& cell) { return cell.predicted.has_value(); });
  }

  const HeatMap& map_;
  std::size_t columns_, rows_;
  double panel_width_, panel_height_;                   // [px]
  std::size_t across_ = 1, bands_ = 1;                  // panels in a row, rows of panels
  double left_ = left_margin, bottom_ = bottom_margin;  // [px]
  double width_ = 0., height_ = 0.;                     // of the drawing [px]
  double least_ = 0., greatest_ = 0.;                   // of the colours
  std::ostringstream out_;
};

}  // namespace

bool crowded(const HeatMap& map) {
  return map.x_values.size() > most_numbered || map.y_values.size() > most_numbered;
}

std::string heat_map_data(const HeatMap& map) {
  CsvTable table;
  const auto title = [](const Axis& axis) { return column_title(axis.label, axis.unit); };
  const auto place = [](const Axis& axis, double value) {
    return axis.names.empty() ? text::shortest(value) : tick_text(axis, value);
  };
  table.header = {"panel", title(map.x), title(map.y), title(map.color), "column", "row"};
  for (const HeatMapPanel& panel : map.panels) {
    for (std::size_t i = 0; i < panel.cells.size(); ++i) {
      const HeatMapCell& cell = panel.cells[i];
      if (!cell.run && !crowded(map)) continue;
      const std::size_t column = i % map.x_values.size(), row = i / map.x_values.size();
      table.rows.push_back({panel.title, place(map.x, map.x_values[column]),
                            place(map.y, map.y_values[row]), text::shortest(cell.value),
                            std::to_string(column), std::to_string(row)});
    }
  }
  return table.text();
}

std::string heat_map_script(const HeatMap& map) { return HeatMapScript(map).text(); }

PlotOutcome draw(const HeatMap& map, const std::filesystem::path& folder) {
  return draw_files(map.name, heat_map_data(map), heat_map_script(map), folder);
}

}  // namespace hookpoint::output
