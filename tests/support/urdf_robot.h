// A robot in URDF's own terms, drawn at random: its text, and its kinematics and mass matrix worked
// out from the same numbers as URDF defines them. Shares nothing with the reader.
#pragma once

#include <eigen3/Eigen/Dense>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace hookpoint::tests {

struct UrdfNumbers {
  struct Link {
    std::string name;
    double mass = 0.;
    Eigen::Vector3d xyz, rpy;             // of the inertial frame
    double ixx, iyy, izz, ixy, ixz, iyz;  // in its axes
  };
  struct Joint {
    std::string name, type;
    std::size_t parent = 0, child = 0;  // parents come before their children
    Eigen::Vector3d xyz, rpy, axis;
    bool moves() const { return type != "fixed"; }
  };
  std::vector<Link> links;
  std::vector<Joint> joints;  // joint i carries link i + 1

  std::string text() const {
    std::ostringstream out;
    out.precision(17);
    const auto three = [&](const char* name, const Eigen::Vector3d& v) {
      out << ' ' << name << "=\"" << v.x() << ' ' << v.y() << ' ' << v.z() << '"';
    };
    out << "<robot name=\"random\">\n";
    for (const Link& link : links) {
      out << "<link name=\"" << link.name << "\"><inertial><origin";
      three("xyz", link.xyz);
      three("rpy", link.rpy);
      out << "/><mass value=\"" << link.mass << "\"/><inertia ixx=\"" << link.ixx << "\" iyy=\""
          << link.iyy << "\" izz=\"" << link.izz << "\" ixy=\"" << link.ixy << "\" ixz=\""
          << link.ixz << "\" iyz=\"" << link.iyz << "\"/></inertial></link>\n";
    }
    for (const Joint& joint : joints) {
      out << "<joint name=\"" << joint.name << "\" type=\"" << joint.type << "\"><parent link=\""
          << links[joint.parent].name << "\"/><child link=\"" << links[joint.child].name
          << "\"/><origin";
      three("xyz", joint.xyz);
      three("rpy", joint.rpy);
      out << "/>";
      if (joint.moves()) {
        out << "<axis";
        three("xyz", joint.axis);
        out << "/>";
      }
      if (joint.type == "prismatic" || joint.type == "revolute")
        out << "<limit lower=\"-10\" upper=\"10\" effort=\"1\" velocity=\"1\"/>";
      out << "</joint>\n";
    }
    out << "</robot>\n";
    return out.str();
  }

  static Eigen::Matrix3d rotation(const Eigen::Vector3d& rpy) {
    return (Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) *
            Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
            Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX()))
        .toRotationMatrix();
  }

  /// Poses of all links in the world, `q` one a moving joint in the joints' order.
  std::vector<Eigen::Isometry3d> poses(const Eigen::Isometry3d& root,
                                       const std::vector<double>& q) const {
    std::vector<Eigen::Isometry3d> X(links.size(), root);
    std::size_t next = 0;
    for (const Joint& joint : joints) {
      Eigen::Isometry3d own = Eigen::Isometry3d::Identity();
      own.translation() = joint.xyz;
      own.linear() = rotation(joint.rpy);
      const Eigen::Vector3d axis = joint.axis.normalized();
      if (joint.type == "prismatic") own.translate(axis * q[next]);
      if (joint.type == "revolute" || joint.type == "continuous")
        own.rotate(Eigen::AngleAxisd(q[next], axis));
      if (joint.moves()) ++next;
      X[joint.child] = X[joint.parent] * own;
    }
    return X;
  }

  /// What the equations of motion need at rest: M, and the generalised force of gravity. Columns:
  /// angular and linear velocity of the root's origin, world axes; then the moving joints.
  struct Still {
    Eigen::MatrixXd M;
    Eigen::VectorXd gravity;
  };
  Still at_rest(const Eigen::Isometry3d& root, const std::vector<double>& q,
                const Eigen::Vector3d& g) const {
    const std::vector<Eigen::Isometry3d> X = poses(root, q);
    const auto n = Eigen::Index(6 + q.size());
    Still still{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)};
    for (std::size_t i = 0; i < links.size(); ++i) {
      Eigen::MatrixXd J(3, n), W = Eigen::MatrixXd::Zero(3, n);
      J.setZero();
      const Link& link = links[i];
      const Eigen::Vector3d c = X[i] * link.xyz;
      for (int k = 0; k < 3; ++k) {
        W(k, k) = 1.;
        J.col(k) = Eigen::Vector3d::Unit(k).cross(c - root.translation());
        J(k, 3 + k) = 1.;
      }
      for (std::size_t at = i; at > 0; at = joints[at - 1].parent) {
        const Joint& joint = joints[at - 1];
        if (!joint.moves()) continue;
        Eigen::Index column = 6;
        for (std::size_t j = 0; j + 1 < at; ++j) column += joints[j].moves();
        const Eigen::Vector3d z = X[at].linear() * joint.axis.normalized();
        if (joint.type == "prismatic") {
          J.col(column) = z;
        } else {
          J.col(column) = z.cross(c - X[at].translation());
          W.col(column) = z;
        }
      }
      const Eigen::Matrix3d R = X[i].linear() * rotation(link.rpy);
      Eigen::Matrix3d I;
      I << link.ixx, link.ixy, link.ixz, link.ixy, link.iyy, link.iyz, link.ixz, link.iyz, link.izz;
      still.M += link.mass * J.transpose() * J + W.transpose() * R * I * R.transpose() * W;
      still.gravity += J.transpose() * (link.mass * g);
    }
    return still;
  }
};

