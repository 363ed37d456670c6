# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
"""Average link of squared Euclidean distances by fastcluster or SciPy, for peers_clustering.

Reads float32 rows; prints the seconds of distances and of linkage, the sum of heights and the memory taken beyond the
rows as JSON; writes the cluster of each row at the cut as uint32, clusters numbered by their first row. Times hold
neither reading nor writing. Exit code 3: a library is missing.
"""
import argparse
import json
import resource
import sys
import time

try:
    import numpy
    import scipy.cluster.hierarchy
    import scipy.spatial.distance
    import fastcluster
except ImportError as error:
    print(error, file=sys.stderr)
    sys.exit(3)


def by_products(rows, scalar):
    """All squared distances in condensed form, from blocks of dot products."""
    rows = rows.astype(scalar)
    count = len(rows)
    square = numpy.einsum("ij,ij->i", rows, rows)
    distances = numpy.empty(count * (count - 1) // 2)
    at = 0
    block = 32  # a block of distances stays in cache
    for first in range(0, count, block):
        part = rows[first:first + block] @ rows[first:].T
        part *= -2
        part += square[first:]
        part += square[first:first + block, None]
        numpy.maximum(part, 0, out=part)
        for row in range(len(part)):
            end = at + count - 1 - first - row
            distances[at:end] = part[row, row + 1:]
            at = end
    return distances


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("rows")
    parser.add_argument("labels")
    parser.add_argument("--dimension", type=int, required=True)
    parser.add_argument("--cut", type=float, required=True)
    parser.add_argument("--distances", choices=["float32", "float64", "pdist"], default="float32")
    parser.add_argument("--linkage", choices=["fastcluster", "scipy"], default="fastcluster")
    options = parser.parse_args()

    rows = numpy.fromfile(options.rows, dtype=numpy.float32).reshape(-1, options.dimension)
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    begin = time.perf_counter()
    if options.distances == "pdist":
        distances = scipy.spatial.distance.pdist(rows, "sqeuclidean")
    else:
        distances = by_products(rows, numpy.dtype(options.distances))
    middle = time.perf_counter()
    if options.linkage == "scipy":
        merges = scipy.cluster.hierarchy.linkage(distances, "average")
    else:
        merges = fastcluster.linkage(distances, "average", preserve_input=False)
    end = time.perf_counter()
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - memory

    labels = scipy.cluster.hierarchy.fcluster(merges, options.cut, "distance")
    _, first, named = numpy.unique(labels, return_index=True, return_inverse=True)
    named = numpy.argsort(numpy.argsort(first))[named]
    named.astype(numpy.uint32).tofile(options.labels)
    print(json.dumps({"distances_s": middle - begin, "linkage_s": end - middle, "sum": merges[:, 2].sum(),
                      "memory_mib": memory / 1024}))


main()
