# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
import os
from typing import Any, Callable, Dict, Iterable, List, Mapping, NoReturn, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .types import Array as Array
from .types import Arrays as Arrays
from .types import Result as Result
from .types import Rle as Rle

__version__: str

class Error(ValueError): ...

class Model:
    def __init__(self, made_by_train_and_load: NoReturn) -> None: ...
    @property
    def categories(self) -> List[Dict[str, Any]]: ...
    @categories.setter
    def categories(self, dicts: Iterable[Mapping[str, Any]]) -> None: ...
    def detect(
        self,
        image: Array,
        depth: Optional[Array] = None,
        camera: Optional[Mapping[str, float]] = None,  # fx, fy, cx, cy
        *,
        image_id: int = 1,
        space: str = "auto",
        min_score: Optional[float] = None,
        turns: int = 1,  # angles by which the image is looked at
        depth_scale: Optional[float] = None,
        order: str = "rgb",
        threads: int = 0,
    ) -> List[Result]: ...
    def draw(
        self,
        image: Array,
        depth: Optional[Array] = None,
        camera: Optional[Mapping[str, float]] = None,
        *,
        space: str = "auto",
        min_score: Optional[float] = None,
        turns: int = 1,
        depth_scale: Optional[float] = None,
        order: str = "rgb",
        threads: int = 0,
    ) -> NDArray[np.uint8]: ...
    def explain(
        self,
        image: Array,
        depth: Optional[Array] = None,
        camera: Optional[Mapping[str, float]] = None,
        *,
        which: int = 0,  # of what detect() tells
        space: str = "auto",
        min_score: Optional[float] = None,
        turns: int = 1,
        depth_scale: Optional[float] = None,
        order: str = "rgb",
        threads: int = 0,
    ) -> NDArray[np.uint8]: ...
    def save(self, path: Union[str, "os.PathLike[str]"]) -> None: ...
    def info(self) -> Dict[str, Any]: ...

def load(path: Union[str, "os.PathLike[str]"]) -> Model: ...
def train(
    coco: Mapping[str, Any],
    images: Arrays,
    depths: Optional[Arrays] = None,
    *,
    detector: str = "hessian-laplace",
    descriptor: str = "root-sift",
    orientation: str = "auto",
    templates: bool = True,
    max_words: int = 0,
    max_features: int = 40000,
    depth_scale: Optional[float] = None,
    order: str = "rgb",
    seed: int = 1,
    threads: int = 0,
    progress: Optional[Callable[[str, int, int], object]] = None,  # stage, done, total
) -> Model: ...
def encode_mask(mask: ArrayLike) -> Rle: ...
def decode_mask(rle: Mapping[str, Any]) -> NDArray[np.uint8]: ...