/// Chains of moving joints on a base, with links fixed to it and to them. `tilt`: how far the axes
/// of neighbouring joints are from parallel [rad]; beyond 1 they are anything.
class RandomUrdf {
 public:
  explicit RandomUrdf(unsigned seed) : engine_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * (double(engine_()) / double(std::mt19937::max()));
  }
  Eigen::Vector3d vector(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }

  UrdfNumbers robot(int chains, int length, double tilt) {
    UrdfNumbers robot;
    robot.links.push_back(link("trunk"));
    for (int k = 0; k < chains; ++k) {
      std::size_t parent = 0;
      for (int n = 0; n < length; ++n) {
        // What carries the next joint may be fixed to the link before it.
        if (uniform(0., 1.) < 0.4) parent = add(robot, parent, "fixed", 2.);
        const double kind = uniform(0., 3.);
        parent = add(robot, parent,
                     kind < 1.   ? "prismatic"
                     : kind < 2. ? "revolute"
                                 : "continuous",
                     n == 0 ? 2. : tilt);
        if (uniform(0., 1.) < 0.4) add(robot, parent, "fixed", 2.);
      }
    }
    return robot;
  }

  /// The same in one tree: each joint is carried by any link.
  UrdfNumbers tree(int joints, double tilt) {
    UrdfNumbers robot;
    robot.links.push_back(link("trunk"));
    for (int n = 0; n < joints; ++n) {
      const auto parent = std::size_t(uniform(0., double(robot.links.size())));
      const double kind = uniform(0., 4.);
      const char* type = kind < 1.   ? "fixed"
                         : kind < 2. ? "prismatic"
                         : kind < 3. ? "revolute"
                                     : "continuous";
      add(robot, std::min(parent, robot.links.size() - 1), type, parent == 0 ? 2. : tilt);
    }
    return robot;
  }

 private:
  UrdfNumbers::Link link(const std::string& name) {
    const double x = uniform(0.01, 0.2), y = uniform(0.01, 0.2), z = uniform(0.01, 0.2);
    const double mass = uniform(0.1, 2.);
    const double xy = 0.2 * mass * std::min(x, y), xz = 0.1 * mass * std::min(x, z);
    return {name,
            mass,
            vector(0.2),
            vector(3.),
            mass * (y + z + 0.1),
            mass * (x + z + 0.1),
            mass * (x + y + 0.1),
            xy,
            xz,
            0.};
  }

  std::size_t add(UrdfNumbers& robot, std::size_t parent, const std::string& type, double tilt) {
    const std::size_t child = robot.links.size();
    robot.links.push_back(link("l" + std::to_string(child)));
    UrdfNumbers::Joint joint{
        "j" + std::to_string(child), type, parent, child, vector(0.5), vector(3.), vector(1.)};
    if (tilt <= 1.) {
      joint.rpy = vector(tilt);
      joint.axis = Eigen::Vector3d(0., 0., 1.) + vector(tilt);
    }
    robot.joints.push_back(joint);
    return child;
  }

  std::mt19937 engine_;
};

}  // namespace hookpoint::tests
