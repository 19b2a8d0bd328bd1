"""A process of its own for LuxCore, whose memory allocator suits no other library.

Arguments: a folder with `scene.npz` (arrays `NAME_vertices`, `NAME_triangles`, tiles also `_uvs`)
and `scene.cfg`. For each line `SAMPLES SEED` on stdin it bakes the tiles into `FOLDER/tiles.pfm`
and answers with the seconds that took. LuxCore's own messages go to stderr.
"""

import os
import sys
import time
from pathlib import Path

ANSWERS = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)

import numpy as np  # noqa: E402
import pyluxcore  # noqa: E402

BAKE = """
renderengine.type = BAKECPU
renderengine.seed = {seed}
sampler.type = SOBOL
film.width = {count}
film.height = 1
film.filter.type = NONE
film.imagepipelines.0.0.type = NOP
batch.haltspp = {samples}
batch.haltthreshold = -1
bake.skipexistingmapfiles = 0
bake.maps.0.type = COMBINED
bake.maps.0.filename = {path}
bake.maps.0.imagepipelineindex = 0
bake.maps.0.width = {count}
bake.maps.0.height = 1
bake.maps.0.autosize.enable = 0
bake.maps.0.uvindex = 0
bake.maps.0.objectnames = tiles
path.pathdepth.total = 100
path.pathdepth.diffuse = 100
path.pathdepth.glossy = 100
path.pathdepth.specular = 100
path.clamping.variance.maxvalue = 0
"""


def main() -> None:
    """Answers until stdin ends."""
    folder = Path(sys.argv[1])
    pyluxcore.Init()
    scene = pyluxcore.Scene()
    arrays = np.load(folder / "scene.npz")
    names = [name.removesuffix("_vertices") for name in arrays if name.endswith("_vertices")]
    for name in names:
        uvs = arrays[f"{name}_uvs"] if f"{name}_uvs" in arrays else None
        vertices, triangles = arrays[f"{name}_vertices"], arrays[f"{name}_triangles"]
        coordinates = None if uvs is None else _rows(uvs)
        scene.DefineMesh(name, _rows(vertices), _rows(triangles), None, coordinates, None, None)
    scene.Parse(_properties((folder / "scene.cfg").read_text()))
    count = len(arrays["tiles_triangles"]) // 2
    print("ready", file=ANSWERS, flush=True)
    for line in sys.stdin:
        samples, seed = line.split()
        path = folder / "tiles.pfm"
        text = BAKE.format(count=count, samples=samples, seed=seed, path=path)
        print(_bake(scene, text), file=ANSWERS, flush=True)


def _bake(scene: "pyluxcore.Scene", text: str) -> float:
    session = pyluxcore.RenderSession(pyluxcore.RenderConfig(_properties(text), scene))
    begin = time.perf_counter()
    session.Start()
    while not session.HasDone():
        time.sleep(0.005)
        session.UpdateStats()
    seconds = time.perf_counter() - begin
    session.Stop()
    return seconds


def _properties(text: str) -> "pyluxcore.Properties":
    properties = pyluxcore.Properties()
    properties.SetFromString(text)
    return properties


def _rows(array: np.ndarray) -> list[tuple]:
    return [tuple(row) for row in array.tolist()]


main()
