"""The documentation is true: its code runs and prints what it shows, its links lead somewhere.

Each page is run by itself, all its blocks of Python in one namespace and one empty folder, in which
only ``examples/`` is. A ``text`` block after the comment ``<!-- prints -->`` shows what the block
of code before it prints. Each picture of a page is one that its code saves. Notebooks are executed,
and their stored outputs compared.

``python tests/test_documentation.py`` writes outputs and pictures anew.
"""

from __future__ import annotations

import base64
import contextlib
import doctest
import importlib
import io
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import matplotlib
import matplotlib.image
import nbclient
import nbformat
import numpy as np
import pytest
import yaml
from markdown.extensions.toc import slugify

import quasilux

matplotlib.use("Agg")

PACKAGE = Path(__file__).resolve().parents[1]
ROOT = Path(os.environ.get("QUASILUX_ROOT") or PACKAGE.parents[1]).resolve()
DOCS = PACKAGE / "docs"
NOTEBOOKS = sorted((DOCS / "notebooks").glob("*.ipynb"))
PAGES = [*sorted(DOCS.rglob("*.md")), PACKAGE / "README.md", ROOT / "README.md"]

PRINTS = "<!-- prints -->"
LANGUAGES = {"", "python", "sh", "text", "toml"}
# What a page may tell the reader to type.
COMMANDS = ("pip install ", "quasilux ", "ray ", "python ")

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
PICTURE = re.compile(r"!\[[^\]]*\]\(([^)\s]+)\)")
# A path in the repository, as running text names it.
REPOSITORY_PATH = re.compile(r"`((?:crates|docs|examples|validation)/[\w./-]+)`")

# What another version of matplotlib may make of a picture: mean difference, of 1, and size.
PICTURE_TOLERANCE = 0.01
SIZE_TOLERANCE = 0.05


@dataclass(frozen=True)
class Block:
    """A fenced block of a page.

    Attributes
    ----------
    line : int
        The line of the page, from 1, with the first line of the block.
    end : int
        The line of its last fence.
    language : str
        What stands behind the first fence.
    code : str
        What is in it.
    prints : bool
        Whether it is said to be what the block of code before it prints.
    """

    line: int
    end: int
    language: str
    code: str
    prints: bool


def text_of(page: Path) -> str:
    """Return a page; of the repository's first page the part that is about Python."""
    text = page.read_text(encoding="utf-8")
    if page != ROOT / "README.md":
        return text
    before, heading, rest = text.partition("\n## Python\n")
    # Empty lines stand for what is left out, so that numbers of lines hold.
    return "\n" * (before + heading).count("\n") + rest.partition("\n## ")[0] + "\n"


def blocks(text: str) -> list[Block]:
    """Return the fenced blocks of a page."""
    found: list[Block] = []
    lines = text.split("\n")
    last = ""
    number = 0
    while number < len(lines):
        line = lines[number]
        fence = re.match(r"(```+|~~~+)(.*)", line)
        if fence is None:
            last = line.strip() or last
            number += 1
            continue
        end = lines.index(fence[1], number + 1)
        code = "\n".join(lines[number + 1 : end])
        found.append(Block(number + 2, end + 1, fence[2].strip(), code, last == PRINTS))
        last, number = "", end + 1
    return found


def prose(text: str) -> str:
    """Return a page without its blocks."""
    lines = text.split("\n")
    for block in blocks(text):
        lines[block.line - 2 : block.end] = [""] * (block.end - block.line + 2)
    return "\n".join(lines)


def run(page: Path) -> dict[int, str]:
    """Run the code of a page in this folder; return what each block printed, by its last line."""
    namespace: dict[str, Any] = {"__name__": "__main__"}
    printed: dict[int, str] = {}
    for block in blocks(text_of(page)):
        if block.language == "sh":
            call(block)
        if block.language != "python":
            continue
        # Empty lines in front let messages name the line of the page.
        source = "\n" * (block.line - 1) + block.code
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            exec(compile(source, str(page), "exec"), namespace)
        # Blanks at the ends of lines are not seen, and Ray reports on its processes.
        lines = [line.rstrip() for line in out.getvalue().rstrip().split("\n")]
        printed[block.end] = "\n".join(line for line in lines if "(raylet)" not in line)
    return printed


