// SPDX-License-Identifier: GPL-2.0-or-later
//
// kins_solve.cc - small linear systems of iterative kinematics.
//
// In, out: kins_common.h   Thread: servo; fixed-size storage, no allocation
// Method:  QR with column pivoting (Eigen), which shows the rank.
#define EIGEN_NO_MALLOC
#include <Eigen/Dense>
#include "kins_common.h"

namespace {

constexpr double SINGULAR = 1e-10; // smallest against largest pivot

template <int Max> using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, Max, Max>;
template <int Max> using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, Max, 1>;

int solve(int rows, int cols, const double *a, const double *b, double *x)
{
    if (rows < 1 || cols < 1 || rows > 9 || cols > 9) return -1;
    Matrix<9> m =
        Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(a, rows, cols);
    Vector<9> rhs = Eigen::Map<const Eigen::VectorXd>(b, rows);
    if (!m.allFinite() || !rhs.allFinite()) return -1;
    Eigen::ColPivHouseholderQR<Matrix<9>> qr;
    qr.setThreshold(SINGULAR);
    qr.compute(m);
    if (qr.rank() < std::min(rows, cols)) return -1;
    Vector<9> result = qr.solve(rhs);
    for (int i = 0; i < cols; i++) x[i] = result[i];
    return 0;
}

} // namespace

extern "C" int kins_solve(int n, const double *a, const double *b, double *x) { return solve(n, n, a, b, x); }
extern "C" int kins_least_squares(int rows, int cols, const double *a, const double *b, double *x)
{
    return solve(rows, cols, a, b, x);
}
