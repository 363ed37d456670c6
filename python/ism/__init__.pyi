# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
import os
from typing import Any, Dict, Iterable, List, Mapping, Optional, Sequence, TypedDict, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

Array = NDArray[Any]
"""uint8, uint16 or float (0 ... 1) of shape (height, width) or (height, width, 3 or 4)."""
Arrays = Union[Mapping[int, Array], Sequence[Array], Array]
"""By image id, or in the order of coco["images"]: a list or one stack of arrays."""

class Rle(TypedDict):
    size: List[int]  # height, width
    counts: str  # as pycocotools packs them

_Named = TypedDict("_Named", {"class": str})

class _ResultBase(_Named):
    image_id: int
    category_id: int
    bbox: List[float]  # x, y, width, height
    score: float
    scale: float
    segmentation: Rle

class Result(_ResultBase, total=False):
    probability: float
    depth_m: float
    position_m: List[float]  # x right, y down, z forward of the camera
    position_error_m: float  # standard error
    angle_rad: float  # of what is turned, from x towards y

class Error(ValueError): ...

class Model:
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
) -> Model: ...
def encode_mask(mask: ArrayLike) -> Rle: ...
def decode_mask(rle: Mapping[str, Any]) -> NDArray[np.uint8]: ...
