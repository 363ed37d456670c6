# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
"""Find objects of several classes in colour or RGB-D images, after learning from a few labelled pictures."""

from ._ism import Error, Model, __version__, decode_mask, encode_mask, load, train

__all__ = ["Error", "Model", "decode_mask", "encode_mask", "load", "train", "__version__"]
