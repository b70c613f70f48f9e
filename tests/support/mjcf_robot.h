// MJCF drawn at random: bodies in a tree with joints of all kinds, several a body, frames of every
// notation, geoms and inertials, default classes.
#pragma once

#include <array>
#include <random>
#include <sstream>
#include <string>

namespace hookpoint::tests {

class RandomMjcf {
 public:
  explicit RandomMjcf(unsigned seed) : engine_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * (double(engine_()) / double(std::mt19937::max()));
  }
  int below(int n) { return int(engine_() % unsigned(n)); }

  /// `bodies` in a tree, the first of them free.
  std::string robot(int bodies) {
    count_ = 0;
    std::ostringstream out;
    radian_ = below(2) == 0;
    const std::array sequences{"xyz", "zyx", "XYZ", "zXz", "YzX"};
    out << "<mujoco model=\"drawn\"><compiler autolimits=\"true\" angle=\""
        << (radian_ ? "radian" : "degree") << "\" eulerseq=\"" << sequences[std::size_t(below(5))]
        << "\" balanceinertia=\"true\" inertiafromgeom=\"" << (below(3) == 0 ? "true" : "auto")
        << "\"/>\n<default><geom density=\"700\"/>"
        << "<joint armature=\"0.01\"/><default class=\"arm\"><joint axis=\"0 1 0\" damping=\"0.1\"/>"
        << "<geom type=\"capsule\" size=\"0.03 0.1\"/><default class=\"hand\"><joint axis=\"1 0 "
           "0\"/><geom size=\"0.02\"/></default></default></default>\n<worldbody>";
    int left = bodies;
    body(out, left, true);
    out << "</worldbody></mujoco>\n";
    return out.str();
  }

 private:
  std::string numbers(int n, double size) {
    std::ostringstream out;
    out.precision(17);
    for (int i = 0; i < n; ++i) out << (i == 0 ? "" : " ") << uniform(-size, size);
    return out.str();
  }
  std::string angle(double size) { return numbers(1, radian_ ? size : size * 57.); }
  std::string angles() { return numbers(3, radian_ ? 3. : 170.); }

  std::string orientation() {
    switch (below(6)) {
      case 0:
        return " quat=\"" + numbers(4, 1.) + "\"";
      case 1:
        return " euler=\"" + angles() + "\"";
      case 2:
        return " axisangle=\"" + numbers(3, 1.) + " " + angle(3.) + "\"";
      case 3:
        return " xyaxes=\"" + numbers(6, 1.) + "\"";
      case 4:
        return " zaxis=\"" + numbers(3, 1.) + "\"";
      default:
        return "";
    }
  }

  void geom(std::ostringstream& out) {
    const double a = uniform(0.02, 0.1), b = uniform(0.02, 0.1), c = uniform(0.02, 0.1);
    std::ostringstream size;
    size << " size=\"" << a << ' ' << b << ' ' << c << "\" pos=\"" << numbers(3, 0.2) << '"'
         << orientation();
    switch (below(6)) {
      case 0:
        out << "<geom type=\"sphere\" mass=\"0.7\"" << size.str() << "/>";
        break;
      case 1:
        out << "<geom class=\"arm\" fromto=\"" << numbers(6, 0.2) << "\"/>";
        break;
      case 2:
        out << "<geom type=\"cylinder\" contype=\"0\" conaffinity=\"0\"" << size.str() << "/>";
        break;
      case 3:
        out << "<geom type=\"box\" friction=\"0.4\"" << size.str() << "/>";
        break;
      case 4:
        out << "<geom type=\"ellipsoid\" density=\"300\"" << size.str() << "/>";
        break;
      default:
        out << "<geom class=\"hand\" pos=\"" << numbers(3, 0.2) << "\"/>";
    }
  }

  void joint(std::ostringstream& out) {
    const std::string name = "j" + std::to_string(count_) + "_" + std::to_string(joints_++);
    out << "<joint name=\"" << name << "\" pos=\"" << numbers(3, 0.1) << '"';
    if (below(4) == 0) {
      out << " type=\"slide\" ref=\"" << uniform(-0.1, 0.1) << "\" axis=\"" << numbers(3, 1.)
          << "\"/>";
    } else if (below(3) == 0) {
      out << " class=\"arm\" ref=\"" << angle(1.) << "\"/>";
    } else {
      out << " range=\"" << (radian_ ? "-1 2" : "-60 120") << "\" axis=\"" << numbers(3, 1.)
          << "\"/>";
    }
  }

  void body(std::ostringstream& out, int& left, bool is_free) {
    const int number = count_++;
    --left;
    out << "<body name=\"b" << number << "\" pos=\"" << numbers(3, 0.5) << '"' << orientation()
        << (below(4) == 0 ? " childclass=\"hand\"" : "") << ">";
    if (is_free) {
      out << "<freejoint name=\"root\"/>";
    } else {
      for (int joints = below(4); joints > 0; --joints) joint(out);
    }
    if (below(2) == 0)
      out << "<inertial pos=\"" << numbers(3, 0.1) << "\" mass=\"" << uniform(0.2, 3.) << '"'
          << (below(2) == 0 ? " quat=\"" + numbers(4, 1.) + "\" diaginertia=\"0.02 0.03 0.04\"/>"
                            : " fullinertia=\"0.03 0.03 0.04 0.001 -0.002 0.003\"/>");
    geom(out);
    if (below(2) == 0) geom(out);
    for (int children = below(3) + (is_free ? 1 : 0); children > 0 && left > 0; --children)
      body(out, left, false);
    out << "</body>\n";
  }

  std::mt19937 engine_;
  int count_ = 0, joints_ = 0;
  bool radian_ = false;
};

}  // namespace hookpoint::tests
