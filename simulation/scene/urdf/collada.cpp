// Collada 1.4 and 1.5: the positions of every geometry that the scene shows, each under the
// transforms of its nodes.
#include <fmt/format.h>

#include <array>
#include <numbers>
#include <pugixml.hpp>
#include <unordered_map>

#include "math/rotation.h"
#include "simulation/scene/urdf/mesh.h"
#include "simulation/scene/urdf/mesh_words.h"

namespace hookpoint::simulation {
namespace {

constexpr std::size_t most_vertices = 10'000'000;
// Nodes may stand in one another by name, and a file may say so of a hundred in ten lines.
constexpr std::size_t most_nodes = 100'000;
constexpr int most_depth = 100;

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
    const double metre = root.child("asset").child("unit").attribute("meter").as_double(1.);
    const Affine X{metre * Matrix3d::identity(), {}};
    pugi::xml_node scene = find(root.child("scene").child("instance_visual_scene"), "url");
    if (!scene) scene = root.child("library_visual_scenes").child("visual_scene");
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

  /// What `attribute` of `node` names: "#id".
  pugi::xml_node find(const pugi::xml_node& node, const char* attribute) const {
    const std::string_view url = node.attribute(attribute).value();
    const auto found = url.starts_with('#') ? ids_.find(url.substr(1)) : ids_.end();
    return found == ids_.end() ? pugi::xml_node() : found->second;
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
        add_geometry(find(find(part, "url").child("skin"), "source"), X);
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
    if (name == "scale") return {{x[0], 0., 0., 0., x[1], 0., 0., 0., x[2]}, {}};
    if (name == "matrix")
      return {{x[0], x[1], x[2], x[4], x[5], x[6], x[8], x[9], x[10]}, {x[3], x[7], x[11]}};
    const Vector3d axis{x[0], x[1], x[2]};
    if (!(norm(axis) > 0.)) return {};
    const double angle = x[3] * std::numbers::pi / 180.;
    return {rotation_matrix(exponential((angle / norm(axis)) * axis)), {}};
  }

  void add_geometry(const pugi::xml_node& geometry, const Affine& X) {
    for (const pugi::xml_node& vertices : geometry.child("mesh").children("vertices")) {
      const pugi::xml_node input =
          vertices.find_child_by_attribute("input", "semantic", "POSITION");
      add_positions(find(input, "source"), X);
    }
  }

  void add_positions(const pugi::xml_node& source, const Affine& X) {
    const pugi::xml_node accessor = source.child("technique_common").child("accessor");
    const std::size_t stride = accessor.attribute("stride").as_uint(3);
    const std::size_t offset = accessor.attribute("offset").as_uint(0);
    std::vector<double> numbers;
    read_numbers(source.child("float_array").text().get(), numbers, 3 * most_vertices);
    if (stride < 3) fail("its positions have fewer than three numbers");
    if (failed()) return;
    for (std::size_t i = offset; i + 3 <= numbers.size(); i += stride) {
      if (mesh_.vertices.size() == most_vertices)
        return fail(fmt::format("it has more than {} vertices", most_vertices));
      mesh_.vertices.push_back(X.A * Vector3d{numbers[i], numbers[i + 1], numbers[i + 2]} + X.t);
    }
  }

  /// All that `text` has, or one more than `most`.
  void read_numbers(std::string_view text, std::vector<double>& numbers, std::size_t most) {
    for (std::string_view word = next_word(text); !word.empty(); word = next_word(text)) {
      const std::optional<double> number = mesh_number(word);
      if (!number) return fail(fmt::format("`{}` is no number", word.substr(0, 40)));
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
