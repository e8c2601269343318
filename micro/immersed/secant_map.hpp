#pragma once

#include <Eigen/Core>

namespace hemoscale::micro {

/// A linear map that is known by examples alone: v = M f, M changed as little as possible (in the
/// norm of Frobenius) with every pair that is learned,
///
///   M <- M + (v - M f) f^T / (f.f)
///
/// the update of [Broyden1965].
class SecantMap {
 public:
  explicit SecantMap(Eigen::Index size) : matrix_(Eigen::MatrixXd::Zero(size, size)) {}

  Eigen::VectorXd operator()(const Eigen::VectorXd& f) const { return matrix_ * f; }

  /// Nothing is learned from a zero.
  void learn(const Eigen::VectorXd& f, const Eigen::VectorXd& v) {
    const double square = f.squaredNorm();
    if (!(square > 0)) return;
    const Eigen::VectorXd missed = (v - matrix_ * f) / square;
    matrix_.noalias() += missed * f.transpose();
  }

  const Eigen::MatrixXd& matrix() const { return matrix_; }
  void restore(Eigen::MatrixXd matrix) { matrix_ = std::move(matrix); }

 private:
  Eigen::MatrixXd matrix_;
};

}  // namespace hemoscale::micro
