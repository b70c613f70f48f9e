// Collada 1.4 and 1.5: the positions of every geometry that the scene shows, each under the
// transforms of its nodes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <pugixml.hpp>
#include <unordered_map>

#include "math/rotation.h"
#include "simulation/scene/urdf/mesh.h"
#include "simulation/scene/urdf/mesh_words.h"

namespace hookpoint::simulation {
namespace {

constexpr std::size_t most_vertices = 10'000'000, most_numbers = 3 * most_vertices;
// Nodes may stand in one another by name, and a file may say so of a hundred in ten lines.
constexpr std::size_t most_nodes = 100'000;
constexpr int most_depth = 100;
constexpr double shortest_unit = 1e-9, longest_unit = 1e9;  // [m]

/// The beginning of a text of the file, for a message.
std::string_view shown(std::string_view text) { return text.substr(0, 40); }

/// x -> A x + t.
struct Affine {
  Matrix3d A = Matrix3d::identity();
  Vector3d t;
};
Affine operator*(const Affine& a, const Affine& b) { return {a.A * b.A, a.A * b.t + a.t}; }

class ColladaScene {
 public:
  MeshPoints read(std::string_view bytes) {
    const pugi::xml_parse_result parsed = document_.load_buffer(bytes.data(), bytes.size());
    if (!parsed) return {{}, fmt::format("it is no XML: {}", parsed.description())};
    const pugi::xml_node root = document_.document_element();
    if (std::string_view(root.name()) != "COLLADA") return {{}, "it is no Collada file"};
    index(root);
    const Affine X{read_metre(root.child("asset").child("unit")) * Matrix3d::identity(), {}};
    pugi::xml_node scene = root.child("library_visual_scenes").child("visual_scene");
    if (const pugi::xml_node shown = root.child("scene").child("instance_visual_scene"))
      scene = find(shown, "url");
    if (failed()) return std::move(mesh_);
    if (scene) {
      for (const pugi::xml_node& node : scene.children("node")) add_node(node, X, 0);
    } else {
      for (const pugi::xml_node& of : root.child("library_geometries").children("geometry"))
        add_geometry(of, X);
    }
    return std::move(mesh_);
  }

 private:
  void fail(std::string problem) {
    if (mesh_.problem.empty()) mesh_.problem = std::move(problem);
  }
  bool failed() const { return !mesh_.problem.empty(); }

  void index(const pugi::xml_node& root) {
    struct Walker : pugi::xml_tree_walker {
      std::unordered_map<std::string_view, pugi::xml_node>* ids;
      bool for_each(pugi::xml_node& node) override {
        if (const pugi::xml_attribute id = node.attribute("id")) ids->emplace(id.value(), node);
        return true;
      }
    } walker;
    walker.ids = &ids_;
    pugi::xml_node(root).traverse(walker);
  }

  /// Length of the file's unit in metres, 1 where it is not given.
  double read_metre(const pugi::xml_node& unit) {
    const pugi::xml_attribute meter = unit.attribute("meter");
    if (!meter) return 1.;
    std::string_view text = meter.value();
    const std::optional<double> metre = mesh_number(next_word(text));
    if (metre && *metre >= shortest_unit && *metre <= longest_unit && next_word(text).empty())
      return *metre;
    fail(fmt::format("<unit meter=\"{}\">: a length in metres from {:g} to {:g} is expected",
                     shown(meter.value()), shortest_unit, longest_unit));
    return 1.;
  }

  /// A whole number from 0 to `most_numbers`, `otherwise` where it is not given.
  std::size_t whole(const pugi::xml_node& node, const char* attribute, std::size_t otherwise) {
    const pugi::xml_attribute given = node.attribute(attribute);
    if (!given) return otherwise;
    std::string_view text = given.value();
    const std::optional<double> number = mesh_number(next_word(text));
    if (number && *number >= 0. && *number <= static_cast<double>(most_numbers) &&
        *number == std::floor(*number) && next_word(text).empty())
      return static_cast<std::size_t>(*number);
    fail(fmt::format("<{} {}=\"{}\">: a whole number from 0 to {} is expected", node.name(),
                     attribute, shown(given.value()), most_numbers));
    return otherwise;
  }

