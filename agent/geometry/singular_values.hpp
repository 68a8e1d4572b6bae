// The singular value decomposition of small matrices, which is the eigenvalue decomposition of a
// covariance. Compiled once for matrices of all types and sizes, as cholesky.hpp.
#pragma once

#include <Eigen/Core>

namespace gazed::geometry {

/// Decomposes A = U S V^T with no fewer rows than columns by turning its columns until all are at
/// right angles (Hestenes 1958). `a` becomes U S; its columns ascend in length. `v` is as wide as
/// `a`, square.
void decompose(Eigen::Ref<Eigen::MatrixXd> a, Eigen::Ref<Eigen::MatrixXd> v);

}  // namespace gazed::geometry