def call(block: Block) -> None:
    """Run those commands of a block that call the program of the package."""
    for line in block.code.split("\n"):
        if line.startswith("quasilux "):
            words = [sys.executable, "-m", "quasilux._command_line", *shlex.split(line)[1:]]
            ended = subprocess.run(words, capture_output=True, text=True, check=False)
            # 3 is a limit before the tolerance.
            assert ended.returncode in (0, 3), f"{line}: {ended.stderr}"


def comparable(printed: str) -> str:
    """Return what was printed without seconds and threads."""
    return re.sub(r"[\d.]+ s on \d+ threads?", "_ s on _ threads", printed)


def shown(page: Path) -> Iterator[tuple[Block, int]]:
    """Yield the blocks that show what is printed, with the last line of the code that prints it."""
    code = 0
    for block in blocks(text_of(page)):
        if block.prints:
            yield block, code
        elif block.language == "python":
            code = block.end


def own_pictures(page: Path) -> list[Path]:
    """Return the pictures of a page of the site."""
    if DOCS not in page.parents:
        return []
    return [page.parent / target for target in PICTURE.findall(prose(text_of(page)))]


def has_code(page: Path) -> bool:
    """Whether a page has anything to run."""
    return any(block.language == "python" for block in blocks(text_of(page)))


def name(path: Path) -> str:
    """Return what reports call a page."""
    return path.relative_to(ROOT).as_posix()


def enter(folder: Path) -> None:
    """Make a folder the one that code runs in, with the examples in it."""
    shutil.copytree(ROOT / "examples", folder / "examples")
    os.chdir(folder)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder that code runs in."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("RAY_AUTH_MODE", "disabled")
    enter(tmp_path)
    return tmp_path


@pytest.mark.parametrize("page", [page for page in PAGES if has_code(page)], ids=name)
def test_code_runs_and_prints_what_is_shown(page: Path, folder: Path) -> None:
    printed = run(page)
    for block, code in shown(page):
        assert comparable(block.code) == comparable(printed[code]), f"{name(page)}:{block.line}"
    for picture in own_pictures(page):
        made = (folder / picture.name).read_bytes()
        assert_same_picture(picture.read_bytes(), made, picture.suffix)


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_blocks_are_of_known_languages_and_commands(page: Path) -> None:
    for block in blocks(text_of(page)):
        place = f"{name(page)}:{block.line}"
        assert block.language in LANGUAGES, place
        if block.language in ("", "text"):
            assert block.prints, f"{place}: nothing says what prints this"
        if block.language == "sh":
            for line in block.code.split("\n"):
                assert line.startswith(COMMANDS), f"{place}: {line}"


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_links_lead_somewhere(page: Path) -> None:
    text = prose(text_of(page))
    for target in LINK.findall(text):
        assert_link(page, target)
    for path in REPOSITORY_PATH.findall(text):
        assert (ROOT / path).exists(), f"{name(page)}: {path} is not in the repository"


def assert_link(page: Path, target: str) -> None:
    """Check that a link leads to a file, a heading, or has the form of an address."""
    place = f"{name(page)}: {target}"
    parts = urlsplit(target)
    if parts.scheme:
        assert parts.scheme == "https" and "." in parts.netloc, place
        return
    # The first page of a package is shown where there are no files beside it.
    assert page != PACKAGE / "README.md", place
    path = (page.parent / parts.path).resolve() if parts.path else page
    if path.parent == DOCS / "notebooks" and path.suffix == ".md":
        path = path.with_suffix(".ipynb")
    assert path.exists(), place
    if parts.fragment and path.suffix == ".md":
        headings = re.findall(r"^#+ (.*)$", prose(path.read_text(encoding="utf-8")), re.MULTILINE)
        assert parts.fragment in [slugify(heading, "-") for heading in headings], place


