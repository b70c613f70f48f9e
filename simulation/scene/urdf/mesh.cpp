#include "simulation/scene/urdf/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <tuple>

#include "simulation/scene/urdf/mesh_words.h"
#include "text/formats.h"

namespace hookpoint::simulation {
namespace {

constexpr std::size_t largest_mesh = 100UL << 20;
constexpr double largest_coordinate = 1e6;

static_assert(std::endian::native == std::endian::little, "STL's numbers are little-endian");

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

/// Three numbers that `text` begins with.
std::optional<Vector3d> next_vertex(std::string_view& text) {
  std::array<double, 3> numbers{};
  for (double& number : numbers) {
    const std::optional<double> read = mesh_number(next_word(text));
    if (!read) return std::nullopt;
    number = *read;
  }
  return Vector3d{numbers[0], numbers[1], numbers[2]};
}

/// The line of the file in which `rest` begins.
MeshPoints broken_line(std::string_view bytes, std::string_view rest, std::string_view problem) {
  const auto line = 1 + std::ranges::count(bytes.substr(0, bytes.size() - rest.size()), '\n');
  return {{}, fmt::format("line {}: {}", line, problem)};
}

constexpr std::string_view broken_vertex = "a vertex has three numbers";

/// What may follow a vertex: a weight, a colour.
bool only_numbers(std::string_view line) {
  for (std::string_view word = next_word(line); !word.empty(); word = next_word(line))
    if (!mesh_number(word)) return false;
  return true;
}

// A header of 80 bytes, the number of triangles, 50 bytes each: a normal, three vertices, 2 bytes.
constexpr std::size_t stl_header = 84, stl_triangle = 50;

MeshPoints read_binary_stl(std::string_view bytes, std::size_t triangles) {
  MeshPoints mesh;
  mesh.vertices.reserve(3 * triangles);
  for (std::size_t i = 0; i < triangles; ++i) {
    std::array<float, 12> numbers;
    std::memcpy(numbers.data(), bytes.data() + stl_header + stl_triangle * i, sizeof numbers);
    const auto at = [&](std::size_t k) { return static_cast<double>(numbers[k]); };
    for (std::size_t k = 3; k < numbers.size(); k += 3)
      mesh.vertices.push_back({at(k), at(k + 1), at(k + 2)});
  }
  return mesh;
}

MeshPoints read_ascii_stl(std::string_view bytes) {
  MeshPoints mesh;
  std::string_view rest = bytes;
  for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) {
    if (word != "vertex" && word != "VERTEX") continue;
    const std::optional<Vector3d> vertex = next_vertex(rest);
    if (!vertex) return broken_line(bytes, rest, broken_vertex);
    mesh.vertices.push_back(*vertex);
  }
  if (mesh.vertices.size() % 3 != 0) return {{}, "it ends within a triangle"};
  return mesh;
}

/// What an OBJ file's faces, lines and points name by `v/vt/vn`: a vertex, a place in its texture, a
/// normal. Each counts from 1, or from -1 backwards from the last one so far.
class ObjIndices {
 public:
  /// Counts a line that begins with `kind`.
  void define(std::string_view kind) {
    for (Named& named : named_)
      if (kind == named.kind) ++named.there;
  }
  /// "" or what is wrong with the rest of a line that names some.
  std::string add(std::string_view line) {
    for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
      std::string_view left = word;
      for (Named& named : named_) {
        const std::string_view number = left.substr(0, left.find('/'));
        const bool is_vertex = named.kind == named_.front().kind;
        const std::optional<double> index = mesh_number(number);
        const bool good = index && *index == std::floor(*index) && *index != 0. &&
                          *index >= -static_cast<double>(named.there);
        if (!good && (is_vertex || !number.empty()))
          return fmt::format("`{}` names no {}", word.substr(0, 40), named.words);
        if (good) named.greatest = std::max(named.greatest, *index);
        left.remove_prefix(std::min(number.size() + 1, left.size()));
      }
    }
    return "";
  }
  /// "" or what is named and not there, also behind. A file may leave out all places in a texture or
  /// all normals.
  std::string missing() const {
    for (const Named& named : named_)
      if (named.greatest > static_cast<double>(named.there) &&
          (named.there > 0 || named.kind == named_.front().kind))
        return fmt::format("a face names {} {} of {}", named.words, named.greatest, named.there);
    return "";
  }

