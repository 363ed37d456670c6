# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
"""Types of what ism takes and gives, for annotations."""

from typing import Any, List, Mapping, Sequence, TypedDict, Union

from numpy.typing import NDArray

__all__ = ["Array", "Arrays", "Result", "Rle"]

Array = NDArray[Any]
"""uint8, uint16 or float (0 ... 1) of shape (height, width) or (height, width, 3 or 4)."""
Arrays = Union[Mapping[int, Array], Sequence[Array], Array]
"""By image id, or in the order of coco["images"]: a list or one stack of arrays."""


class Rle(TypedDict):
    """A mask as COCO's packed run lengths."""

    size: List[int]  # height, width
    counts: str  # as pycocotools packs them


_Named = TypedDict("_Named", {"class": str})


class _ResultBase(_Named):
    image_id: int
    category_id: int
    bbox: List[float]  # x, y, width, height in pixels, within the picture
    score: float
    scale: float  # size of the object, 1 = the model's reference size
    segmentation: Rle


class Result(_ResultBase, total=False):
    """What Model.detect() tells of an object: a result of COCO, and what else is known."""

    probability: float  # that it is an object of this class; min_score is compared with it
    depth_m: float  # along the optical axis
    position_m: List[float]  # x right, y down, z forward of the camera
    position_error_m: float  # how far votes scatter
    angle_rad: float  # of what is turned, from x towards y
