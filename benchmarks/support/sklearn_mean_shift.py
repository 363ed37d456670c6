# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
"""scikit-learn's mean shift, one thread: sklearn_mean_shift.py VOTES STARTS DIMENSION ROUNDS
VOTES and STARTS are files of float32 rows in units of the window. Prints median milliseconds, then the modes,
strongest first, one a line."""
import sys
import time

import numpy
from sklearn.cluster import MeanShift

dimension = int(sys.argv[3])
votes, starts = (numpy.fromfile(name, numpy.float32).reshape(-1, dimension) for name in sys.argv[1:3])
times = []
for _ in range(int(sys.argv[4])):
    begin = time.perf_counter()
    found = MeanShift(bandwidth=1, seeds=starts, max_iter=50, n_jobs=1).fit(votes)
    times.append(1000 * (time.perf_counter() - begin))
print(numpy.median(times))
for mode in found.cluster_centers_:
    print(*mode)