  /// The element that `attribute` of `node` names: "#id". None after an error.
  pugi::xml_node find(const pugi::xml_node& node, const char* attribute) {
    const std::string_view url = node.attribute(attribute).value();
    const auto found = url.starts_with('#') ? ids_.find(url.substr(1)) : ids_.end();
    if (found != ids_.end()) return found->second;
    fail(fmt::format("<{} {}=\"{}\">: the file has no such element", node.name(), attribute,
                     shown(url)));
    return {};
  }

  void add_node(const pugi::xml_node& node, Affine X, int depth) {
    if (++nodes_ > most_nodes || depth > most_depth)
      return fail("its nodes stand in one another too often");
    for (const pugi::xml_node& part : node.children()) {
      if (failed()) return;
      const std::string_view name = part.name();
      if (name == "matrix" || name == "translate" || name == "rotate" || name == "scale") {
        X = X * transform(part);
      } else if (name == "lookat" || name == "skew") {
        fail(fmt::format("it places parts by <{}>, which is not read", name));
      } else if (name == "instance_geometry") {
        add_geometry(find(part, "url"), X);
      } else if (name == "instance_controller") {
        if (const pugi::xml_node skin = find(part, "url").child("skin"))
          add_geometry(find(skin, "source"), X);
      } else if (name == "instance_node") {
        if (const pugi::xml_node other = find(part, "url")) add_node(other, X, depth + 1);
      } else if (name == "node") {
        add_node(part, X, depth + 1);
      }
    }
  }

  Affine transform(const pugi::xml_node& node) {
    const std::string_view name = node.name();
    const std::size_t count = name == "matrix" ? 16 : name == "rotate" ? 4 : 3;
    std::vector<double> x;
    read_numbers(node.text().get(), x, count);
    if (failed() || x.size() != count) {
      fail(fmt::format("a <{}> of its scene has not {} numbers", name, count));
      return {};
    }
    if (name == "translate") return {Matrix3d::identity(), {x[0], x[1], x[2]}};
    if (name == "scale") return whole_space({x[0], 0., 0., 0., x[1], 0., 0., 0., x[2]}, {}, name);
    if (name == "matrix") {
      if (x[12] != 0. || x[13] != 0. || x[14] != 0. || x[15] != 1.)
        fail("the last row of a <matrix> of its scene is not 0 0 0 1");
      return whole_space({x[0], x[1], x[2], x[4], x[5], x[6], x[8], x[9], x[10]},
                         {x[3], x[7], x[11]}, name);
    }
    const Vector3d axis{x[0], x[1], x[2]};
    const double angle = x[3] * std::numbers::pi / 180.;
    if (!(norm(axis) > 0.)) {
      if (angle != 0.) fail("a <rotate> of its scene has an axis of length 0");
      return {};
    }
    return {rotation_matrix(exponential((angle / norm(axis)) * axis)), {}};
  }

  /// Refuses what maps space to a plane, a line or a point.
  Affine whole_space(const Matrix3d& A, const Vector3d& t, std::string_view name) {
    if (!(std::abs(determinant(A)) > 0.))
      fail(fmt::format("a <{}> of its scene leaves nothing of a volume", name));
    return {A, t};
  }

  void add_geometry(const pugi::xml_node& geometry, const Affine& X) {
    const std::size_t before = mesh_.vertices.size();
    const pugi::xml_node mesh = geometry.child("mesh");
    for (const pugi::xml_node& vertices : mesh.children("vertices")) {
      const pugi::xml_node input =
          vertices.find_child_by_attribute("input", "semantic", "POSITION");
      if (!input) return fail("its <vertices> have no input of semantic POSITION");
      if (const pugi::xml_node source = find(input, "source")) add_positions(source, X);
    }
    for (const pugi::xml_node& faces : mesh.children()) {
      if (failed()) return;
      const std::string_view kind = faces.name();
      if (kind == "triangles" || kind == "polylist" || kind == "lines")
        check_faces(faces, mesh_.vertices.size() - before);
    }
  }

