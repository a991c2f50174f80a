#pragma once
// Dense linear algebra that tests hold sparse results against, compiled once: Eigen's decompositions take seconds to compile.
#include <Eigen/Core>

namespace garment::test {

/// Eigenvalues of a symmetric matrix, ascending.
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric);

/// Solves a x = b for a symmetric definite matrix.
Eigen::VectorXd solved(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

}  // namespace garment::test
