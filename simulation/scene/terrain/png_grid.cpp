#include "simulation/scene/terrain/png_grid.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <new>

#include "contact/terrain/terrain.h"

namespace hookpoint::simulation {
namespace {

/// A file in libpng's hands. The library reports an error by a long jump, so the functions that it
/// may jump out of (read_header, read_rows) hold nothing that needs to be destroyed.
class PngFile {
 public:
  explicit PngFile(const std::filesystem::path& path) : file_(std::fopen(path.c_str(), "rb")) {}
  ~PngFile() {
    png_destroy_read_struct(&png_, &info_, nullptr);
    if (file_ != nullptr) std::fclose(file_);
  }
  PngFile(const PngFile&) = delete;
  PngFile& operator=(const PngFile&) = delete;

  PngGridResult read(double low, double high) {
    if (!begins_as_png()) return {std::nullopt, "it is not a PNG image"};
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
    info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
    if (info_ == nullptr) throw std::bad_alloc();
    if (!read_header()) return {std::nullopt, "it is damaged or cut off: " + message_};
    const std::string problem = header_problem();
    if (!problem.empty()) return {std::nullopt, problem};
    bytes_.resize(png_get_rowbytes(png_, info_) * png_get_image_height(png_, info_));
    if (!read_rows()) return {std::nullopt, "it is damaged or cut off: " + message_};
    return {heights(low, high), ""};
  }

 private:
  [[noreturn]] static void on_error(png_structp png, png_const_charp message) {
    static_cast<PngFile*>(png_get_error_ptr(png))->message_ = message;
    png_longjmp(png, 1);
  }
  static void on_warning(png_structp /*png*/, png_const_charp /*message*/) {}

  bool begins_as_png() {
    std::array<png_byte, 8> signature{};
    return file_ != nullptr && std::fread(signature.data(), 1, 8, file_) == 8 &&
           png_sig_cmp(signature.data(), 0, 8) == 0;
  }

  bool read_header() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    // A wrong checksum is damage in every chunk; libpng 1.6.48 only warns of one in the last.
    png_set_crc_action(png_, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
    png_init_io(png_, file_);
    png_set_sig_bytes(png_, 8);
    png_read_info(png_, info_);
    return true;
  }

  std::string header_problem() const {
    const png_uint_32 columns = png_get_image_width(png_, info_);
    const png_uint_32 rows = png_get_image_height(png_, info_);
    const std::string size = std::to_string(columns) + " x " + std::to_string(rows) + " pixels";
    if (png_get_color_type(png_, info_) != PNG_COLOR_TYPE_GRAY) {
      return "it has colour, a palette or transparency; heights come from a grayscale image "
             "without alpha";
    }
    const int depth = png_get_bit_depth(png_, info_);
    if (depth != 8 && depth != 16) {
      return "it has " + std::to_string(depth) + " bits of gray; heights come from 8 or 16";
    }
    if (png_get_interlace_type(png_, info_) != PNG_INTERLACE_NONE) {
      return "it is interlaced; save it without";
    }
    if (columns < 2 || rows < 2) return "it has " + size + "; a grid needs at least 2 x 2";
    if (std::max(columns, rows) > contact::most_grid_side) {
      return "it has " + size + ", more than " + std::to_string(contact::most_grid_side) +
             " along a side";
    }
    if (std::uint64_t{columns} * rows <= contact::most_grid_vertices) return "";
    return "it has " + size + ", more than " + std::to_string(contact::most_grid_vertices) +
           " in all";
  }

  bool read_rows() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    const std::size_t length = png_get_rowbytes(png_, info_);
    for (std::size_t begin = 0; begin < bytes_.size(); begin += length) {
      png_read_row(png_, bytes_.data() + begin, nullptr);
    }
    png_read_end(png_, nullptr);
    return true;
  }

  PngGrid heights(double low, double high) const {
    PngGrid grid;
    grid.columns = static_cast<int>(png_get_image_width(png_, info_));
    grid.rows = static_cast<int>(png_get_image_height(png_, info_));
    const bool wide = png_get_bit_depth(png_, info_) == 16;
    const double white = wide ? 65535. : 255.;
    const std::size_t length = png_get_rowbytes(png_, info_);
    grid.heights.reserve(static_cast<std::size_t>(grid.columns) * grid.rows);
    for (int row = grid.rows - 1; row >= 0; --row) {  // top first -> least y first
      const png_byte* sample = bytes_.data() + row * length;
      for (int column = 0; column < grid.columns; ++column) {
        const int level = wide ? sample[2 * column] << 8 | sample[2 * column + 1] : sample[column];
        grid.heights.push_back(low + (high - low) * (level / white));
      }
    }
    return grid;
  }

  std::FILE* file_ = nullptr;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::vector<png_byte> bytes_;  // the image as stored, its top row first
  std::string message_;
};

}  // namespace

PngGridResult read_png_grid(const std::filesystem::path& path, double low, double high) {
  return PngFile(path).read(low, high);
}

}  // namespace hookpoint::simulation
