"""A report as plain data, and its two forms: Markdown, and one HTML file that needs nothing else."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from importlib.resources import files
from pathlib import Path

from egotouch_sdk.errors import ConfigError


@dataclass(frozen=True, slots=True)
class Text:
    """One paragraph; `is_warning` sets it apart."""

    text: str
    is_warning: bool = False


@dataclass(frozen=True, slots=True)
class Facts:
    """What is known, as pairs of name and value."""

    pairs: tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True)
class Table:
    """A table; its first column names the rows, all others are aligned to the right. `marked` rows stand out."""

    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    marked: frozenset[int] = frozenset()

    def __post_init__(self) -> None:
        if wrong := [row for row in self.rows if len(row) != len(self.head)]:
            raise ValueError(f"row {wrong[0]} does not fit the head {self.head}")


@dataclass(frozen=True, slots=True)
class Plot:
    """An inline SVG with its caption; Markdown shows neither, since a table beside it tells the same."""

    svg: str
    caption: str


Block = Text | Facts | Table | Sequence[Plot]


@dataclass(frozen=True, slots=True)
class Section:
    """A heading and what follows it."""

    title: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True, slots=True)
class Document:
    """A whole report; `lead` comes before the first heading."""

    title: str
    lead: tuple[Block, ...]
    sections: tuple[Section, ...]


def write_document(path: Path, document: Document) -> None:
    """Write the form that the file's ending asks for; raises `ConfigError` for another ending."""
    forms = {".html": to_html, ".md": to_markdown}
    if path.suffix not in forms:
        raise ConfigError(f"{path} is neither .html nor .md", hint="Choose one of these endings for --report")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(forms[path.suffix](document), encoding="utf-8")


def to_markdown(document: Document) -> str:
    """The report as GitHub's Markdown, without the plots."""
    parts = [f"# {document.title}", *(_markdown(block) for block in document.lead)]
    for section in document.sections:
        parts += [f"## {section.title}", *(_markdown(block) for block in section.blocks)]
    return "\n\n".join(part for part in parts if part) + "\n"


def _markdown(block: Block) -> str:
    if isinstance(block, Text):
        return f"> **{block.text}**" if block.is_warning else block.text
    if isinstance(block, Facts):
        return "\n".join(f"- {name}: {value}" for name, value in block.pairs)
    if isinstance(block, Table):
        rule = ["---", *["---:"] * (len(block.head) - 1)]
        rows = [block.head, rule, *(_bold(row) if index in block.marked else row for index, row in enumerate(block.rows))]
        return "\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in rows)
    return ""


def _bold(row: Sequence[str]) -> list[str]:
    return [f"**{row[0]}**", *row[1:]]


def to_html(document: Document) -> str:
    """The report as one HTML page: styles and plots inside, light and dark, for any width."""
    style = files("egotouch_sdk.evaluation").joinpath("report.css").read_text(encoding="utf-8")
    parts = [f"<h1>{escape(document.title)}</h1>", *(_html(block) for block in document.lead)]
    if len(document.sections) > 3:
        links = "".join(f'<a href="#s{number}">{escape(section.title)}</a>' for number, section in enumerate(document.sections))
        parts.append(f'<nav aria-label="Sections">{links}</nav>')
    for number, section in enumerate(document.sections):
        inside = "".join(_html(block) for block in section.blocks)
        parts.append(f'<section id="s{number}"><h2>{escape(section.title)}</h2>{inside}</section>')
    return (
        '<!doctype html><html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width,initial-scale=1">'
        f'<meta name="color-scheme" content="light dark"><title>{escape(document.title)}</title><style>{style}</style></head>'
        f"<body><main>{''.join(parts)}</main></body></html>\n"
    )


def _html(block: Block) -> str:
    if isinstance(block, Text):
        return f"<p{_class('warning', block.is_warning)}>{escape(block.text)}</p>"
    if isinstance(block, Facts):
        return f"<dl>{''.join(f'<dt>{escape(name)}</dt><dd>{escape(value)}</dd>' for name, value in block.pairs)}</dl>"
    if isinstance(block, Table):
        head = "".join(f'<th scope="col">{escape(cell)}</th>' for cell in block.head)
        rows = "".join(_row(row, index in block.marked) for index, row in enumerate(block.rows))
        return f'<div class="table" tabindex="0"><table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table></div>'
    plots = "".join(f"<figure>{plot.svg}<figcaption>{escape(plot.caption)}</figcaption></figure>" for plot in block)
    return f'<div class="plots">{plots}</div>'


def _row(row: Sequence[str], is_marked: bool) -> str:
    cells = "".join(f"<td>{escape(cell)}</td>" for cell in row[1:])
    return f'<tr{_class("marked", is_marked)}><th scope="row">{escape(row[0])}</th>{cells}</tr>'


def _class(name: str, applies: bool) -> str:
    return f' class="{name}"' if applies else ""