 private:
  struct Named {
    std::string_view kind, words;
    std::size_t there = 0;
    double greatest = 0.;
  };
  std::array<Named, 3> named_{{{"v", "vertex"}, {"vt", "place in the texture"}, {"vn", "normal"}}};
};

/// What is wrong with the vertices; "" if nothing is.
std::string problem_with(const std::vector<Vector3d>& vertices) {
  if (vertices.empty()) return "it has no vertices";
  // NaN is beyond, too.
  const auto beyond = [](double x) { return !(std::abs(x) <= largest_coordinate); };
  const bool far = std::ranges::any_of(
      vertices, [&](const Vector3d& p) { return beyond(p.x) || beyond(p.y) || beyond(p.z); });
  return far ? fmt::format("it has a coordinate that is no number up to {:g}", largest_coordinate)
             : "";
}

}  // namespace

MeshPoints read_stl(std::string_view bytes) {
  const bool may_be_text = bytes.starts_with("solid") || bytes.starts_with("SOLID");
  if (bytes.size() >= stl_header) {
    std::uint32_t triangles = 0;
    std::memcpy(&triangles, bytes.data() + stl_header - sizeof triangles, sizeof triangles);
    const std::size_t body = bytes.size() - stl_header;
    const std::size_t wanted = stl_triangle * triangles;
    // Some programs begin a binary file with the word of the other kind: the length decides.
    if (body == wanted) return read_binary_stl(bytes, triangles);
    if (!may_be_text)
      return {{},
              fmt::format("it says {} triangles and {} {}{}", triangles,
                          body < wanted ? "ends after" : "has", body / stl_triangle,
                          body > wanted && body / stl_triangle == triangles
                              ? fmt::format(", with {} more bytes after the last", body - wanted)
                              : "")};
  }
  if (!may_be_text) return {{}, "it is no STL: neither `solid` nor a whole header"};
  return read_ascii_stl(bytes);
}

MeshPoints read_obj(std::string_view bytes) {
  MeshPoints mesh;
  ObjIndices indices;
  for (std::string_view rest = bytes; !rest.empty();) {
    const std::string_view here = rest;
    std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    const std::string_view kind = next_word(line);
    indices.define(kind);
    if (kind == "f" || kind == "l" || kind == "p") {
      if (const std::string problem = indices.add(line); !problem.empty())
        return broken_line(bytes, here, problem);
    }
    if (kind != "v") continue;
    const std::optional<Vector3d> vertex = next_vertex(line);
    if (!vertex || !only_numbers(line)) return broken_line(bytes, here, broken_vertex);
    mesh.vertices.push_back(*vertex);
  }
  mesh.problem = indices.missing();
  return mesh;
}

MeshPoints read_mesh(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return {{}, "it is no file"};
  const std::string ending = lower_case(path.extension().string());
  const auto reader = ending == ".stl"   ? read_stl
                      : ending == ".obj" ? read_obj
                      : ending == ".dae" ? read_collada
                                         : nullptr;
  std::string refusal = text::refusal(path, text::Use::mesh);
  if (!refusal.empty()) return {{}, std::move(refusal)};
  if (reader == nullptr) return {{}, "meshes are read from STL, OBJ and DAE (Collada) files"};
  if (std::filesystem::file_size(path, error) > largest_mesh || error)
    return {{}, fmt::format("it is larger than {} MB", largest_mesh >> 20)};
  std::ifstream stream(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (stream.bad() || !stream.is_open()) return {{}, "it cannot be read"};
  MeshPoints mesh = reader(bytes);
  if (mesh.problem.empty()) mesh.problem = problem_with(mesh.vertices);
  if (!mesh.problem.empty()) return {{}, std::move(mesh.problem)};
  const auto by_coordinates = [](const Vector3d& p) { return std::tuple(p.x, p.y, p.z); };
  std::ranges::sort(mesh.vertices, {}, by_coordinates);
  // The ranges' own gives a subrange, which clang 14 cannot do with this library.
  const auto again = std::unique(mesh.vertices.begin(), mesh.vertices.end());
  mesh.vertices.erase(again, mesh.vertices.end());
  return mesh;
}

}  // namespace hookpoint::simulation
