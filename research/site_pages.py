"""Hook of MkDocs: puts the pages of this folder into the site, beside those of `docs/`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from mkdocs.structure.files import File

if TYPE_CHECKING:
    from mkdocs.config.defaults import MkDocsConfig
    from mkdocs.structure.files import Files
    from mkdocs.structure.pages import Page

HERE = Path(__file__).parent
# What pages show: of the texts beside them `experiments.md` is made.
SHOWN = ["experiments.md", "experiments/*.svg", "experiments/*.png", "experiments/*.csv"]


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add pages and pictures, below `research/`."""
    for path in (path for pattern in SHOWN for path in sorted(HERE.glob(pattern))):
        uri = f"research/{path.relative_to(HERE).as_posix()}"
        files.append(File.generated(config, uri, abs_src_path=str(path)))
    return files


def on_page_markdown(markdown: str, *, page: Page, **_: object) -> str:
    """Let links between the two folders lead to where the site has them."""
    if page.file.src_uri.startswith("research/"):
        return markdown.replace("](../docs/", "](../")
    return markdown.replace("](../research/", "](research/")
