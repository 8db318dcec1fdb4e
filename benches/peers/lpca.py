"""The textbook local PCA (Mueller, Meseth, Klein 2003) in numpy and BLAS, single precision.

Arguments: a file of half floats [sample][channel][texel], written by benches/lpca.rs, the number of texels, of clusters, of components
and of iterations, and a seed. Prints JSON: the seconds that it took once the values are in memory, [texel][value] in single precision, and
the relative RMS error sqrt(sum of squared residuals / sum of squares) after each iteration, the last one again from the residuals themselves.

An iteration is the PCA of every cluster, by the eigenvectors of the smaller of its two Gram matrices, and then the assignment of every texel
to the cluster whose affine subspace reconstructs it best, by one matrix product with all means and eigenvectors.
"""

import json
import sys
import time

import numpy as np
from scipy.linalg import eigh

file, (texels, clusters, components, iterations, seed) = sys.argv[1], map(int, sys.argv[2:7])
halves = np.fromfile(file, np.float16).reshape(-1, texels)
x = np.ascontiguousarray(halves.T).astype(np.float32)
# Masked samples.
x[x < 0] = 0
del halves


def pca(y):
    """Mean and leading eigenvectors of the rows of y, which is overwritten."""
    mean = y.mean(0)
    y -= mean
    basis = np.zeros((components, y.shape[1]), np.float32)
    count = min(components, len(y) - 1, y.shape[1])
    if count < 1:
        return mean, basis
    rows = len(y) <= y.shape[1]
    gram = y @ y.T if rows else y.T @ y
    values, vectors = eigh(gram, overwrite_a=True, check_finite=False, subset_by_index=[len(gram) - count, len(gram) - 1])
    held = values > 1e-6 * np.trace(gram)
    vectors = vectors[:, held]
    basis[: vectors.shape[1]] = (vectors / np.sqrt(values[held])).T @ y if rows else vectors.T
    return mean, basis


def distances(x, squares, means, bases):
    """Squared distance of every row of x to the affine subspace of every cluster."""
    products = x @ np.concatenate([means, bases.reshape(-1, x.shape[1])]).T
    to_means = products[:, : len(means)]
    along = products[:, len(means) :].reshape(len(x), *bases.shape[:2])
    along -= np.einsum("kcd,kd->kc", bases, means)
    return squares[:, None] - 2 * to_means + np.einsum("kd,kd->k", means, means) - np.einsum("tkc,tkc->tk", along, along)


start = time.perf_counter()
energy = np.einsum("td,td->", x, x, dtype=np.float64)
centre = x.mean(0)
x -= centre
squares = np.einsum("td,td->t", x, x)
random = np.random.default_rng(seed)
means = x[random.choice(len(x), clusters, replace=len(x) < clusters)]
bases = np.zeros((clusters, components, x.shape[1]), np.float32)
found = distances(x, squares, means, bases[:, :0])
errors = []
for _ in range(iterations):
    cluster, left = found.argmin(1), found.min(1)
    for k in range(clusters):
        members = np.flatnonzero(cluster == k)
        if len(members) == 0:
            # An empty cluster takes the texel that is reconstructed worst.
            members = left.argmax(keepdims=True)
            left[members] = 0
        means[k], bases[k] = pca(x[members])
    found = distances(x, squares, means, bases)
    errors.append(float(np.sqrt(np.maximum(found.min(1), 0).sum(dtype=np.float64) / energy)))
seconds = time.perf_counter() - start

cluster = found.argmin(1)
residual = 0.0
for k in range(clusters):
    y = x[cluster == k] - means[k]
    y -= (y @ bases[k].T) @ bases[k]
    residual += np.einsum("td,td->", y, y, dtype=np.float64)
print(json.dumps({"seconds": seconds, "errors": errors, "relative_rms": float(np.sqrt(residual / energy))}))
