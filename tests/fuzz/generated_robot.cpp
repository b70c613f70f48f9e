#include "tests/fuzz/generated_robot.h"

#include <cstring>

#include "tests/fuzz/drawn_text.h"

namespace hookpoint::fuzz {
namespace {

class RobotDrawing : DrawnText {
 public:
  RobotDrawing(const language::Schema& none, std::uint64_t seed, double degenerate)
      : DrawnText(none, seed), wrong_(degenerate) {}

  GeneratedRobot robot() {
    write("<robot name=\"drawn\">");
    const std::size_t links = 1 + below(5);
    for (std::size_t i = 0; i < links; ++i) link(i);
    for (std::size_t i = 1; i < links; ++i) joint(i);
    for (std::size_t i = 1; i < links; ++i)
      if (chance(0.3)) transmission(i);
    write("</robot>");
    std::string arguments =
        one_of(std::vector<std::string>{"", ", meshes = box", ", meshes = hull", ", meshes = hull",
                                        ", shapes = visual", ", shapes = inertia"});
    if (chance(0.5)) arguments += ", hold = " + value(0.01, 0.2) + " rad";
    if (chance(0.2)) arguments += ", base = fixed";
    if (chance(0.2)) arguments += ", rotor_inertia = " + value(1e-4, 1e-2);
    if (chance(0.2)) arguments += ", j1 = " + value(0., 0.1) + " rad";
    files_.insert(files_.begin(), {"drawn.urdf", text_});
    return {files_, arguments};
  }

 private:
  std::string value(double least, double greatest) {
    if (!chance(wrong_)) return number(between(least, greatest));
    return one_of(std::vector<std::string>{"0", "-1", "1e-300", "1e11", "1e13", "nan", "", "x"});
  }
  std::string vector(double least, double greatest) {
    return value(least, greatest) + " " + value(least, greatest) + " " + value(least, greatest);
  }

  void link(std::size_t i) {
    write("<link name=\"l" + std::to_string(i) + "\">");
    if (!chance(0.1)) {
      write("<inertial><mass value=\"" + value(0.1, 3.) + "\"/><inertia ixx=\"" +
            value(0.01, 0.012) + "\" iyy=\"0.011\" izz=\"0.012\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/>" +
            "</inertial>");
    }
    const char* kind = chance(0.8) ? "collision" : "visual";
    for (std::size_t shapes = below(3); shapes > 0; --shapes)
      write("<" + std::string(kind) + "><origin xyz=\"" + vector(-0.05, 0.05) + "\" rpy=\"" +
            vector(-1., 1.) + "\"/><geometry>" + geometry() + "</geometry></" + kind + ">");
    write("</link>");
  }

  std::string geometry() {
    switch (below(5)) {
      case 0:
        return "<box size=\"" + vector(0.02, 0.2) + "\"/>";
      case 1:
        return "<sphere radius=\"" + value(0.02, 0.1) + "\"/>";
      case 2:
        return "<cylinder radius=\"" + value(0.02, 0.1) + "\" length=\"" + value(0.02, 0.2) +
               "\"/>";
      default:
        return "<mesh filename=\"" + mesh() + "\" scale=\"1 1 " + value(0.5, 2.) + "\"/>";
    }
  }

  /// A tetrahedron in one of the formats.
  std::string mesh() {
    const std::string size = value(0.02, 0.1);
    const std::vector<std::string> corners{"0 0 0", size + " 0 0", "0 " + size + " 0",
                                           "0 0 " + size};
    const std::string name = "m" + std::to_string(files_.size());
    std::string text, ending;
    switch (below(4)) {
      case 0:
        ending = ".obj";
        for (const std::string& corner : corners) text += "v " + corner + "\n";
        text += chance(wrong_) ? "f 1 2 9\n" : "f 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n";
        break;
      case 1:
        ending = ".stl";
        text = "solid m\n";
        for (const auto& side : sides)
          for (const std::size_t k : side) text += "vertex " + corners[k] + "\n";
        text += "endsolid m\n";
        break;
      case 2:
        ending = ".stl";
        text = binary_stl();
        break;
      default:
        ending = ".dae";
        text = "<COLLADA><asset><unit meter=\"" + value(0.5, 2.) +
               "\"/></asset><library_geometries><geometry id=\"g\"><mesh><source id=\"p\">"
               "<float_array count=\"" +
               std::string(chance(wrong_) ? "9" : "12") + "\">";
        for (const std::string& corner : corners) text += corner + " ";
        text += "</float_array><technique_common><accessor count=\"4\" stride=\"" +
                std::string(chance(wrong_) ? "5" : "3") +
                "\"/></technique_common></source><vertices><input semantic=\"POSITION\" "
                "source=\"#p\"/></vertices></mesh></geometry></library_geometries></COLLADA>";
    }
    files_.push_back({name + ending, text});
    return name + ending;
  }

  std::string binary_stl() {
    std::string bytes(80, ' ');
    const auto add = [&](const auto& plain) {
      bytes.append(reinterpret_cast<const char*>(&plain), sizeof plain);
    };
    const std::uint32_t triangles = chance(wrong_) ? static_cast<std::uint32_t>(random_()) : 4U;
    add(triangles);
    for (const auto& side : sides) {
      for (int k = 0; k < 3; ++k) add(0.F);
      for (const std::size_t corner : side)
        for (std::size_t axis = 1; axis < 4; ++axis) add(corner == axis ? 0.05F : 0.F);
      add(std::uint16_t{0});
    }
    return bytes;
  }

  void joint(std::size_t i) {
    const std::string type = one_of(std::vector<std::string>{"revolute", "revolute", "continuous",
                                                             "prismatic", "fixed", "revolute"});
    const std::string child = std::to_string(i), parent = std::to_string(below(i));
    write("<joint name=\"j" + child + "\" type=\"" + type + "\"><parent link=\"l" + parent +
          "\"/><child link=\"l" + child + "\"/><origin xyz=\"" + vector(-0.2, 0.2) + "\"/>");
    write("<axis xyz=\"" + one_of(std::vector<std::string>{"1 0 0", "0 1 0", "0 0 1", "1 1 0"}) +
          "\"/>");
    if (chance(0.7))
      write("<limit lower=\"" + value(-1., -0.1) + "\" upper=\"" + value(0.1, 1.) + "\" effort=\"" +
            value(1., 50.) + "\" velocity=\"3\"/>");
    if (chance(0.5))
      write("<dynamics damping=\"" + value(0., 1.) + "\" friction=\"" + value(0., 0.5) + "\"/>");
    write("</joint>");
  }

  void transmission(std::size_t i) {
    write("<transmission name=\"t" + std::to_string(i) + "\"><joint name=\"j" + std::to_string(i) +
          "\"/><actuator name=\"a\"><motorInertia>" + value(1e-6, 1e-4) +
          "</motorInertia><mechanicalReduction>" + value(1., 100.) +
          "</mechanicalReduction></actuator></transmission>");
  }

  static constexpr std::size_t sides[4][3] = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
  const double wrong_;
  std::vector<GeneratedFile> files_;
};

}  // namespace

GeneratedRobot generate_robot(std::uint64_t seed, double degenerate) {
  const language::Schema none;
  return RobotDrawing(none, seed, degenerate).robot();
}

}  // namespace hookpoint::fuzz
