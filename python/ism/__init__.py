# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
"""Find objects of several classes in colour or RGB-D images, after learning from a few labelled pictures."""

from ._ism import Error, Model, __version__, decode_mask, encode_mask, load, train
from .types import Array, Arrays, Result, Rle

__all__ = [
    "Array",
    "Arrays",
    "Error",
    "Model",
    "Result",
    "Rle",
    "decode_mask",
    "encode_mask",
    "load",
    "train",
    "__version__",
]