  /// Only positions are read of a mesh; its faces show whether they are whole. As many as it says,
  /// each with an index for every input, and none beyond the `vertices`.
  void check_faces(const pugi::xml_node& faces, std::size_t vertices) {
    std::size_t stride = 0, position = 0;
    for (const pugi::xml_node& input : faces.children("input")) {
      const std::size_t offset = whole(input, "offset", 0);
      stride = std::max(stride, offset + 1);
      if (std::string_view(input.attribute("semantic").value()) == "VERTEX") position = offset;
    }
    std::vector<double> indices, corners;
    read_numbers(faces.child("p").text().get(), indices, most_numbers);
    read_numbers(faces.child("vcount").text().get(), corners, most_numbers);
    const std::size_t count = whole(faces, "count", 0);
    if (failed()) return;
    const std::string_view kind = faces.name();
    double wanted = static_cast<double>(count * (kind == "lines" ? 2 : 3));
    if (kind == "polylist") {
      wanted = std::accumulate(corners.begin(), corners.end(), 0.);
      if (corners.size() != count)
        return fail(fmt::format("<polylist count=\"{}\"> has {} numbers in its <vcount>", count,
                                corners.size()));
    }
    if (static_cast<double>(indices.size()) != wanted * static_cast<double>(stride))
      return fail(fmt::format("<{} count=\"{}\"> has {} indices in its <p>, and {} belong to it",
                              kind, count, indices.size(), wanted * static_cast<double>(stride)));
    for (std::size_t i = position; i < indices.size(); i += stride) {
      if (indices[i] >= 0. && indices[i] < static_cast<double>(vertices) &&
          indices[i] == std::floor(indices[i]))
        continue;
      return fail(fmt::format("its <{}> name vertex {:g} of {}, counted from 0", kind, indices[i],
                              vertices));
    }
  }

  void add_positions(const pugi::xml_node& source, const Affine& X) {
    const pugi::xml_node accessor = source.child("technique_common").child("accessor");
    const pugi::xml_node array =
        accessor.attribute("source") ? find(accessor, "source") : source.child("float_array");
    std::vector<double> numbers;
    read_numbers(array.text().get(), numbers, most_numbers);
    if (numbers.size() > most_numbers)
      return fail(fmt::format("it has more than {} numbers", most_numbers));
    if (const std::size_t said = whole(array, "count", numbers.size()); said != numbers.size())
      fail(fmt::format("<float_array count=\"{}\"> has {} numbers", said, numbers.size()));
    const std::size_t stride = whole(accessor, "stride", 3), offset = whole(accessor, "offset", 0);
    if (stride < 3) fail("its positions have fewer than three numbers");
    if (failed()) return;
    const std::size_t behind = numbers.size() - std::min(offset, numbers.size());
    const std::size_t there = behind / stride, left = behind % stride;
    const std::size_t count = whole(accessor, "count", there);
    if (count != there || left != 0)
      fail(
          fmt::format("an <accessor> takes {} vertices of {} numbers each, and there are {} "
                      "numbers from its offset {} on",
                      count, stride, behind, offset));
    if (mesh_.vertices.size() + count > most_vertices)
      fail(fmt::format("it has more than {} vertices", most_vertices));
    if (failed()) return;
    for (std::size_t i = 0; i < count; ++i) {
      const double* p = numbers.data() + offset + stride * i;
      mesh_.vertices.push_back(X.A * Vector3d{p[0], p[1], p[2]} + X.t);
    }
  }

  /// All that `text` has, or one more than `most`.
  void read_numbers(std::string_view text, std::vector<double>& numbers, std::size_t most) {
    for (std::string_view word = next_word(text); !word.empty(); word = next_word(text)) {
      const std::optional<double> number = mesh_number(word);
      if (!number) return fail(fmt::format("`{}` is no number", shown(word)));
      numbers.push_back(*number);
      if (numbers.size() > most) return;
    }
  }

  pugi::xml_document document_;
  std::unordered_map<std::string_view, pugi::xml_node> ids_;
  MeshPoints mesh_;
  std::size_t nodes_ = 0;
};

}  // namespace

MeshPoints read_collada(std::string_view bytes) { return ColladaScene().read(bytes); }

}  // namespace hookpoint::simulation
