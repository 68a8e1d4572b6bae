// Cholesky's factors of small symmetric matrices.
//
// Plain loops, compiled once for matrices of all types and sizes: Eigen's decompositions are
// templates of the matrix, and each new one takes seconds to compile. No memory is allocated, and
// every sum has the same order on every CPU.
#pragma once

#include <Eigen/Core>

namespace gazed::geometry {

/// Puts L into the lower triangle of a matrix that is L L^T; what is above the diagonal is neither
/// read nor written. False when the matrix is not positive definite: it is then spoilt.
[[nodiscard]] bool factorise(Eigen::Ref<Eigen::MatrixXd> matrix);

/// Solves L L^T x = b for every column of `b`, in its place.
void solve_factorised(const Eigen::Ref<const Eigen::MatrixXd>& l, Eigen::Ref<Eigen::MatrixXd> b);

/// Turns L into the inverse of L L^T, both triangles.
void invert_factorised(Eigen::Ref<Eigen::MatrixXd> l);

/// W of a covariance C: W C W^T = I.
[[nodiscard]] Eigen::Matrix2d whitening(const Eigen::Matrix2d& covariance);

}  // namespace gazed::geometry
