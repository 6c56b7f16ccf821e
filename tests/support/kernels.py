"""The kernel of a search's processes, by another program."""

from sklearn.gaussian_process.kernels import ConstantKernel, Matern, WhiteKernel


def matern(dimension, theta=None):
    """Return scikit-learn's kernel: constant times Matérn 5/2 with one length scale per axis, plus noise."""
    kernel = ConstantKernel(1.0, (1e-2, 1e3)) * Matern([0.5] * dimension, (0.05, 10.0), nu=2.5) + WhiteKernel(
        1e-4, (1e-6, 1e-1)
    )
    return kernel if theta is None else kernel.clone_with_theta(theta)
