"""Prepares the pages of the documentation site, and checks the links of the site that was made.

    site_pages.py FOLDER            copies README.md, docs/ and the pages of src/ there, with links that fit, and mkdocs.yml
    site_pages.py --check SITE      exits with 1 if a link of SITE leads nowhere
"""

import html.parser
import os
import re
import shutil
import sys
import urllib.parse
from pathlib import Path

LINK = re.compile(r'(\]\(|src=")([^)"#\s]*)(#[^)"\s]*)?([)"])')

SECTIONS = [
    ("Start", [("README.md", "Home"), ("docs/editor.md", "Editor"), ("docs/cookbook.md", "Cookbook"), ("docs/troubleshooting.md", "Troubleshooting")]),
    ("Reference", [("docs/scene.md", "Scene file"), ("docs/exports.md", "Exports"), ("docs/rendering.md", "Images and videos"),
                   ("docs/overlays.md", "Overlays"), ("docs/contact-forces.md", "Contact forces")]),
    ("Programs", [("docs/embedding.md", "Embedding"), ("docs/vulkan.md", "Vulkan backend"), ("reference.md", "Headers")]),
    ("Quality", [("docs/validation.md", "Validation"), ("docs/validation-cases.md", "Validation cases"), ("docs/physical-tests.md", "Physical tests"), ("docs/performance.md", "Performance")]),
    ("Inside", [("docs/architecture.md", "Architecture"), ("CHANGELOG.md", "Changelog")]),
]


def title_of(page: Path) -> str:
    for line in page.read_text(encoding="utf-8").splitlines():
        if line.startswith("# "):
            return line[2:].replace("`", "")
    return page.stem


def place_of(page: str) -> str:
    """Where a page of the repository stands in the site's sources."""
    if page == "README.md":
        return "index.md"
    return page.lower() if page == "CHANGELOG.md" else page.removeprefix("docs/").removesuffix("README.md") + (
        "index.md" if page.endswith("README.md") else "")


def pages_of(root: Path) -> list:
    pages = ["README.md", "CHANGELOG.md"]
    for folder in ("docs", "src"):
        pages += [str(page.relative_to(root)) for page in sorted((root / folder).rglob("*.md"))]
    return pages


def with_site_links(text: str, page: str, pages: list, files: set) -> str:
    """Links of a page, from where it stands in the site. Adds the source files that it names to `files`."""

    def link(match: re.Match) -> str:
        before, target, anchor, after = match.group(1), match.group(2), match.group(3) or "", match.group(4)
        if target == "" or "://" in target:
            return match.group(0)
        named = os.path.normpath(os.path.join(os.path.dirname(page), target))
        if os.path.isdir(named) and os.path.join(named, "README.md") in pages:
            named = os.path.join(named, "README.md")
        if not os.path.exists(named):
            sys.exit(f"site_pages: {page}: {target} leads nowhere")
        if named in pages:
            place = place_of(named)
        elif named.startswith("docs/"):
            place = named.removeprefix("docs/")
        else:
            files.add(named)
            place = "files/" + named + (".html" if os.path.isdir(named) else ".txt")
        return before + os.path.relpath(place, os.path.dirname(place_of(page)) or ".") + anchor + after

    # Every second piece is a sample of code.
    pieces = re.split(r"(^```.*?^```$)", text, flags=re.MULTILINE | re.DOTALL)
    return "".join(piece if index % 2 else LINK.sub(link, piece) for index, piece in enumerate(pieces))


def copy_file(root: Path, named: str, sources: Path) -> None:
    """A source file as text; of a folder, the list of its files."""
    to = sources / "files" / named
    to.parent.mkdir(parents=True, exist_ok=True)
    if (root / named).is_dir():
        names = sorted(file.name for file in (root / named).iterdir() if file.is_file())
        for name in names:
            copy_file(root, f"{named}/{name}", sources)
        items = "".join(f'<li><a href="{Path(named).name}/{name}.txt">{name}</a></li>' for name in names)
        Path(f"{to}.html").write_text(f"<!doctype html><title>{named}</title><h1>{named}</h1><ul>{items}</ul>", encoding="utf-8")
    else:
        shutil.copy(root / named, f"{to}.txt")