def test_broken_links_and_wrong_outputs_are_rejected(folder: Path) -> None:
    for target in ("nowhere.md", "index.md#nowhere", "http://example.org", "https://nowhere"):
        with pytest.raises(AssertionError):
            assert_link(DOCS / "index.md", target)
    assert_link(DOCS / "index.md", "tutorials/cluster.md")
    page = folder / "page.md"
    page.write_text(f"```python\nprint(1)\n```\n\n{PRINTS}\n\n```text\n2\n```\n", encoding="utf-8")
    ((block, code),) = shown(page)
    assert (block.code, run(page)[code]) == ("2", "1")


def executed(path: Path) -> nbformat.NotebookNode:
    """Return a notebook with the outputs that it has now, run in this folder."""
    notebook = nbformat.read(path, as_version=4)
    client = nbclient.NotebookClient(notebook, timeout=600, kernel_name="python3")
    client.execute()
    return cleaned(notebook)


def cleaned(notebook: nbformat.NotebookNode) -> nbformat.NotebookNode:
    """Return a notebook without what changes from run to run, each output in one form."""
    notebook.metadata = {"language_info": {"name": "python"}}
    for cell in notebook.cells:
        cell.metadata = {}
        if cell.cell_type != "code":
            continue
        cell.execution_count = None
        cell.outputs = joined(cell.outputs)
        for output in cell.outputs:
            if "data" in output:
                forms = ("image/svg+xml", "image/png", "text/plain")
                kind = next(form for form in forms if form in output["data"])
                output["data"] = {kind: output["data"][kind]}
                output["metadata"] = {}
            if "execution_count" in output:
                output["execution_count"] = None
    return notebook


def joined(outputs: list[nbformat.NotebookNode]) -> list[nbformat.NotebookNode]:
    """Return outputs with what is printed in one piece, however it came."""
    found: list[nbformat.NotebookNode] = []
    for output in outputs:
        if found and output.output_type == found[-1].output_type == "stream":
            found[-1].text += output.text
        else:
            found.append(output)
    return found


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebooks_run_and_give_what_they_store(path: Path, folder: Path) -> None:
    stored = nbformat.read(path, as_version=4)
    assert stored == cleaned(nbformat.read(path, as_version=4)), "stored with what changes"
    for cell, other in zip(stored.cells, executed(path).cells, strict=True):
        outputs, now = cell.get("outputs", []), other.get("outputs", [])
        assert [dict(output, data=0, text=0) for output in outputs] == [
            dict(output, data=0, text=0) for output in now
        ], cell.source
        for output, made in zip(outputs, now, strict=True):
            assert output.get("text") == made.get("text"), cell.source
            assert_same_data(output.get("data", {}), made.get("data", {}))


def assert_same_data(stored: dict[str, str], made: dict[str, str]) -> None:
    """Compare what a cell shows."""
    assert stored.keys() == made.keys()
    for kind, content in stored.items():
        if kind == "image/png":
            stored_png, made_png = (base64.b64decode(data) for data in (content, made[kind]))
            assert_same_picture(stored_png, made_png, ".png")
        else:
            assert content == made[kind]


def assert_same_picture(stored: bytes, made: bytes, suffix: str) -> None:
    """Compare drawings of quasilux byte by byte, and pictures of matplotlib nearly so."""
    if suffix != ".png":
        assert stored == made
        return
    one, other = (matplotlib.image.imread(io.BytesIO(data)) for data in (stored, made))
    if one.shape == other.shape:
        assert np.abs(one - other).mean() < PICTURE_TOLERANCE
    else:
        # Another version may leave other margins.
        assert np.abs(np.divide(one.shape, other.shape) - 1.0).max() < SIZE_TOLERANCE


