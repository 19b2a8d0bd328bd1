"""Discrepancies by scipy: python discrepancy_scipy.py > discrepancy_scipy.txt (scipy 1.17.1)"""

import numpy
from scipy.stats import qmc


def points(n, d):
    rows = [[(i * i * (7 * j + 3) + i * (29 * j + 11) + 5 * j * j) % 1009 for j in range(d)] for i in range(n)]
    return (numpy.array(rows) + 0.5) / 1009


print("# points, dimensions, scipy.stats.qmc.discrepancy by methods CD, WD, MD, L2-star; points by discrepancy_scipy.py")
for n, d in [(1, 1), (7, 1), (2, 2), (16, 2), (100, 2), (5, 3), (64, 3), (50, 5), (33, 8), (128, 16), (40, 32)]:
    values = [qmc.discrepancy(points(n, d), method=method) for method in ("CD", "WD", "MD", "L2-star")]
    print(n, d, *[repr(float(value)) for value in values])