def prepare(root: Path, folder: Path) -> None:
    shutil.rmtree(folder, ignore_errors=True)
    pages = pages_of(root)
    sources = folder / "pages"
    files = set()
    for page in pages:
        to = sources / place_of(page)
        to.parent.mkdir(parents=True, exist_ok=True)
        to.write_text(with_site_links((root / page).read_text(encoding="utf-8"), page, pages, files), encoding="utf-8")
    for named in sorted(files):
        copy_file(root, named, sources)
    (sources / "reference.md").write_text(
        "# Headers\n\nEvery type and function of `include/weft`:\n"
        '<a href="api/annotated.html">types</a>, <a href="api/files.html">headers</a>, '
        '<a href="api/classweft_1_1Simulation.html">Simulation</a>.\n', encoding="utf-8")
    for file in sorted((root / "docs").rglob("*")):
        if file.is_file() and file.suffix != ".md":
            to = sources / file.relative_to(root / "docs")
            to.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(file, to)

    def entry(page: str, name: str) -> str:
        return f'      - "{name}": {place_of(page)}\n'

    nav = ""
    for section, entries in SECTIONS:
        nav += f"  - {section}:\n" + "".join(entry(page, name) for page, name in entries)
    listed = {page for _, entries in SECTIONS for page, _ in entries}
    rest = {"Physics": [p for p in pages if p.startswith("src/")], "Notes": [p for p in pages if p.startswith("docs/notes/")]}
    for section, found in rest.items():
        if found:
            nav += f"  - {section}:\n" + "".join(entry(page, title_of(root / page)) for page in found)
    missing = [page for page in pages if page not in listed and not any(page in found for found in rest.values())]
    if missing:
        sys.exit(f"site_pages: pages without a place in SECTIONS: {', '.join(missing)}")

    (folder / "mkdocs.yml").write_text(f"""site_name: weft
site_description: Real-time cloth for C++
docs_dir: pages
site_dir: {root / "build" / "site"}
use_directory_urls: false
theme:
  name: material
  font: false
  features: [navigation.tabs, navigation.top, search.highlight]
plugins: [search]
markdown_extensions:
  - tables
  - pymdownx.superfences
  - pymdownx.highlight
  - toc: {{ permalink: true, slugify: !!python/name:pymdownx.slugs.uslugify }}
nav:
{nav}""", encoding="utf-8")


class Links(html.parser.HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.links, self.anchors = [], set()

    def handle_starttag(self, tag: str, attributes: list) -> None:
        for name, value in attributes:
            if name in ("id", "name") and value:
                self.anchors.add(value)
            if (tag, name) in (("a", "href"), ("img", "src"), ("link", "href"), ("script", "src")) and value:
                self.links.append(value)


def check(site: Path) -> None:
    pages = {}
    for page in site.rglob("*.html"):
        parsed = Links()
        parsed.feed(page.read_text(encoding="utf-8", errors="replace"))
        pages[page.resolve()] = parsed
    broken, count = [], 0
    for page, parsed in pages.items():
        if "api" in page.relative_to(site.resolve()).parts or page.name == "404.html":
            continue
        for link in parsed.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            count += 1
            target = (page.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else page
            if target.is_dir():
                target = target / "index.html"
            anchor = urllib.parse.unquote(parts.fragment)
            if not target.exists() or (anchor and target in pages and anchor not in pages[target].anchors):
                broken.append(f"{page.relative_to(site.resolve())}: {link}")
    for one in broken:
        print(f"site_pages: leads nowhere: {one}", file=sys.stderr)
    if broken or count < 100:
        sys.exit(1)


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[1] == "--check":
        check(Path(sys.argv[2]))
    elif len(sys.argv) == 2:
        prepare(Path.cwd(), Path(sys.argv[1]))
    else:
        sys.exit(__doc__)