def test_the_pages_of_repository_and_package_have_code() -> None:
    assert all(has_code(page) for page in (ROOT / "README.md", PACKAGE / "README.md"))


def test_there_are_three_notebooks_and_the_site_shows_them() -> None:
    assert len(NOTEBOOKS) == 3
    site = (PACKAGE / "mkdocs.yml").read_text(encoding="utf-8")
    for path in NOTEBOOKS:
        assert f"notebooks/{path.stem}.md" in site


def modules() -> list[str]:
    """Return the names of all modules of the package that is imported here."""
    source = Path(quasilux.__file__).parent
    paths = (path.relative_to(source.parent) for path in sorted(source.rglob("*.py")))
    return [".".join(path.with_suffix("").parts).removesuffix(".__init__") for path in paths]


@pytest.mark.parametrize("module", modules())
def test_examples_of_docstrings_print_what_they_show(module: str, folder: Path) -> None:
    assert doctest.testmod(importlib.import_module(module)).failed == 0


@pytest.mark.parametrize("page", sorted((DOCS / "api").glob("*.md")), ids=name)
def test_the_reference_has_all_public_names(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    module = importlib.import_module(re.findall(r"^# (\S+)$", text, re.MULTILINE)[0])
    described = re.findall(rf"^::: {module.__name__}\.(\w+)$", text, re.MULTILINE)
    # Submodules have pages of their own.
    others = {path.stem for path in page.parent.glob("*.md")} | {"__version__"}
    assert sorted(described) == sorted(set(module.__all__) - others)


def test_the_site_fetches_nothing() -> None:
    own, base = PACKAGE / "mkdocs.yml", ROOT / "mkdocs.base.yml"
    text = base.read_text(encoding="utf-8")
    assert yaml.safe_load(text)["theme"]["font"] is False
    assert "://" not in text + own.read_text(encoding="utf-8")


def test_wheels_are_built_with_the_compiler_and_the_builder_of_the_tests() -> None:
    workflow = yaml.safe_load((ROOT / ".github/workflows/wheels.yml").read_text(encoding="utf-8"))
    toolchain = (ROOT / "rust-toolchain.toml").read_text(encoding="utf-8")
    assert f'channel = "{workflow["env"]["RUST_TOOLCHAIN"]}"' in toolchain
    requirements = (PACKAGE / "tests/requirements.txt").read_text(encoding="utf-8")
    assert f"maturin=={workflow['env']['MATURIN'].removeprefix('v')}\n" in requirements
    assert workflow["jobs"]["publish"]["if"] == "startsWith(github.ref, 'refs/tags/v')"


def write_page(page: Path) -> None:
    """Write the outputs and pictures of a page anew."""
    printed = run(page)
    lines = page.read_text(encoding="utf-8").split("\n")
    for block, code in reversed(list(shown(page))):
        if comparable(block.code) != comparable(printed[code]):
            lines[block.line - 1 : block.end - 1] = printed[code].split("\n")
    page.write_text("\n".join(lines), encoding="utf-8")
    for picture in own_pictures(page):
        shutil.copy(picture.name, picture)


def write_notebook(path: Path) -> None:
    """Write the outputs of a notebook anew."""
    text = json.dumps(executed(path), indent=1, ensure_ascii=False, sort_keys=True)
    path.write_text(text + "\n", encoding="utf-8")


def write_all(wanted: list[str]) -> None:
    """Write outputs anew, of all pages and notebooks or of those whose names end so."""
    os.environ["RAY_AUTH_MODE"] = "disabled"
    for path in [page for page in PAGES if has_code(page)] + NOTEBOOKS:
        if wanted and not name(path).endswith(tuple(wanted)):
            continue
        print(name(path))
        with tempfile.TemporaryDirectory() as folder:
            enter(Path(folder))
            if path in NOTEBOOKS:
                write_notebook(path)
            else:
                write_page(path)
            os.chdir(PACKAGE)


if __name__ == "__main__":
    write_all(sys.argv[1:])
