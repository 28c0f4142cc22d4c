from __future__ import annotations

from html.parser import HTMLParser
from pathlib import Path

import pytest

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.evaluation.document import Document, Facts, Plot, Section, Table, Text, to_html, to_markdown, write_document
from egotouch_sdk.evaluation.svg import column_plot

DOCUMENT = Document(
    "A <report>",
    (Text("Beware", is_warning=True), Facts((("Model", "touch & go"),))),
    (
        Section("One", (Text("Words."), Table(("", "a|b"), (("x", "1"), ("y", "2")), frozenset({1})))),
        Section("Two", ([Plot(column_plot([("0–1", 97.0)]), "Columns.")],)),
    ),
)
VOID = {"meta", "path", "circle", "rect"}


class Reader(HTMLParser):
    """Checks that tags nest, and gathers what a page asks for and says."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.text: list[str] = []
        self.wants: list[str] = []
        self.feed(page)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.wants += [value or "" for name, value in attrs if name in {"src", "href"}]
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        if tag not in VOID:
            assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if "style" not in self.open:
            self.text.append(data)


def test_markdown_has_everything_but_the_plots() -> None:
    assert to_markdown(DOCUMENT) == (
        "# A <report>\n\n> **Beware**\n\n- Model: touch & go\n\n## One\n\nWords.\n\n"
        "|  | a\\|b |\n| --- | ---: |\n| x | 1 |\n| **y** | 2 |\n\n## Two\n"
    )


def test_html_nests_escapes_and_asks_for_nothing() -> None:
    page = to_html(DOCUMENT)
    reader = Reader(page)
    assert reader.open == [] and reader.wants == []
    assert [text for text in reader.text if text.strip()] == [
        "A <report>", "A <report>", "Beware", "Model", "touch & go", "One", "Words.", "a|b", "x", "1", "y", "2", "Two", "0–1", "97.0%",
        "Columns.",
    ]  # fmt: skip
    assert "prefers-color-scheme: dark" in page and "url(" not in page and "http" not in page.replace("http-equiv", "")


def test_many_sections_have_links_that_lead_to_them() -> None:
    page = to_html(Document("Long", (), tuple(Section(f"Part {number}", ()) for number in range(4))))
    assert Reader(page).wants == ["#s0", "#s1", "#s2", "#s3"] and all(f'id="s{number}"' in page for number in range(4))


def test_the_ending_of_the_file_chooses_the_form(tmp_path: Path) -> None:
    write_document(tmp_path / "new" / "report.md", DOCUMENT)
    write_document(tmp_path / "report.html", DOCUMENT)
    assert (tmp_path / "new" / "report.md").read_text(encoding="utf-8") == to_markdown(DOCUMENT)
    assert (tmp_path / "report.html").read_text(encoding="utf-8") == to_html(DOCUMENT)
    with pytest.raises(ConfigError, match=r"report\.pdf is neither \.html nor \.md"):
        write_document(tmp_path / "report.pdf", DOCUMENT)


def test_a_row_that_does_not_fit_is_refused() -> None:
    with pytest.raises(ValueError, match="does not fit the head"):
        Table(("", "a"), (("x", "1", "2"),))
