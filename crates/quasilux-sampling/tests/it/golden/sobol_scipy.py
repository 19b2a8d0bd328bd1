"""Writes sobol_scipy.txt beside it: python3 sobol_scipy.py > sobol_scipy.txt (made with scipy 1.17.1)."""

import numpy as np
from scipy.stats import qmc

points = (qmc.Sobol(d=50, scramble=False).random(4096) * 4096).astype(np.uint64)
print("# scipy.stats.qmc.Sobol(d=50, scramble=False).random(4096) in units of 1/4096, made by sobol_scipy.py")
print("# point i: its 50 coordinates")
for i in list(range(32)) + [100, 1000, 2047, 2048, 3000, 4095]:
    print(f"point {i}:", *points[i])
print("# hash: for each dimension FNV-1a, offset 14695981039346656037, prime 1099511628211, one 64-bit word for each of 4096 points")
hashes = np.full(50, 14695981039346656037, dtype=np.uint64)
for row in points:
    hashes = (hashes ^ row) * np.uint64(1099511628211)
for d in range(50):
    print(f"hash {d}: {hashes[d]}")
