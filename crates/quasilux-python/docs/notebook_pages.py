"""Hook of MkDocs: a page for each notebook in `notebooks/`, of its cells and stored outputs."""

from __future__ import annotations

import base64
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mkdocs.structure.files import File

if TYPE_CHECKING:
    from mkdocs.config.defaults import MkDocsConfig
    from mkdocs.structure.files import Files

# Of several forms of an output the first that is there is shown.
PICTURES = {"image/svg+xml": "svg", "image/png": "png"}


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the pages and the pictures in them."""
    for notebook in [file for file in files if file.src_uri.endswith(".ipynb")]:
        source = Path(config.docs_dir) / notebook.src_uri
        cells: list[dict[str, Any]] = json.loads(source.read_text(encoding="utf-8"))["cells"]
        page = NotebookPage(notebook.src_uri.removesuffix(".ipynb"))
        for cell in cells:
            page.add(cell)
        files.append(File.generated(config, f"{page.uri}.md", content=page.text(source.name)))
        for name, content in page.pictures.items():
            files.append(File.generated(config, name, content=content))
    return files


class NotebookPage:
    """The text and the pictures of a page."""

    def __init__(self, uri: str) -> None:
        self.uri = uri
        self.pictures: dict[str, bytes] = {}
        self._parts: list[str] = []

    def text(self, notebook: str) -> str:
        """Return the page, with a link to its notebook below the heading."""
        first, *others = self._parts
        heading, _, rest = first.partition("\n")
        link = f"This page is the notebook [{notebook}]({notebook}) with its outputs."
        return "\n\n".join([heading, link, rest.strip(), *others]) + "\n"

    def add(self, cell: dict[str, Any]) -> None:
        """Add a cell."""
        source = "".join(cell["source"])
        if cell["cell_type"] == "markdown":
            self._parts.append(source)
            return
        self._parts.append(f"```python\n{source}\n```")
        for output in cell["outputs"]:
            self._add_output(output)

    def _add_output(self, output: dict[str, Any]) -> None:
        if output["output_type"] == "stream":
            self._add_text("".join(output["text"]))
            return
        data: dict[str, Any] = output["data"]
        for kind, ending in PICTURES.items():
            if kind in data:
                name = f"{self.uri}-{len(self.pictures) + 1}.{ending}"
                content = "".join(data[kind])
                is_text = ending == "svg"
                self.pictures[name] = content.encode() if is_text else base64.b64decode(content)
                self._parts.append(f"![]({Path(name).name})")
                return
        self._add_text("".join(data["text/plain"]))

    def _add_text(self, text: str) -> None:
        self._parts.append(f"```text\n{text.rstrip()}\n```")
