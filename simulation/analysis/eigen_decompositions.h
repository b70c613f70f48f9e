// Eigen's eigenvalues, compiled once: each kind costs the compiler many seconds in every file that
// uses it.
#pragma once

#include <Eigen/Core>

namespace hookpoint::simulation {

/// Of any square matrix, in no order.
Eigen::VectorXcd general_eigenvalues(const Eigen::MatrixXd& matrix);

/// Of a symmetric matrix, in ascending order.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix);

}  // namespace hookpoint::simulation
