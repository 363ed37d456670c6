# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
import ast
import copy
import inspect
import json
import multiprocessing
import os
import pathlib
import pickle
import signal
import struct
import subprocess
import threading
import time
import types
import typing
import warnings
import zlib

import numpy as np
import pytest

import ism

SIDE = 128
PLACES = {7: (20, 24), 11: (40, 30), 12: (30, 44)}  # by image id, none of which is its place in the list


def pattern(seed, size=64):
    """Squares of random brightness: a thing that looks like nothing else."""
    cells = np.random.default_rng(seed).integers(30, 250, (8, 8, 3), dtype=np.uint8)
    return np.kron(cells, np.ones((size // 8, size // 8, 1), dtype=np.uint8))


def picture(x, y, seed=1):
    image = np.full((SIDE, SIDE, 3), 90, dtype=np.uint8)
    image[y : y + 64, x : x + 64] = pattern(seed)
    return image


def mask_at(x, y):
    mask = np.zeros((SIDE, SIDE), dtype=np.uint8)
    mask[y : y + 64, x : x + 64] = 1
    return mask


def make_coco(packed=lambda mask: ism.encode_mask(mask)):
    return {
        "categories": [{"id": 30, "name": "carpet"}],
        "images": [{"id": i, "file_name": f"{i}.png", "width": SIDE, "height": SIDE} for i in PLACES],
        "annotations": [
            {"id": i, "image_id": i, "category_id": 30, "bbox": [x, y, 64, 64], "segmentation": packed(mask_at(x, y))}
            for i, (x, y) in PLACES.items()
        ],
    }


@pytest.fixture(scope="session")
def images():
    return {i: picture(x, y) for i, (x, y) in PLACES.items()}


@pytest.fixture(scope="session")
def model(images):
    return ism.train(make_coco(), images, templates=False, threads=2)


def iou(a, b):
    width = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    height = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    common = max(width, 0) * max(height, 0)
    return common / (a[2] * a[3] + b[2] * b[3] - common)


def test_learns_and_finds(model):
    found = model.detect(picture(50, 10), image_id=99)
    assert found and found == sorted(found, key=lambda result: -result["score"])
    best = found[0]
    assert best["image_id"] == 99 and best["category_id"] == 30 and best["class"] == "carpet"
    assert "depth_m" not in best  # nothing is known of it
    assert iou(best["bbox"], [50, 10, 64, 64]) > 0.7
    mask = ism.decode_mask(best["segmentation"])
    assert mask.shape == (SIDE, SIDE) and mask.dtype == np.uint8
    assert (mask & mask_at(50, 10)).sum() > 0.6 * 64 * 64
    json.dumps(found)  # plain values
    assert model.categories == [{"id": 30, "name": "carpet"}]


def test_arrays_as_they_lie(model):
    image = picture(50, 10)
    usual = model.detect(image)
    assert model.detect(image[:, :, ::-1], order="bgr") == usual  # a view, not in rows
    assert model.detect(np.ascontiguousarray(image[:, :, ::-1]), order="bgr") == usual
    wide = np.zeros((SIDE, SIDE + 9, 3), dtype=np.uint8)
    wide[:, :SIDE] = image
    assert model.detect(wide[:, :SIDE]) == usual  # rows farther apart
    assert model.detect(np.ascontiguousarray(image[::-1])[::-1]) == usual  # from the last row to the first
    alpha = np.dstack([image, np.zeros((SIDE, SIDE), dtype=np.uint8)])
    assert model.detect(alpha) == usual
    gray = (image @ np.array([0.299, 0.587, 0.114])) / 255
    assert len(model.detect(gray)) == len(usual)
    assert len(model.detect(gray.astype(">f4"))) == len(usual)
    assert len(model.detect((gray * 65535).astype(np.uint16))) == len(usual)


def test_same_for_any_threads_and_kinds_of_input(model, images):
    image = picture(50, 10)
    usual = model.detect(image, threads=1)
    assert model.detect(image, threads=2) == usual
    in_order = np.stack([images[i] for i in PLACES])
    packed = make_coco(lambda mask: {**ism.encode_mask(mask), "counts": ism.encode_mask(mask)["counts"].encode()})
    packed["annotations"][0]["bbox"] = np.array([20.0, 24, 64, 64])  # numbers of numpy, too
    packed["images"][1]["width"] = np.int64(SIDE)
    packed = types.MappingProxyType(packed)
    again = ism.train(packed, in_order, templates=False, threads=1)
    assert again.detect(image) == usual


def test_models_are_files_of_the_program(model, tmp_path):
    path = tmp_path / "model.safetensors"
    model.save(path)
    loaded = ism.load(path)
    info = loaded.info()
    assert info == model.info() and info["classes"] == ["carpet"] and info["words"] > 0 and info["images"] == 3
    assert loaded.categories == model.categories
    loaded.categories = [{"id": 5, "name": "other"}, {"id": 31, "name": "carpet"}]
    assert loaded.detect(picture(50, 10))[0]["category_id"] == 31
    loaded.save(path)
    loaded = ism.load(path)
    assert loaded.categories == [{"id": 31, "name": "carpet"}]
    loaded.categories = model.categories
    assert loaded.detect(picture(50, 10)) == model.detect(picture(50, 10))
    with pytest.raises(ValueError, match="none.safetensors"):
        ism.load(tmp_path / "none.safetensors")
    with pytest.raises(ValueError, match="one named 'carpet', got none"):
        loaded.categories = [{"id": 5, "name": "other"}]


def write_bmp(path, image):
    height, width, _ = image.shape  # rows of a multiple of four bytes, the last one first, b g r
    header = struct.pack("<2sIIIIiiHHIIiiII", b"BM", 54 + image.size, 0, 54, 40, width, height, 1, 24, 0, 0, 0, 0, 0, 0)
    path.write_bytes(header + image[::-1, :, ::-1].tobytes())


def run_program(folder, *arguments):
    command = [os.environ["ISM_PROGRAM"], *arguments]
    return subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True).stdout


def write_data(folder, coco, images):
    for image in coco["images"]:
        image["file_name"] = f"{image['id']}.bmp"
        write_bmp(folder / image["file_name"], images[image["id"]])
    (folder / "coco.json").write_text(json.dumps(coco))


needs_program = pytest.mark.skipif(not os.environ.get("ISM_PROGRAM"), reason="the program ism is not built")


@needs_program
@pytest.mark.parametrize("templates", [False, True])
def test_finds_what_the_program_finds(images, tmp_path, templates):
    coco = make_coco()
    write_data(tmp_path, coco, images)
    learnt = ism.train(coco, images, templates=templates)
    learnt.save(tmp_path / "model.safetensors")
    run_program(tmp_path, "detect", "--model", "model.safetensors", "--data", "coco.json", "-o", "found.json")
    by_program = json.loads((tmp_path / "found.json").read_text())
    found = [result for i in PLACES for result in learnt.detect(images[i], image_id=i)]
    keys = ["image_id", "category_id", "class", "bbox", "score", "segmentation"]
    assert found and [[r[k] for k in keys] for r in found] == [[r[k] for k in keys] for r in by_program]
    # … and learns.
    options = [] if templates else ["--no-templates"]
    run_program(tmp_path, "train", "--data", "coco.json", "-o", "again.safetensors", *options)
    assert (tmp_path / "again.safetensors").read_bytes() == (tmp_path / "model.safetensors").read_bytes()
    assert f"words           {learnt.info()['words']}\n" in run_program(tmp_path, "info", "model.safetensors")


@needs_program
@pytest.mark.parametrize("orientation", ["auto", "upright", "free"])
@pytest.mark.parametrize("turned", [False, True])
def test_learns_as_the_program_learns(images, tmp_path, orientation, turned):
    coco = make_coco()
    if turned:  # each picture with its labels by another angle
        images = {i: np.ascontiguousarray(np.rot90(image, k)) for k, (i, image) in enumerate(images.items())}
        for k, label in enumerate(coco["annotations"]):
            mask = np.rot90(mask_at(*PLACES[label["image_id"]]), k)
            rows, columns = np.nonzero(mask)
            label["bbox"] = [int(columns.min()), int(rows.min()), 64, 64]
            label["segmentation"] = ism.encode_mask(mask)
    coco["categories"].append({"id": 31, "name": "nowhere"})
    write_data(tmp_path, coco, images)
    with pytest.warns(UserWarning, match="left out, since no annotation is of this category: nowhere"):
        learnt = ism.train(coco, images, orientation=orientation)
    learnt.save(tmp_path / "model.safetensors")
    told = run_program(
        tmp_path, "train", "--data", "coco.json", "-o", "again.safetensors", "--orientation", orientation
    )
    assert (tmp_path / "again.safetensors").read_bytes() == (tmp_path / "model.safetensors").read_bytes()
    info = learnt.info()
    assert info["orientation"] == {"auto": "free" if turned else "upright"}.get(orientation, orientation)
    assert f"orientation  {info['orientation']}" in told
    assert learnt.categories == [{"id": 30, "name": "carpet"}] and info["classes"] == ["carpet"]


def test_categories_that_nothing_shows_are_left_out(images):
    coco = make_coco()
    coco["categories"].insert(0, {"id": 29, "name": "nowhere"})
    coco["images"].insert(0, {"id": 3, "file_name": "3.png", "width": SIDE, "height": SIDE})
    coco["annotations"].append({"id": 99, "image_id": 3, "category_id": 29, "bbox": [1, 2, 60, 60], "iscrowd": 1})
    in_order = [np.full((SIDE, SIDE), 90, dtype=np.uint8)] + [images[i] for i in PLACES]
    with pytest.warns(UserWarning, match="left out, since no annotation is of this category: nowhere"):
        learnt = ism.train(coco, in_order, templates=False)  # and the image that shows nothing else
    assert learnt.categories == [{"id": 30, "name": "carpet"}] and learnt.info()["images"] == 3
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(UserWarning, match="nowhere"):
            ism.train(coco, in_order, templates=False)


def test_templates_and_depth():
    camera = {"fx": 200.0, "fy": 200.0, "cx": 63.5, "cy": 63.5}
    coco = make_coco()
    for image in coco["images"]:
        image["camera"] = camera
    depths = {i: np.full((SIDE, SIDE), 1200, dtype=np.uint16) for i in PLACES}
    for i, (x, y) in PLACES.items():
        depths[i][y : y + 64, x : x + 64] = 1000  # mm
    pictures = {i: picture(x, y) for i, (x, y) in PLACES.items()}
    learnt = ism.train(coco, pictures, depths, threads=2)
    info = learnt.info()
    assert info["depth"] and info["templates"] == 1
    depth = np.full((SIDE, SIDE), 1.2)
    depth[10:74, 50:114] = 1.0  # m
    found = learnt.detect(picture(50, 10), depth, camera, min_score=0)
    assert found and abs(found[0]["position_m"][2] - 1.0) < 0.05
    units = (depth * 1000).astype(np.uint16)
    assert learnt.detect(picture(50, 10), units, camera, min_score=0)[0]["bbox"] == found[0]["bbox"]
    with pytest.raises(ValueError, match="turns: expected 1 in the space metric, which finds what is turned, got 4"):
        learnt.detect(picture(50, 10), depth, camera, space="metric", turns=4)
    turned = learnt.detect(np.rot90(picture(50, 10)).copy(), turns=4)
    assert turned and abs(turned[0]["angle_rad"] + np.pi / 2) < 0.1
    with pytest.raises(ValueError, match="space metric: expected an image with depth and camera, got one without"):
        learnt.detect(picture(50, 10), space="metric")
    with pytest.raises(ValueError, match="depth image size: expected 128x128, got 10x10"):
        learnt.detect(picture(50, 10), np.ones((10, 10)), camera)
    again = pickle.loads(pickle.dumps(learnt))
    assert again.info() == info and again.detect(picture(50, 10), depth, camera, min_score=0) == found
    assert (again.draw(picture(50, 10), depth, camera) == learnt.draw(picture(50, 10), units, camera)).all()
    assert (learnt.explain(picture(50, 10), depth, camera).shape[2], learnt.draw(picture(50, 10)).ndim) == (3, 3)
    for kind in ("int16", "int32", ">u2", "uint32", "int64"):
        again = learnt.detect(picture(50, 10), units.astype(kind), camera, min_score=0)
        assert again == learnt.detect(picture(50, 10), units, camera, min_score=0), kind
    assert again == learnt.detect(picture(50, 10), units.astype(float), camera, min_score=0, depth_scale=0.001)
    assert again == learnt.detect(picture(50, 10), (10 * units), camera, min_score=0, depth_scale=0.0001)
    expected = "depth: expected a numpy array of whole numbers of 16 to 64 bits .*, float32 or float64 .*, got "
    for bad in (np.ones((SIDE, SIDE), np.uint8), np.ones((SIDE, SIDE, 3)), np.ones((SIDE, SIDE), bool), [[1.0]]):
        with pytest.raises(ism.Error, match=expected):
            learnt.detect(picture(50, 10), bad, camera)
    for scale in (0, -1, np.nan):
        with pytest.raises(ism.Error, match="depth_scale: expected metres a unit, above 0, got "):
            learnt.detect(picture(50, 10), units, camera, depth_scale=scale)


def test_what_is_learnt_without_depth_is_told(images):
    coco, depths = make_coco(), {7: np.ones((SIDE, SIDE)), 11: None}
    with pytest.warns(UserWarning, match="depth left out: 1 image has depth, and no camera"):
        learnt = ism.train(coco, images, depths, templates=False)
    assert not learnt.info()["depth"]
    with pytest.warns(UserWarning, match="depth left out: 3 images have depth, none has a camera"):
        ism.train(coco, images, 3 * [np.ones((SIDE, SIDE))], templates=False)
    # One of two classes is never seen with depth.
    coco["categories"].append({"id": 31, "name": "rug"})
    coco["annotations"][2]["category_id"] = 31
    for image in coco["images"][:2]:
        image["camera"] = {"fx": 200.0, "fy": 200.0, "cx": 63.5, "cy": 63.5}
    with pytest.warns(UserWarning, match="depth left out, the space metric is not there: .*rug"):
        learnt = ism.train(coco, images, [np.ones((SIDE, SIDE)), np.ones((SIDE, SIDE)), None], templates=False)
    assert not learnt.info()["depth"] and learnt.info()["classes"] == ["carpet", "rug"]


def test_depths_of_no_image_are_refused(images):
    depth = np.ones((SIDE, SIDE))
    for key, got in [("7", "'7'"), (8, "8"), ((7,), r"\(7,\)")]:
        with pytest.raises(ism.Error, match=f"depths: expected ids of coco\\['images'\\] as keys, got {got}"):
            ism.train(make_coco(), images, {7: depth, key: depth})
    four = [picture(0, 0)] * 4
    with pytest.raises(ism.Error, match="images: expected 3 arrays, one for each of coco.*, got 4"):
        ism.train(make_coco(), four)
    with pytest.raises(ism.Error, match="depths: expected 3 arrays, one for each of coco.*, got 4"):
        ism.train(make_coco(), images, [depth] * 4)
    with pytest.raises(ism.Error, match="image with id 11, depth: size: expected 128x128, got 9x9"):
        ism.train(make_coco(), images, {11: np.ones((9, 9))})


def test_too_few_objects_are_told(images):
    coco = make_coco()
    coco["images"], coco["annotations"] = coco["images"][:1], coco["annotations"][:1]
    with pytest.warns(UserWarning, match="too few objects to learn how sure to be of what is found"):
        ism.train(coco, images, templates=False)


def test_categories_are_set_by_any_dicts(model):
    own = model.categories
    for dicts in [
        ({"id": np.int64(5), "name": "carpet"},),
        iter([{"id": 5, "name": "carpet"}]),
        [types.MappingProxyType({"id": 5, "name": "carpet"})],
    ]:
        model.categories = dicts
        assert model.categories == [{"id": 5, "name": "carpet"}]
    model.categories = own
    carpet = {"id": 5, "name": "carpet"}
    for bad, message in [
        ([carpet, {"id": 5, "name": "rug"}], "categories: expected each id once, got 5 twice"),
        ([carpet, {"id": 6, "name": "carpet"}], "categories: expected each name once, got 'carpet' twice"),
        (carpet, "categories: expected dicts with id and name, got dict"),
        (5, "categories: expected dicts with id and name, got int"),
        (["carpet"], r"categories\[0\]: expected a dict, got str"),
        ([{"name": "carpet"}], r"categories\[0\]: id: expected a whole number, got nothing"),
    ]:
        with pytest.raises(ism.Error, match=message):
            model.categories = bad
    assert model.categories == own


def test_masks_as_pycocotools_packs_them():
    mask = np.zeros((3, 4), dtype=bool)
    mask[1:, 1] = True
    packed = ism.encode_mask(mask)
    assert packed == {"size": [3, 4], "counts": "426"}  # 4 of ground, 2 of figure, 6 of ground
    assert (ism.decode_mask(packed) == mask).all()
    assert (ism.decode_mask({"size": [3, 4], "counts": b"426"}) == mask).all()
    assert (ism.decode_mask({"size": [3, 4], "counts": [4, 2, 6]}) == mask).all()
    with pytest.raises(ValueError, match="sum of 12, got 6"):
        ism.decode_mask({"size": [3, 4], "counts": [4, 2]})


def test_masks_of_all_whole_numbers():
    figure = np.zeros((3, 4), dtype=bool)
    figure[1:, 1] = True
    packed = ism.encode_mask(figure)
    for kind in ("uint8", "int8", "uint16", "int32", ">i2", "int64", "uint64"):
        assert ism.encode_mask(figure.astype(kind)) == packed
    assert ism.encode_mask(256 * figure.astype(np.int64)) == packed
    assert ism.encode_mask(-65536 * figure.astype(np.int64)) == packed
    assert ism.encode_mask(np.asfortranarray(figure)) == packed
    assert ism.encode_mask(figure.tolist()) == packed
    expected = "mask: expected a mask of bool or whole numbers of shape .*, got "
    for bad in (figure * 0.5, np.full((3, 4), np.nan), figure[0], np.full((3, 4), "a"), [[1], [1, 2]], None):
        with pytest.raises(ism.Error, match=expected):
            ism.encode_mask(bad)
    with pytest.raises(ism.Error, match="mask: mask size: expected"):
        ism.encode_mask(np.zeros((0, 4), dtype=bool))


def test_masks_of_numpy_are_segmentations(model, images):
    usual = model.detect(picture(50, 10))
    for kind in (bool, np.uint8, np.int64):
        learnt = ism.train(make_coco(lambda mask: mask.astype(kind)), images, templates=False)
        assert learnt.detect(picture(50, 10)) == usual
    with pytest.raises(ism.Error, match=r"coco, annotations\[0\].segmentation: expected a mask of bool or whole"):
        ism.train(make_coco(lambda mask: mask * 0.5), images)
    with pytest.raises(ism.Error, match="segmentation size: expected 128x128, got 64x128"):
        ism.train(make_coco(lambda mask: mask[:, 32:96]), images)
    corners = [[20, 24, 84, 24, 84, 88, 20, 88]]
    coco = make_coco()
    coco["annotations"][0]["segmentation"] = np.array(corners)  # polygons are no mask
    ism.train(coco, images, templates=False)


def test_other_threads_run_meanwhile(model):
    image = np.kron(picture(50, 10), np.ones((8, 8, 1), dtype=np.uint8))
    stop, last, gaps = threading.Event(), [time.perf_counter()], []

    def count():
        while not stop.is_set():
            now = time.perf_counter()
            gaps.append(now - last[0])
            last[0] = now
            time.sleep(0.0005)

    other = threading.Thread(target=count)
    other.start()
    begin = time.perf_counter()
    model.detect(image, threads=1)
    took = time.perf_counter() - begin
    stop.set()
    other.join()
    assert len(gaps) > 10 and max(gaps) < 0.7 * took


def test_models_are_copied_and_pickled(model, tmp_path):
    usual = model.detect(picture(50, 10))
    model.save(tmp_path / "model.safetensors")
    assert pickle.dumps(model).count((tmp_path / "model.safetensors").read_bytes()) == 1
    for again in (pickle.loads(pickle.dumps(model)), copy.copy(model), copy.deepcopy(model)):
        assert again is not model and again.info() == model.info()
        assert again.categories == model.categories and again.detect(picture(50, 10)) == usual
    again.categories = [{"id": 8, "name": "carpet"}]
    assert model.categories == [{"id": 30, "name": "carpet"}]
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert pool.apply(model.detect, (picture(50, 10),)) == usual
    with pytest.raises(ism.Error, match="model: expected a safetensors file"):
        ism.Model.__new__(ism.Model).__setstate__(b"nothing")


def read_png(path):
    data, chunks, at = path.read_bytes(), {}, 8
    while at < len(data):
        (size,), kind = struct.unpack(">I", data[at : at + 4]), data[at + 4 : at + 8]
        chunks[kind] = chunks.get(kind, b"") + data[at + 8 : at + 8 + size]
        at += 12 + size
    width, height = struct.unpack(">II", chunks[b"IHDR"][:8])
    packed, above, rows = zlib.decompress(chunks[b"IDAT"]), bytes(3 * width + 3), []
    for y in range(height):
        kind, *deltas = packed[y * (1 + 3 * width) : (y + 1) * (1 + 3 * width)]
        row = bytearray(3)  # a pixel of 0 before the first, here as above
        for i, delta in enumerate(deltas):
            a, b, c = row[i], above[i + 3], above[i]
            near = abs(b - c), abs(a - c), abs(a + b - 2 * c)
            paeth = a if near[0] <= near[1] and near[0] <= near[2] else b if near[1] <= near[2] else c
            row.append((delta + (0, a, b, (a + b) // 2, paeth)[kind]) % 256)
        above = row
        rows.append(row[3:])
    return np.frombuffer(b"".join(rows), dtype=np.uint8).reshape(height, width, 3)


@needs_program
@pytest.mark.parametrize("templates", [False, True])
def test_draws_what_the_program_draws(images, tmp_path, templates):
    learnt = ism.train(make_coco(), images, templates=templates)
    learnt.save(tmp_path / "model.safetensors")
    image = picture(50, 10)
    write_bmp(tmp_path / "photo.bmp", image)
    run_program(tmp_path, "detect", "--model", "model.safetensors", "photo.bmp", "--overlay", "why")
    drawn = learnt.draw(image)
    assert drawn.dtype == np.uint8 and (drawn == read_png(tmp_path / "why" / "photo.png")).all()
    row = learnt.explain(image)
    assert (row == read_png(tmp_path / "why" / "photo_1.png")).all()
    assert (row == learnt.explain(image[:, :, ::-1], which=0, order="bgr", threads=1)).all()
    assert learnt.draw(np.full((SIDE, SIDE), 90, dtype=np.uint8)).shape == drawn.shape
    count = len(learnt.detect(image))
    for which in (-1, count):
        with pytest.raises(ism.Error, match=f"which: expected one of .*, 0 ... {count - 1}, got {which}"):
            learnt.explain(image, which=which)
    with pytest.raises(ism.Error, match="which: expected an object to be found, got none"):
        learnt.explain(np.full((SIDE, SIDE), 90, dtype=np.uint8))


def test_a_model_tells_what_it_is(model):
    assert repr(model) == f"<ism.Model of carpet: 3 objects, {model.info()['words']} words>"
    assert ism.Model.__module__ == "ism"
    told = [ism.train, ism.load, ism.encode_mask, ism.decode_mask, ism.Model.detect, ism.Model.draw, ism.Model.explain]
    for function in told:
        signature, _, text = function.__doc__.partition("\n")
        arguments = [part.split(":")[0].strip() for part in split_arguments(signature)]
        for name in arguments:
            same = function.__name__ in ("draw", "explain") and name != "which"  # as those of detect
            assert same or name in ("self", "*", "path") or f"\n{name}  " in text or f"\n{name} " in text, name
    assert "least `probability`" in ism.Model.detect.__doc__


@pytest.mark.parametrize("threads", [1, 2])
def test_a_signal_stops_training(images, threads):
    steps = []
    ism.train(make_coco(), images, threads=threads, progress=lambda *how: steps.append(how))
    whole = len(steps)
    steps.clear()

    def interrupt(*how):
        steps.append(how)
        if len(steps) == 2:
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        ism.train(make_coco(), images, threads=threads, progress=interrupt)
        time.sleep(1)  # where the signal is not heard before
    assert len(steps) < whole


@pytest.mark.parametrize("threads", [1, 2])
def test_progress_is_told(images, model, threads):
    told = []
    learnt = ism.train(make_coco(), images, templates=False, threads=threads, progress=lambda *how: told.append(how))
    assert learnt.detect(picture(50, 10)) == model.detect(picture(50, 10))
    stages = [stage for stage, _, _ in told]
    assert [done for stage, done, total in told if stage == "extracting features"] == [1, 2, 3]
    assert "clustering" in stages and all(0 <= done <= total for _, done, total in told)

    def stop(stage, done, total):
        raise RuntimeError(f"{stage}: stopped")

    for _ in range(5):
        with pytest.raises(RuntimeError, match="extracting features: stopped"):
            ism.train(make_coco(), images, threads=threads, progress=stop)
    with pytest.raises(ism.Error, match="progress: expected a function of stage, done and total, got int"):
        ism.train(make_coco(), images, progress=3)


def test_bad_input_is_a_value_error(model, images):
    assert issubclass(ism.Error, ValueError)
    expected = "image: expected a numpy array of uint8, uint16, float32 or float64 of shape"
    for bad, got in [
        (np.zeros((4, 5), dtype=np.int32), "int32 of shape \\(4, 5\\)"),
        (np.zeros((4, 5, 2), dtype=np.uint8), "uint8 of shape \\(4, 5, 2\\)"),
        (np.zeros((0, 5), dtype=np.uint8), "uint8 of shape \\(0, 5\\)"),
        (np.zeros(7), "float64 of shape \\(7,\\)"),
        ([[1, 2], [3, 4]], "list"),
    ]:
        with pytest.raises(ValueError, match=f"{expected}.*, got {got}$"):
            model.detect(bad)
    with pytest.raises(ValueError, match="image size: expected at least 16x16, got 5x4"):
        model.detect(np.zeros((4, 5), dtype=np.uint8))
    with pytest.raises(ValueError, match="order: expected 'rgb' or 'bgr', got 'gbr'"):
        model.detect(picture(0, 0), order="gbr")
    with pytest.raises(ValueError, match="min_score: expected 0 ... 1, got 2"):
        model.detect(picture(0, 0), min_score=2)
    with pytest.raises(ValueError, match="vote space: expected one of"):
        model.detect(picture(0, 0), space="nowhere")
    with pytest.raises(ValueError, match="fx"):
        model.detect(picture(0, 0), camera={"fy": 1})

    with pytest.raises(ValueError, match="images: expected an array for image id 12, got none"):
        ism.train(make_coco(), {i: images[i] for i in (7, 11)})
    with pytest.raises(ValueError, match="images: expected 3 arrays, one for each of coco\\['images'\\], got 2"):
        ism.train(make_coco(), [images[7], images[11]])
    with pytest.raises(ValueError, match="images: expected a dict by image id, or a list in the order of .*, got int"):
        ism.train(make_coco(), 3)
    with pytest.raises(ValueError, match="image with id 7: size: expected 128x128, got 64x128"):
        ism.train(make_coco(), {**images, 7: images[7][:, :64]})
    broken = make_coco()
    broken["annotations"][0]["category_id"] = 4
    with pytest.raises(ValueError, match="category_id: expected the id of one of its categories, got 4"):
        ism.train(broken, images)
    with pytest.raises(ValueError, match="coco: expected a dict, got list"):
        ism.train([], images)
    with pytest.raises(ValueError, match="coco, more: expected what JSON can hold, got set"):
        ism.train({**make_coco(), "more": set()}, images)
    for change, message in [
        (lambda c: c["annotations"][1].update(bbox=[1, np.nan, 2, 3]), r"annotations\[1\].bbox\[1\]: .* got nan"),
        (lambda c: c["images"][0].update(camera={"fx": np.float32("inf")}), r"images\[0\].camera.fx: .* got inf"),
        (lambda c: c["categories"][0].update(name=b"\xff"), r"categories\[0\].name: expected bytes of ASCII"),
        (lambda c: c["categories"][0].update(name="\ud800"), r"categories\[0\].name: expected text in Unicode"),
        (lambda c: c["images"][2].update({5: 1}), r"images\[2\]: expected keys that are strings, got 5"),
        (lambda c: c["images"][2].update(id=1 << 70), r"images\[2\].id: expected a whole number of 64 bits"),
        (lambda c: c.update(more=c), "expected at most 64 levels, got more"),
    ]:
        broken = make_coco()
        change(broken)
        with pytest.raises(ism.Error, match=f"^coco, .*{message}"):
            ism.train(broken, images)
    with pytest.raises(ism.Error, match="^camera, fx: expected a number, got nan"):
        model.detect(picture(0, 0), camera={"fx": np.nan})
    with pytest.raises(ism.Error, match="mask, counts: expected bytes of ASCII"):
        ism.decode_mask({"size": [3, 4], "counts": b"\xe9"})
    with pytest.raises(ism.Error, match="orientation: expected 'auto', 'upright' or 'free', got 'down'"):
        ism.train(make_coco(), images, orientation="down")
    with pytest.raises(ValueError, match="detector .* got none and root-sift"):
        ism.train(make_coco(), images, detector="none")


def test_code_of_the_documentation_runs(images, tmp_path, monkeypatch):
    text = (pathlib.Path(__file__).parents[2] / "docs" / "bridges.md").read_text()
    blocks = text.split("```python\n")[1:]
    assert blocks
    monkeypatch.chdir(tmp_path)
    for block in blocks:
        exec(block.split("```")[0], {"coco": make_coco(), "images": images, "image": picture(50, 10)})


def test_stubs_are_what_the_module_has():
    stub = ast.parse((pathlib.Path(ism.__file__).parent / "__init__.pyi").read_text())
    assert (pathlib.Path(ism.__file__).parent / "py.typed").exists()
    functions = {node.name: node for node in stub.body if isinstance(node, ast.FunctionDef)}
    classes = {node.name: node for node in stub.body if isinstance(node, ast.ClassDef)}
    assert set(functions) == {name for name in ism.__all__ if inspect.isbuiltin(getattr(ism, name))}
    members = [node for node in classes["Model"].body if isinstance(node, ast.FunctionDef)]
    methods = {node.name: node for node in members if not node.decorator_list and not node.name.startswith("_")}
    own = {name for name in vars(ism.Model) if not name.startswith("_")}
    assert own == set(methods) | {"categories"}
    for name, node in {**functions, **methods}.items():
        real = getattr(ism.Model if name in methods else ism, name).__doc__.splitlines()[0]
        names = [a.arg for a in node.args.args + node.args.kwonlyargs]
        told = [part.split(":")[0].strip() for part in split_arguments(real)]
        assert names == [part for part in told if part != "*"], name


def test_types_are_there_at_run_time(model):
    found = model.detect(picture(50, 10))[0]
    hints = typing.get_type_hints(ism.Result)
    assert set(found) <= set(hints) and ism.Result.__required_keys__ <= set(found)
    assert hints["segmentation"] is ism.Rle and set(typing.get_type_hints(ism.Rle)) == set(found["segmentation"])
    assert set(ism.__all__) == {name for name in vars(ism) if not name.startswith("_") and name != "types"} | {
        "__version__"
    }
    typing.List[ism.Array], typing.Optional[ism.Arrays]
    with pytest.raises(TypeError):
        ism.Model()


def split_arguments(signature):
    """The arguments of pybind11's "name(a: int, b: Tuple[int, int] = ...) -> ..."."""
    inside, depth, parts = signature[signature.index("(") + 1 : signature.rindex(") ->")], 0, [""]
    for character in inside:
        depth += (character in "([{") - (character in ")]}")
        if character == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += character
    return [part for part in parts if part.strip()]
